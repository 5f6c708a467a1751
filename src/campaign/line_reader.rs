//! Lines of a table, each read by itself: whatever stands in one, the next is read as it is.

use csv::{Reader, ReaderBuilder, StringRecord};
use std::io::Cursor;

/// Reads lines one after another. A reader of CSV makes tables of its own when it is made, which takes ten times as long as to read a line: so
/// all lines share one, as long as each is one row.
pub struct LineReader {
    reader: Reader<Cursor<Vec<u8>>>,
    row: StringRecord,
}

impl Default for LineReader {
    fn default() -> Self {
        LineReader { reader: reader(), row: StringRecord::new() }
    }
}

impl LineReader {
    /// The cells of a line, if it is one of CSV.
    pub fn cells(&mut self, line: &[u8]) -> Option<&StringRecord> {
        // A mark of the order of bytes is left out where a reader begins, and nowhere else.
        if line.starts_with(b"\xef\xbb\xbf") {
            self.reader = reader();
        }
        let before = self.reader.position().byte();
        *self.reader.get_mut() = Cursor::new(line.to_vec());
        let is_read = matches!(self.reader.read_record(&mut self.row), Ok(true));
        // A line without an end, or with a row and more in it, would leave something of it to the next.
        let is_all = self.reader.position().byte() - before == line.len() as u64;
        if !is_read || !is_all || self.reader.is_done() {
            self.reader = reader();
        }
        is_read.then_some(&self.row)
    }
}

fn reader() -> Reader<Cursor<Vec<u8>>> {
    ReaderBuilder::new().has_headers(false).flexible(true).from_reader(Cursor::default())
}

#[cfg(test)]
mod tests {
    use super::LineReader;

    #[test]
    fn no_line_changes_how_another_is_read() {
        let lines: [&[u8]; 13] = [
            b"a,b\n",
            b"1,2,3\n",
            b"\n",
            b"a \"quoted\" cell,\"and, one\"\n",
            b"\"open,2\n",
            b"1,2",
            b"1\r2\n",
            b"1,2\r\n",
            b"\xff,2\n",
            b"",
            b"\"a\nb\",3\n",
            b"5,6\n",
            b"\xef\xbb\xbf7,8\n",
        ];
        let alone = |line: &[u8]| {
            let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line);
            reader.records().next()?.ok()
        };
        let mut reader = LineReader::default();
        for first in lines {
            for line in lines {
                assert_eq!(reader.cells(first).cloned(), alone(first), "{first:?}");
                assert_eq!(reader.cells(line).cloned(), alone(line), "{line:?} after {first:?}");
            }
        }
    }
}
