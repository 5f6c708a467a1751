//! The bytes of a header, taken one after another, never past the end.

use crate::fault::Fault;

/// A name has at most this many bytes: NC_MAX_NAME.
const NAME_BYTES_MAX: u64 = 256;

/// The mend of a file that ends too early or says what cannot be.
pub(crate) const FETCH_AGAIN: &str = "fetch or write it again, and look at it with `ncdump -h`";

/// Bytes, and how far they have been read.
pub(crate) struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub fn new(bytes: &'a [u8]) -> Bytes<'a> {
        Bytes { bytes, at: 0 }
    }

    /// What has just been read cannot be.
    pub fn wrong(&self, message: String) -> Fault {
        Fault::new(format!("the header is wrong before byte {}: {message}", self.at), FETCH_AGAIN)
    }

    pub fn take(&mut self, count: u64, what: &str) -> Result<&'a [u8], Fault> {
        let rest = &self.bytes[self.at..];
        match usize::try_from(count).ok().and_then(|count| rest.split_at_checked(count)) {
            Some((taken, _)) => {
                self.at += taken.len();
                Ok(taken)
            }
            None => {
                let message = format!(
                    "the file is cut off: {what} is {count} bytes at byte {}, and it has {}",
                    self.at,
                    self.bytes.len()
                );
                Err(Fault::new(message, FETCH_AGAIN))
            }
        }
    }

    fn array<const SIZE: usize>(&mut self, what: &str) -> Result<[u8; SIZE], Fault> {
        let mut array = [0; SIZE];
        array.copy_from_slice(self.take(SIZE as u64, what)?);
        Ok(array)
    }

    pub fn word(&mut self, what: &str) -> Result<u32, Fault> {
        self.array(what).map(u32::from_be_bytes)
    }

    /// A word that counts something, and so has no sign.
    pub fn count(&mut self, what: &str) -> Result<u64, Fault> {
        let word = self.word(what)?;
        if word > i32::MAX as u32 {
            return Err(self.wrong(format!("{what} is {}", word as i32)));
        }
        Ok(u64::from(word))
    }

    /// A count of twice the width.
    pub fn long(&mut self, what: &str) -> Result<u64, Fault> {
        let long = self.array(what).map(u64::from_be_bytes)?;
        if long > i64::MAX as u64 {
            return Err(self.wrong(format!("{what} is {}", long as i64)));
        }
        Ok(long)
    }

    /// So many bytes, and what fills them up to a whole number of words.
    pub fn padded(&mut self, count: u64, what: &str) -> Result<&'a [u8], Fault> {
        let taken = self.take(count, what)?;
        self.take(count.next_multiple_of(4) - count, what)?;
        Ok(taken)
    }

    pub fn name(&mut self, of: &str) -> Result<&'a str, Fault> {
        let length = self.count("the length of a name")?;
        if length > NAME_BYTES_MAX {
            return Err(self.wrong(format!("the name of {of} is {length} bytes long: {NAME_BYTES_MAX} are the most")));
        }
        let bytes = self.padded(length, "a name")?;
        std::str::from_utf8(bytes).map_err(|_| self.wrong(format!("the name of {of} is no text in UTF-8")))
    }

    /// A list, or its absence. There is no room made for what is only announced.
    pub fn list<T>(
        &mut self,
        mark: u32,
        what: &str,
        mut element: impl FnMut(&mut Bytes<'a>) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let found = self.word(what)?;
        let count = self.count(what)?;
        if found != mark && (found, count) != (0, 0) {
            return Err(self.wrong(format!("the list of {what} begins with {found}, and not with {mark}")));
        }
        let mut list = Vec::new();
        for _ in 0..count {
            list.push(element(self)?);
        }
        Ok(list)
    }
}
