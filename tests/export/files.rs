//! Readers of what is exported, written from the formats' own descriptions: they share nothing with what writes.

use serde_json::Value;

/// A table with its head.
pub struct Table {
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn read(text: &str) -> Self {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let fields = |record: &csv::StringRecord| record.iter().map(str::to_string).collect();
        let head = fields(reader.headers().unwrap());
        Table { head, rows: reader.records().map(|record| fields(&record.unwrap())).collect() }
    }

    pub fn cell(&self, row: usize, head: &str) -> &str {
        let column = self.head.iter().position(|known| known == head).unwrap_or_else(|| panic!("no `{head}`"));
        &self.rows[row][column]
    }

    pub fn number(&self, row: usize, head: &str) -> Option<f64> {
        let cell = self.cell(row, head);
        (!cell.is_empty()).then(|| cell.parse().unwrap())
    }
}

/// A NetCDF classic file, of 32-bit places and without records.
pub struct NetCdf<'a> {
    bytes: &'a [u8],
    at: usize,
    dimensions: Vec<(String, usize)>,
    /// Each with the name of its variable; the file's own with none.
    attributes: Vec<(String, String, String)>,
    /// Name, dimensions, kind, place.
    variables: Vec<(String, Vec<usize>, usize, usize)>,
}

const CHAR: usize = 2;
const DOUBLE: usize = 6;

impl<'a> NetCdf<'a> {
    pub fn read(bytes: &'a [u8]) -> Self {
        assert_eq!(&bytes[..8], b"CDF\x01\0\0\0\0");
        let mut file = NetCdf { bytes, at: 8, dimensions: Vec::new(), attributes: Vec::new(), variables: Vec::new() };
        for _ in 0..file.list(0x0A) {
            let dimension = (file.name(), file.word());
            file.dimensions.push(dimension);
        }
        file.read_attributes("");
        for _ in 0..file.list(0x0B) {
            let (name, count) = (file.name(), file.word());
            let dimensions = (0..count).map(|_| file.word()).collect();
            file.read_attributes(&name);
            let (kind, size, begin) = (file.word(), file.word(), file.word());
            assert!(begin + size <= bytes.len() && begin.is_multiple_of(4), "{name}");
            file.variables.push((name, dimensions, kind, begin));
        }
        let end = file.variables.iter().map(|(.., begin)| *begin).min().unwrap();
        assert_eq!(file.at, end, "values begin where the header ends");
        file
    }

    fn word(&mut self) -> usize {
        self.at += 4;
        u32::from_be_bytes(self.bytes[self.at - 4..self.at].try_into().unwrap()) as usize
    }

    fn list(&mut self, mark: usize) -> usize {
        let (found, count) = (self.word(), self.word());
        assert!(found == mark || (found, count) == (0, 0));
        count
    }

    fn padded(&mut self, length: usize) -> &'a [u8] {
        let from = self.at;
        self.at += length.next_multiple_of(4);
        assert!(self.bytes[from + length..self.at].iter().all(|byte| *byte == 0));
        &self.bytes[from..from + length]
    }

    fn name(&mut self) -> String {
        let length = self.word();
        String::from_utf8(self.padded(length).to_vec()).unwrap()
    }

    fn read_attributes(&mut self, variable: &str) {
        for _ in 0..self.list(0x0C) {
            let (name, kind, count) = (self.name(), self.word(), self.word());
            let bytes = self.padded(if kind == CHAR { count } else { 8 * count });
            let text = if kind == CHAR { String::from_utf8(bytes.to_vec()).unwrap() } else { String::new() };
            self.attributes.push((variable.to_string(), name, text));
        }
    }

    pub fn dimension(&self, name: &str) -> usize {
        self.dimensions.iter().find(|(known, _)| known == name).unwrap().1
    }

    pub fn text(&self, variable: &str, name: &str) -> &str {
        let found = self.attributes.iter().find(|(of, known, _)| of == variable && known == name);
        found.map_or("", |(.., text)| text)
    }

    fn values(&self, name: &str, kind: usize) -> (Vec<usize>, &[u8]) {
        let (_, dimensions, found, begin) = self.variables.iter().find(|(known, ..)| known == name).unwrap();
        assert_eq!(*found, kind, "{name}");
        let lengths: Vec<usize> = dimensions.iter().map(|dimension| self.dimensions[*dimension].1).collect();
        let size = lengths.iter().product::<usize>() * if kind == CHAR { 1 } else { 8 };
        (lengths, &self.bytes[*begin..begin + size])
    }

    pub fn numbers(&self, name: &str) -> Vec<f64> {
        let (_, bytes) = self.values(name, DOUBLE);
        bytes.as_chunks().0.iter().map(|number| f64::from_be_bytes(*number)).collect()
    }

    pub fn texts(&self, name: &str) -> Vec<String> {
        let (lengths, bytes) = self.values(name, CHAR);
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().trim_end_matches('\0').to_string();
        bytes.chunks(*lengths.last().unwrap()).map(text).collect()
    }
}

/// An MCAP file without chunks.
pub struct Mcap {
    pub schemas: Vec<String>,
    /// How many messages its statistics count.
    pub messages: u64,
    topics: Vec<(u16, String)>,
    sent: Vec<(u16, u64, Value)>,
}

const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// A text behind its length, and what follows it.
fn text(bytes: &[u8]) -> (String, &[u8]) {
    let (length, rest) = bytes.split_at(4);
    let (text, rest) = rest.split_at(u32::from_le_bytes(length.try_into().unwrap()) as usize);
    (String::from_utf8(text.to_vec()).unwrap(), rest)
}

fn number(bytes: &[u8]) -> u64 {
    u64::from_le_bytes(bytes[..8].try_into().unwrap())
}

fn short(bytes: &[u8]) -> u16 {
    u16::from_le_bytes(bytes[..2].try_into().unwrap())
}

impl Mcap {
    pub fn read(bytes: &[u8]) -> Self {
        assert!(bytes.starts_with(MAGIC) && bytes.ends_with(MAGIC));
        let mut file = Mcap { schemas: Vec::new(), messages: 0, topics: Vec::new(), sent: Vec::new() };
        let (mut at, mut data_end) = (MAGIC.len(), None);
        while at < bytes.len() - MAGIC.len() {
            let (begin, opcode, length) = (at, bytes[at], number(&bytes[at + 1..]) as usize);
            let fields = &bytes[at + 9..at + 9 + length];
            at += 9 + length;
            match opcode {
                0x03 if data_end.is_none() => {
                    let (name, rest) = text(&fields[2..]);
                    let (encoding, rest) = text(rest);
                    let schema: Value = serde_json::from_str(&text(rest).0).unwrap();
                    assert!(encoding == "jsonschema" && schema["title"] == name.as_str());
                    file.schemas.push(name);
                    assert_eq!(usize::from(short(fields)), file.schemas.len());
                }
                0x04 if data_end.is_none() => file.topics.push((short(fields), text(&fields[4..]).0)),
                0x05 => {
                    let json = serde_json::from_slice(&fields[22..]).unwrap();
                    file.sent.push((short(fields), number(&fields[6..]), json));
                }
                0x0F => {
                    assert_eq!(crc32fast::hash(&bytes[..begin]).to_le_bytes(), fields);
                    data_end = Some(at);
                }
                0x0B => file.messages = number(fields),
                0x0E => {
                    let (group, from, length) =
                        (fields[0], number(&fields[1..]) as usize, number(&fields[9..]) as usize);
                    assert!(bytes[from] == group && from + length <= begin);
                }
                0x02 => {
                    assert_eq!(Some(number(fields) as usize), data_end);
                    let check = crc32fast::hash(&bytes[number(fields) as usize..at - 4]);
                    assert_eq!(check.to_le_bytes(), fields[16..]);
                }
                0x01 | 0x03 | 0x04 | 0x0C | 0x0D => {}
                other => panic!("a record of {other:#x}"),
            }
        }
        assert!(file.sent.iter().map(|(_, time, _)| *time).is_sorted());
        file
    }

    /// The messages of a topic.
    pub fn of(&self, topic: &str) -> Vec<&Value> {
        let id = self.topics.iter().find(|(_, known)| known == topic).unwrap().0;
        self.sent.iter().filter(|(channel, ..)| *channel == id).map(|(.., json)| json).collect()
    }
}
