//! What is played, in few words.

use super::ValueSource;
use crate::scenario;
use albacore_program::number;
use albacore_sim::Played;

/// How many samples there are, when they come, and what they tell.
pub(super) fn values(played: &Played) -> Vec<(String, String, ValueSource)> {
    let samples = played.samples();
    let (Some(first), Some(last), Some(parts)) = (samples.first(), samples.last(), scenario::parts(played.name()))
    else {
        return Vec::new();
    };
    let (mut least, mut most) = (first.reading, first.reading);
    for reading in samples.iter().map(|sample| sample.reading) {
        least.iter_mut().zip(reading).for_each(|(least, x)| *least = least.min(x));
        most.iter_mut().zip(reading).for_each(|(most, x)| *most = most.max(x));
    }
    let time = |tick| number::seconds(tick).trim_start().to_string();
    let mut told =
        vec![("samples", samples.len().to_string()), ("times", format!("{} to {}", time(first.tick), time(last.tick)))];
    let mut at = 0;
    for part in &parts {
        let words = at..at + part.shape.words() as usize;
        at = words.end;
        let number = |of: &[f64]| number::brief(&[], &part.shape, of.get(words.clone()).unwrap_or_default());
        told.push((part.label.unwrap_or("numbers"), format!("{} to {}", number(&least), number(&most))));
    }
    told.into_iter().map(|(name, value)| (name.to_string(), value, ValueSource::Said)).collect()
}
