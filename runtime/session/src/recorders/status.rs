//! How a run stands, in a line for who looks on.

use super::Recorder;
use albacore_geometry::Point;
use albacore_program::seen::one_line;
use albacore_trace::{Step, TickRecord};
use albacore_vehicle::measurements::{self, ALTITUDE, BATTERY, DEPTH};
use albacore_vehicle::{Measurement, TICK_S, seconds};
use std::fmt::Write;

/// What was measured longer ago than this is not told as if it were so, ticks: 10 s.
const FRESH_TICKS: u64 = 100;
/// Letters of the chain of what is active; of a longer one its end is told.
const CHAIN_LETTERS_MAX: usize = 48;

/// How a run stands.
pub struct Status {
    tick: u64,
    position: Option<Point>,
    depth: Latest,
    altitude: Latest,
    battery: Latest,
    /// The round trip over the link, ticks; 0 where there is none, or it is not known.
    round_trip: u64,
}

/// The latest number of a measurement.
#[derive(Default)]
struct Latest {
    /// Its number among the vehicle's measurements, if it has it.
    measurement: Option<usize>,
    last: Option<(u64, f64)>,
}

impl Latest {
    fn of(delivered: &[Measurement], number: u16) -> Self {
        let is_it = |measurement: &Measurement| measurement.name == measurements::name(number);
        Latest { measurement: delivered.iter().position(is_it), last: None }
    }

    /// The number in words; a dash where it is old, nothing where the vehicle does not measure it.
    fn told(&self, tick: u64, words: impl Fn(f64) -> String) -> Option<String> {
        self.measurement?;
        let fresh = self.last.filter(|(then, _)| then + FRESH_TICKS >= tick);
        Some(fresh.map_or("-".to_string(), |(_, x)| words(x)))
    }
}

impl Status {
    /// Of a run on a vehicle with these measurements.
    pub(crate) fn new(delivered: &[Measurement]) -> Self {
        let of = |number| Latest::of(delivered, number);
        Status {
            tick: 0,
            position: None,
            depth: of(DEPTH),
            altitude: of(ALTITUDE),
            battery: of(BATTERY),
            round_trip: 0,
        }
    }

    /// The last tick that was taken in.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// All of it, on one line, with what is under way from outside in.
    pub fn line(&self, under_way: &[String]) -> String {
        let mut line = format!("{:.0} s  {}", seconds(self.tick), chain(under_way));
        if let Some(at) = self.position {
            // Adding a zero takes the sign from one.
            let metres = |x: f64| (x * 10.0).round() / 10.0 + 0.0;
            let _ = write!(line, "  at ({:.1}, {:.1}) m", metres(at.north), metres(at.east));
        }
        let metres = |x: f64| format!("{x:.1} m");
        let parts = [
            ("depth", self.depth.told(self.tick, metres)),
            ("altitude", self.altitude.told(self.tick, metres)),
            ("battery", self.battery.told(self.tick, |x| format!("{:.0} %", 100.0 * x))),
            ("round trip", (self.round_trip > 0).then(|| format!("{:.1} s", self.round_trip as f64 * TICK_S))),
        ];
        for (name, told) in parts {
            if let Some(told) = told {
                let _ = write!(line, "  {name} {told}");
            }
        }
        one_line(&line)
    }
}

/// The chain of what is active, or its end.
fn chain(under_way: &[String]) -> String {
    let whole = under_way.join(" > ");
    let beyond = whole.chars().count().saturating_sub(CHAIN_LETTERS_MAX);
    if beyond == 0 { whole } else { format!("…{}", whole.chars().skip(beyond + 1).collect::<String>()) }
}

impl Recorder for Status {
    fn take(&mut self, record: &TickRecord) {
        if !matches!(record.step, Step::Tick) {
            return;
        }
        self.tick = record.tick;
        self.position = record.believed;
        self.round_trip = record.snapshot.lag.round_trip;
        for sample in &record.snapshot.samples {
            let measurement = Some(usize::from(sample.input_measurement()));
            for latest in [&mut self.depth, &mut self.altitude, &mut self.battery] {
                if latest.measurement == measurement {
                    latest.last = Some((record.tick, sample.reading[0]));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Latest, Status, chain};
    use albacore_geometry::Point;

    #[test]
    fn a_line_tells_what_is_known_and_what_is_old() {
        let latest = |last| Latest { measurement: Some(0), last };
        let mut status = Status {
            tick: 1234,
            position: Some(Point::new(-0.01, 45.66)),
            depth: latest(Some((1230, 3.04))),
            altitude: latest(Some((1000, 7.0))),
            battery: Latest::default(),
            round_trip: 4,
        };
        let under_way = ["box".to_string(), "leg".to_string()];
        assert_eq!(
            status.line(&under_way),
            "123 s  box > leg  at (0.0, 45.7) m  depth 3.0 m  altitude -  round trip 0.4 s"
        );
        (status.battery, status.round_trip) = (latest(Some((1234, 0.873))), 0);
        assert!(status.line(&under_way).ends_with("altitude -  battery 87 %"));
    }

    #[test]
    fn of_a_long_chain_the_end_is_told() {
        let told = chain(&["x".repeat(100), "inner".to_string()]);
        assert!(told.starts_with('…') && told.ends_with(" > inner") && told.chars().count() == 48, "{told}");
    }
}
