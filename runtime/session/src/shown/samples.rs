//! What is played, in few words.

use super::ValueSource;
use crate::scenario;
use albacore_program::number;
use albacore_sim::Played;

/// How many samples there are, when they come, and what they tell.
pub(super) fn values(played: &Played) -> Vec<(String, String, ValueSource)> {
    let samples = played.samples();
    let (Some(first), Some(last), Some(shape)) = (samples.first(), samples.last(), scenario::shape(played.name()))
    else {
        return Vec::new();
    };
    let ends = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
    let (least, most) = samples.iter().map(|s| s.number).fold((f64::INFINITY, f64::NEG_INFINITY), ends);
    let time = |tick| number::seconds(tick).trim_start().to_string();
    let number = |x| number::brief(&[], &shape, &[x]);
    let told = [
        ("samples", samples.len().to_string()),
        ("times", format!("{} to {}", time(first.tick), time(last.tick))),
        ("numbers", format!("{} to {}", number(least), number(most))),
    ];
    told.into_iter().map(|(name, value)| (name.to_string(), value, ValueSource::Said)).collect()
}
