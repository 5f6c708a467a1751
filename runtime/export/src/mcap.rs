//! MCAP, uncompressed and without chunks, with a summary at its end. Messages are JSON: the schemas of Foxglove by their names where there
//! is one (`foxglove.LocationFix`, `foxglove.Log`), and `albacore.State` and `albacore.Report` for the rest.

mod messages;

use crate::exported::Exported;
use messages::{CHANNELS, Messages, SCHEMAS, schema};

/// How a file begins and ends.
const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// What a record is, by its first byte.
mod opcode {
    pub const HEADER: u8 = 0x01;
    pub const FOOTER: u8 = 0x02;
    pub const SCHEMA: u8 = 0x03;
    pub const CHANNEL: u8 = 0x04;
    pub const MESSAGE: u8 = 0x05;
    pub const STATISTICS: u8 = 0x0B;
    pub const METADATA: u8 = 0x0C;
    pub const METADATA_INDEX: u8 = 0x0D;
    pub const SUMMARY_OFFSET: u8 = 0x0E;
    pub const DATA_END: u8 = 0x0F;
}

/// A field of a record, in its bytes.
#[derive(Default)]
struct Fields(Vec<u8>);

impl Fields {
    fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    fn u16(self, number: u16) -> Self {
        self.bytes(&number.to_le_bytes())
    }

    fn u32(self, number: u32) -> Self {
        self.bytes(&number.to_le_bytes())
    }

    fn u64(self, number: u64) -> Self {
        self.bytes(&number.to_le_bytes())
    }

    /// Bytes behind their number.
    fn counted(self, bytes: &[u8]) -> Self {
        self.u32(bytes.len() as u32).bytes(bytes)
    }

    fn text(self, text: &str) -> Self {
        self.counted(text.as_bytes())
    }
}

/// The file as it grows.
struct File {
    out: Vec<u8>,
}

impl File {
    /// Adds a record; gives where it begins.
    fn record(&mut self, opcode: u8, fields: &Fields) -> u64 {
        let begin = self.out.len() as u64;
        self.out.push(opcode);
        self.out.extend_from_slice(&(fields.0.len() as u64).to_le_bytes());
        self.out.extend_from_slice(&fields.0);
        begin
    }

    fn end(&self) -> u64 {
        self.out.len() as u64
    }

    /// Adds the records of one kind in the summary; gives where they stand.
    fn group(&mut self, opcode: u8, records: &[Fields]) -> (u8, u64, u64) {
        let begin = self.end();
        records.iter().for_each(|fields| _ = self.record(opcode, fields));
        (opcode, begin, self.end() - begin)
    }
}

/// What is counted of the messages.
struct Counted {
    first_ns: u64,
    last_ns: u64,
    of_channels: [u64; CHANNELS.len()],
}

/// The file.
pub fn make(run: &Exported) -> Vec<u8> {
    let mut file = File { out: MAGIC.to_vec() };
    file.record(opcode::HEADER, &Fields::default().text("").text(&format!("Albacore {}", run.about.version)));
    let schemas: Vec<Fields> = (0..SCHEMAS.len()).map(|at| schema_record(run, at)).collect();
    let channels: Vec<Fields> = (0..CHANNELS.len()).map(channel_record).collect();
    file.group(opcode::SCHEMA, &schemas);
    file.group(opcode::CHANNEL, &channels);
    let facts = run.about.facts();
    let facts = facts.iter().fold(Fields::default(), |fields, (name, fact)| fields.text(name).text(fact));
    let metadata = file.record(opcode::METADATA, &Fields::default().text("run").counted(&facts.0));
    let metadata_bytes = file.end() - metadata;
    let counted = messages(&mut file, run);
    let check = crc32fast::hash(&file.out);
    file.record(opcode::DATA_END, &Fields::default().u32(check));

    let summary = file.end();
    let count: u64 = counted.of_channels.iter().sum();
    let of_channels = (0u16..).zip(counted.of_channels).filter(|(_, count)| *count > 0);
    let of_channels = of_channels.fold(Fields::default(), |fields, (id, count)| fields.u16(id).u64(count));
    let statistics = Fields::default()
        .u64(count)
        .u16(SCHEMAS.len() as u16)
        .u32(CHANNELS.len() as u32)
        .u32(0)
        .u32(1)
        .u32(0)
        .u64(counted.first_ns)
        .u64(counted.last_ns)
        .counted(&of_channels.0);
    let index = Fields::default().u64(metadata).u64(metadata_bytes).text("run");
    let groups = [
        file.group(opcode::SCHEMA, &schemas),
        file.group(opcode::CHANNEL, &channels),
        file.group(opcode::STATISTICS, &[statistics]),
        file.group(opcode::METADATA_INDEX, &[index]),
    ];
    let offsets = file.end();
    for (opcode, begin, length) in groups {
        file.record(opcode::SUMMARY_OFFSET, &Fields::default().bytes(&[opcode]).u64(begin).u64(length));
    }
    close(file, summary, offsets)
}

/// The footer, whose check is of the summary and of all of the footer before it.
fn close(mut file: File, summary: u64, offsets: u64) -> Vec<u8> {
    let begin = file.record(opcode::FOOTER, &Fields::default().u64(summary).u64(offsets).u32(0)) as usize;
    let check_at = begin + 1 + size_of::<u64>() + 2 * size_of::<u64>();
    let check = crc32fast::hash(file.out.get(summary as usize..check_at).unwrap_or_default());
    file.out.truncate(check_at);
    file.out.extend_from_slice(&check.to_le_bytes());
    file.out.extend_from_slice(MAGIC);
    file.out
}

/// Schemas are counted from 1: 0 says that there is none.
fn schema_record(run: &Exported, at: usize) -> Fields {
    let id = at as u16 + 1;
    Fields::default().u16(id).text(SCHEMAS[at]).text("jsonschema").text(&schema(run, at))
}

fn channel_record(at: usize) -> Fields {
    let (topic, schema) = CHANNELS[at];
    Fields::default().u16(at as u16).u16(schema as u16 + 1).text(topic).text("json").counted(&[])
}

fn messages(file: &mut File, run: &Exported) -> Counted {
    let mut counted = Counted { first_ns: 0, last_ns: 0, of_channels: [0; CHANNELS.len()] };
    let messages = Messages::new(run);
    run.each_moment(|moment| {
        // Nothing was before 1970.
        let ns = u64::try_from(run.about.moment_ms(moment.tick)).unwrap_or(0).saturating_mul(1_000_000);
        for (channel, json) in messages.of(&moment) {
            let sequence = counted.of_channels[channel] as u32;
            if counted.of_channels.iter().all(|count| *count == 0) {
                counted.first_ns = ns;
            }
            counted.of_channels[channel] += 1;
            counted.last_ns = ns;
            let fields = Fields::default().u16(channel as u16).u32(sequence).u64(ns).u64(ns).bytes(json.as_bytes());
            file.record(opcode::MESSAGE, &fields);
        }
    });
    counted
}
