//! Frames: `#`, a letter, fields after commas, `,*`, and two hexadecimal digits of a sum; one a line.

/// The longest line, in bytes, as a public controller has it. A longer one is dropped whole.
pub const LINE_MAX: usize = 1024;

/// The most fields of a line, its letter included, as a public controller has it.
const FIELDS_MAX: usize = 32;
/// How a line begins that passes on what a modem says in NMEA, and has no sum of ours. No other line is one wrong byte away.
const PASSED_ON: &[u8] = b"#p,$";

/// Why a line is no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unreadable {
    /// It does not end.
    #[error("a line of more than 1024 bytes")]
    TooLong,
    /// It has no `#`, no `,*` or no two digits after it.
    #[error("a line without `#` or `,*`")]
    NoFrame,
    /// The sum is another.
    #[error("a wrong checksum")]
    Checksum,
    /// It has too many fields.
    #[error("a line of more than 32 fields")]
    TooManyFields,
    /// It is not ASCII.
    #[error("bytes that are no text")]
    NotText,
}

/// The checksum: the sum of all bytes from `#` to `*`, both in, modulo 256.
fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum.wrapping_add(*byte))
}

/// A frame around a body such as `E,1`: its line, with the line's end.
pub fn seal(body: &str) -> String {
    let framed = format!("#{body},*");
    format!("{framed}{:02X}\n", checksum(framed.as_bytes()))
}

/// The body of a line.
///
/// What stands before the `#` is noise, and so is everything before the last `#` when the whole does not add up: the line's
/// end before it was lost.
fn unseal(line: &[u8]) -> Result<&str, Unreadable> {
    let line = line.trim_ascii();
    let (Some(first), Some(last)) = (line.iter().position(|b| *b == b'#'), line.iter().rposition(|b| *b == b'#'))
    else {
        return Err(Unreadable::NoFrame);
    };
    if line[first..].starts_with(PASSED_ON) {
        return text(&line[first + 1..]);
    }
    let whole = unseal_at(&line[first..]);
    if whole.is_ok() || first == last { whole } else { unseal_at(&line[last..]) }
}

fn unseal_at(frame: &[u8]) -> Result<&str, Unreadable> {
    // Texts may hold a `*`: the last one counts.
    let star = frame.iter().rposition(|b| *b == b'*').ok_or(Unreadable::NoFrame)?;
    let digits = std::str::from_utf8(&frame[star + 1..]).map_err(|_| Unreadable::NotText)?;
    if digits.len() != 2 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(Unreadable::NoFrame);
    }
    let sum = u8::from_str_radix(digits, 16).map_err(|_| Unreadable::NoFrame)?;
    if sum != checksum(&frame[..=star]) {
        return Err(Unreadable::Checksum);
    }
    let body = frame[1..star].strip_suffix(b",").ok_or(Unreadable::NoFrame)?;
    if body.iter().filter(|b| **b == b',').count() >= FIELDS_MAX {
        return Err(Unreadable::TooManyFields);
    }
    text(body)
}

fn text(body: &[u8]) -> Result<&str, Unreadable> {
    std::str::from_utf8(body).ok().filter(|body| body.is_ascii()).ok_or(Unreadable::NotText)
}

/// Cuts a stream of bytes into frames, however it was cut on its way. It holds one line at most.
#[derive(Clone, Debug, Default)]
pub struct Deframer {
    line: Vec<u8>,
    /// The line is too long already: the rest of it is dropped.
    dropping: bool,
}

impl Deframer {
    /// Takes in bytes, and gives each body that they complete, or why a line is none. Empty lines say nothing.
    pub fn push(&mut self, bytes: &[u8], mut each: impl FnMut(Result<&str, Unreadable>)) {
        for &byte in bytes {
            match byte {
                b'\n' => {
                    if !std::mem::take(&mut self.dropping) && !self.line.trim_ascii().is_empty() {
                        each(unseal(&self.line));
                    }
                    self.line.clear();
                }
                _ if self.dropping => {}
                _ if self.line.len() == LINE_MAX => {
                    self.dropping = true;
                    each(Err(Unreadable::TooLong));
                }
                _ => self.line.push(byte),
            }
        }
    }
}

/// Whether a datagram has a frame in it.
pub fn is_message(datagram: &[u8]) -> bool {
    let mut found = false;
    let mut deframer = Deframer::default();
    deframer.push(datagram, |frame| found |= frame.is_ok());
    deframer.push(b"\n", |frame| found |= frame.is_ok());
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Vec<Result<String, Unreadable>> {
        let mut found = Vec::new();
        Deframer::default().push(bytes, |frame| found.push(frame.map(str::to_string)));
        found
    }

    /// A line captured from a vehicle in a public controller's source, and sums computed from its rule.
    #[test]
    fn the_checksum_is_a_sum() {
        let captured = "S,T15:08:37.672,LAT39N30.5553,LON74W19.4386,D-0.10,DG0.00,A0.00,P-0.3,R3.0,TR0,TRG0,V0.00,H0.4,\
                        HR0.0,HG0.0,M10,l0";
        assert!(seal(captured).ends_with(",*48\n"));
        for (body, sum) in [
            ("E,1", "1B"),
            ("E,0", "1A"),
            ("c,1", "39"),
            ("C,Heading,Goal,270.0", "6A"),
            ("C,Speed,1.5 meters/sec", "B3"),
            ("C,Speed,600 rpm", "0A"),
            ("C,Depth,Altitude,4.0", "03"),
            ("C,Depth,Triangle,3.0,3.0,10.0,30.0", "91"),
            ("v", "EF"),
            ("V,Sep 14 2011, 13:17:09", "81"),
            ("Q,Depth", "EB"),
        ] {
            assert_eq!(seal(body), format!("#{body},*{sum}\n"));
            assert_eq!(read(seal(body).as_bytes()), [Ok(body.to_string())]);
        }
    }

    /// A sum of 8 bits notices every single wrong byte, though not every two.
    #[test]
    fn no_single_wrong_byte_goes_unnoticed() {
        let body = "S,T15:08:37.672,LAT39N30.5553,LON74W19.4386,D-0.10,DG0.00,A0.00,M10,l0";
        let line = seal(body).into_bytes();
        for at in 0..line.len() {
            for wrong in 0..=255 {
                let mut changed = line.clone();
                changed[at] = wrong;
                let found = read(&changed);
                assert!(found.iter().flatten().all(|b| b == body), "byte {at} as {wrong}: {found:?}");
            }
        }
    }

    #[test]
    fn the_comma_before_the_star_belongs_to_the_frame() {
        let sum = "#E,1*".bytes().fold(0_u8, u8::wrapping_add);
        assert_eq!(read(format!("#E,1*{sum:02X}\n").as_bytes()), [Err(Unreadable::NoFrame)]);
    }

    #[test]
    fn a_star_in_a_text_is_text() {
        assert_eq!(read(seal("V,one * two").as_bytes()), [Ok("V,one * two".to_string())]);
    }

    #[test]
    fn noise_costs_the_line_that_it_is_in_and_no_other() {
        assert_eq!(read(b"\xff\x00ab#E,1,*1B\r\n"), [Ok("E,1".into())]);
        assert_eq!(read(b"#E,1,*1C\n#E,0,*1A\n"), [Err(Unreadable::Checksum), Ok("E,0".into())]);
        assert_eq!(read(b"#E,1,*1B#E,0,*1A\n"), [Ok("E,0".into())], "a lost line's end");
        assert_eq!(read(b"\n\r\n  \n"), []);
        assert_eq!(read(b"$GPGGA,1*00\n"), [Err(Unreadable::NoFrame)]);
        assert_eq!(read(b"#*\n#,*\n*00\n#E,1,*\n").len(), 4);
    }

    #[test]
    fn a_line_has_32_fields_at_most_and_what_a_modem_says_has_no_sum() {
        let fields = |count: usize| format!("V{}", ",x".repeat(count - 1));
        assert_eq!(read(seal(&fields(32)).as_bytes()), [Ok(fields(32))]);
        assert_eq!(read(seal(&fields(33)).as_bytes()), [Err(Unreadable::TooManyFields)]);
        assert_eq!(read(b"#p,$CCMPC,0,1*7C\n"), [Ok("p,$CCMPC,0,1*7C".into())]);
    }

    #[test]
    fn an_endless_line_is_dropped_once_and_holds_no_memory() {
        let mut deframer = Deframer::default();
        let mut told = Vec::new();
        for _ in 0..100 {
            deframer.push(&[b'x'; 10_000], |frame| told.push(frame.map(str::to_string)));
        }
        deframer.push(b"\n#E,1,*1B\n", |frame| told.push(frame.map(str::to_string)));
        assert_eq!(told, [Err(Unreadable::TooLong), Ok("E,1".into())]);
        assert!(deframer.line.capacity() <= 2 * LINE_MAX);
    }

    #[test]
    fn frames_arrive_whole_however_they_are_cut() {
        let stream: String = ["E,1", "C,Heading,Goal,270.0", "V,Sep 14 2011, 13:17:09", "v"].map(seal).concat();
        let whole = read(stream.as_bytes());
        for cut in 0..stream.len() {
            let mut found = Vec::new();
            let mut deframer = Deframer::default();
            for part in [&stream.as_bytes()[..cut], &stream.as_bytes()[cut..]] {
                deframer.push(part, |frame| found.push(frame.map(str::to_string)));
            }
            assert_eq!(found, whole, "cut at {cut}");
        }
    }
}
