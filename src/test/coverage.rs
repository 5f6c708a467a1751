//! `--coverage`: what tests come to of the missions that they run, as a person and as a program reads it.

use crate::output::Lines;
use albacore_session::{Coverage, CoveredBehavior, CoveredTransition, CoveredUnit, Part};
use serde::Serialize;

/// Coverage, and what is counted of it.
#[derive(Serialize)]
pub struct Told<'a> {
    behaviors: ToldPart,
    transitions: ToldPart,
    /// The least that is wanted, in per cent, and whether it is reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    threshold: Option<u8>,
    reached: bool,
    units: Vec<ToldUnit<'a>>,
    /// Of the standard library, where that is not counted.
    standard_library: Vec<ToldUnit<'a>>,
    #[serde(skip)]
    library: (Part, Part),
}

/// How many of how many, and the share of it in per cent, rounded down to a tenth.
#[derive(Clone, Copy, Serialize)]
struct ToldPart {
    count: u64,
    of: u64,
    percent: f64,
    #[serde(skip)]
    part: Part,
}

/// A mission or a strategy with what is in it.
#[derive(Serialize)]
struct ToldUnit<'a> {
    #[serde(flatten)]
    unit: &'a CoveredUnit,
    behaviors: Vec<&'a CoveredBehavior>,
    transitions: Vec<&'a CoveredTransition>,
}

impl ToldPart {
    fn new(part: Part) -> Self {
        let Part { count, of } = part;
        ToldPart { count, of, percent: part.per_mille() as f64 / 10.0, part }
    }
}

impl<'a> Told<'a> {
    /// What is told of some coverage; with `library` the standard library is counted, too.
    pub fn new(coverage: &'a Coverage, threshold: Option<u8>, library: bool) -> Self {
        let is_counted = |unit: &CoveredUnit| library || !unit.is_standard;
        let (entered, fired) = coverage.total(is_counted);
        let units = |counted: bool| -> Vec<ToldUnit<'a>> {
            let of_it = coverage.units().filter(|unit| is_counted(unit) == counted);
            let told = of_it.map(|unit| ToldUnit {
                unit,
                behaviors: unit.behaviors().collect(),
                transitions: unit.transitions().collect(),
            });
            told.collect()
        };
        let percent = u64::from(threshold.unwrap_or(0));
        Told {
            behaviors: ToldPart::new(entered),
            transitions: ToldPart::new(fired),
            threshold,
            reached: entered.reaches(percent) && fired.reaches(percent),
            units: units(true),
            standard_library: units(false),
            library: coverage.total(|unit| !is_counted(unit)),
        }
    }

    /// As a person reads it.
    pub fn print(&self) {
        let mut lines = Lines::default();
        lines.add("coverage");
        self.units.iter().for_each(|unit| unit.tell(&mut lines, "  "));
        let (behaviors, transitions) = (self.behaviors.part, self.transitions.part);
        lines.add(&format!("  in all: behaviors {}, transitions {}", share(behaviors), share(transitions)));
        if !self.standard_library.is_empty() {
            let (behaviors, transitions) = self.library;
            let of_library = format!("behaviors {}, transitions {}", share(behaviors), share(transitions));
            lines.add(&format!("  of the standard library, which is not counted: {of_library}"));
            self.standard_library.iter().for_each(|unit| unit.tell(&mut lines, "    "));
        }
        lines.print();
    }

    /// What is less than is wanted, if anything is.
    pub fn missed(&self) -> Option<String> {
        let wanted = self.threshold.filter(|_| !self.reached)?;
        let parts =
            [("behaviors", "were entered", self.behaviors.part), ("transitions", "fired", self.transitions.part)];
        let less = parts.into_iter().filter(|(.., part)| !part.reaches(u64::from(wanted)));
        let less: Vec<String> =
            less.map(|(what, became, part)| format!("of the {what} {} {became}", share(part))).collect();
        Some(format!("the tests cover less than {wanted} %: {}", less.join(", and ")))
    }
}

impl ToldUnit<'_> {
    fn tell(&self, lines: &mut Lines, margin: &str) {
        let CoveredUnit { kind, name, place, .. } = self.unit;
        let transitions = match self.unit.fired() {
            Part { of: 0, .. } => String::new(),
            Part { count, of } => format!(", transitions {count} of {of}"),
        };
        let Part { count, of } = self.unit.entered();
        lines.add(&format!("{margin}{kind} {name}  {place}  behaviors {count} of {of}{transitions}"));
        for CoveredBehavior { name, place, .. } in self.behaviors.iter().filter(|behavior| !behavior.entered) {
            lines.add(&format!("{margin}  never entered  {name}  {place}"));
        }
        for CoveredTransition { from, rule, place, .. } in self.transitions.iter().filter(|rule| !rule.fired) {
            lines.add(&format!("{margin}  never fired    {from} {rule}  {place}"));
        }
    }
}

/// `3 of 4 (75.0 %)`; of nothing there is no share.
fn share(part: Part) -> String {
    let Part { count, of } = part;
    let tenths = part.per_mille();
    match of {
        0 => "0 of 0".to_string(),
        _ => format!("{count} of {of} ({}.{} %)", tenths / 10, tenths % 10),
    }
}
