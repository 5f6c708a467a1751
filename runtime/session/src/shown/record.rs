//! What a recorded plume brings into a world, of the clauses that it takes the place of.

use super::clause_formatter::{ClauseFormatter, vector};
use super::{ShownClause, ValueSource};
use albacore_program::{Display, Shape, number};
use albacore_sim::Scenario;

/// Tells them after `recorded_plume`, with what of each is in the record.
pub(super) fn push_recorded(world: &Scenario, formatter: &ClauseFormatter, shown: &mut Vec<ShownClause>) {
    let Some(recorded) = &world.environment.recording else { return };
    let (recording, source) = (&recorded.recording, recorded.source());
    if let Some(clause) = shown.last_mut() {
        clause.values.extend(values([("lasts", quantity("s", recording.duration()))]));
    }
    let mut brings =
        |name: &str, values| shown.push(ShownClause { name: name.into(), source: ValueSource::Record, values });
    brings("region", values([("area", formatter.area(recording.area().corners().iter().copied()))]));
    brings("flow", values([("mean", vector(&display("m/s"), recording.mean_flow()))]));
    let (growth, initial_radius) = (recording.growth(), recording.initial_radius());
    brings("plume", values([("growth", quantity("m2/s", growth)), ("initial_radius", quantity("m", initial_radius))]));
    brings(
        "source",
        values([
            ("name", format!("\"{}\"", source.name)),
            ("at", formatter.point(source.at)),
            ("rate", quantity("Hz", source.rate)),
            ("peak", quantity("%", source.peak)),
            ("peak_age", quantity("s", source.reference_age)),
        ]),
    );
}

fn values<const N: usize>(values: [(&str, String); N]) -> Vec<(String, String, ValueSource)> {
    values.into_iter().map(|(name, value)| (name.to_string(), value, ValueSource::Record)).collect()
}

fn quantity(unit: &str, si: f64) -> String {
    number::brief(&[], &Shape::Quantity(display(unit)), &[si])
}

fn display(unit: &str) -> Display {
    Display { unit: unit.into(), scale: if unit == "%" { 0.01 } else { 1.0 }, decimals: 4 }
}
