//! A snapshot in the journal: of each reading only the numbers up to the last that is not zero, which halves the file.

use albacore_vehicle::{Answer, Control, Lag, Reading, Sample, Snapshot};
use serde::de::Error;
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

struct Samples<'a>(&'a [Sample]);
struct Short<'a>(&'a Sample);

pub(crate) fn serialize<S: Serializer>(snapshot: &Snapshot, serializer: S) -> Result<S::Ok, S::Error> {
    let mut parts = serializer.serialize_tuple(5)?;
    parts.serialize_element(&Samples(&snapshot.samples))?;
    parts.serialize_element(&snapshot.control)?;
    parts.serialize_element(&snapshot.lag)?;
    parts.serialize_element(&snapshot.aground)?;
    parts.serialize_element(&snapshot.answers)?;
    parts.end()
}

impl Serialize for Samples<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(Short))
    }
}

impl Serialize for Short<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Sample { measurement, reading } = self.0;
        // By its bits: a negative zero is to come back as one.
        let used = reading.iter().rposition(|x| x.to_bits() != 0).map_or(0, |last| last + 1);
        (measurement, &reading[..used]).serialize(serializer)
    }
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Snapshot, D::Error> {
    let (samples, control, lag, aground, answers) =
        <(Vec<(u16, Vec<f64>)>, Control, Lag, bool, Vec<Answer>)>::deserialize(deserializer)?;
    let mut snapshot = Snapshot { samples: Vec::with_capacity(samples.len()), control, lag, aground, answers };
    for (measurement, numbers) in samples {
        if numbers.len() > Reading::default().len() {
            return Err(D::Error::invalid_length(numbers.len(), &"a reading's numbers"));
        }
        snapshot.push(measurement, &numbers);
    }
    Ok(snapshot)
}
