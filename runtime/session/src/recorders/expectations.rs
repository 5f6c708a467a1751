//! What a test expects of a run, looked at as the run goes.

use super::Recorder;
use super::recorded::Recorded;
use super::results::Results;
use crate::boundary::true_outline;
use crate::plan::Plan;
use albacore_geometry::{OUTLINE_CORNERS, Point};
use albacore_lang::hir::{Counted, OUTCOMES, ReportPart, TrueInput, When, Which};
use albacore_lang::{ExpectProgram, NamedValue, RowProgram, TestProgram};
use albacore_machine::{Evaluation, Event, Outcome};
use albacore_program::{ActivityId, Display, Shape, Text, number};
use albacore_sim::Scenario;
use albacore_trace::{Step, TickRecord, areas};
use albacore_vehicle::{Measurement, NavigationErrors, Truth, seconds};

/// Looks on each tick at what is expected always or while a behavior is active, and at the rest when the run is over.
pub(crate) struct Expectations<'t> {
    test: &'t TestProgram,
    results: Results,
    evaluation: Evaluation,
    /// What is truly so of the vehicle and where it is.
    truth: Truth,
    /// Where the mission believes it to be.
    believed: Option<Point>,
    /// How far off its inertial navigator was last.
    navigation: Option<Box<NavigationErrors>>,
    /// The words of the mission's areas, one after another.
    areas: Vec<f64>,
    /// How often each of what the program asks of payloads was asked.
    asked: Vec<u64>,
    /// What is recorded, where a test asks for that.
    recorded: Option<Recorded>,
    /// The names of the active activities within the mission, as the trace tells them.
    active: String,
    /// For each expectation whether there was a moment to look at it.
    pub looked: Vec<bool>,
    /// For each expectation what was found where it first did not hold.
    pub breaches: Vec<Option<String>>,
}

impl<'t> Expectations<'t> {
    /// Of a run of a row with a seed, that starts there.
    pub fn new(
        plan: &Plan,
        test: &'t TestProgram,
        row: &RowProgram,
        seed: u64,
        (start, delivered): (Point, &[Measurement]),
    ) -> Self {
        let mut evaluation = Evaluation::new(&test.program);
        for (code, to, words) in &row.params {
            evaluation.run(&test.program, code.entry);
            let value = evaluation.words(code.value, *words).to_vec();
            evaluation.set(*to, &value);
        }
        let mut results = Results::new(plan, seed, Some(start));
        for (part, name, _) in &test.slots.reports {
            if let ReportPart::Place(Which::Number(number))
            | ReportPart::Time(Which::Number(number))
            | ReportPart::Value(Which::Number(number), _) = part
            {
                results.reports.want(name, u64::from(*number));
            }
        }
        let counts_recorded = test.slots.counts.iter().any(|(counted, ..)| *counted == Counted::Recorded);
        Expectations {
            test,
            results,
            evaluation,
            truth: Truth { position: start, ..Truth::default() },
            believed: None,
            navigation: None,
            areas: Vec::new(),
            asked: vec![0; plan.program.asks.len()],
            recorded: counts_recorded.then(|| Recorded::new(plan, delivered)),
            active: String::new(),
            looked: vec![false; test.expects.len()],
            breaches: vec![None; test.expects.len()],
        }
    }

    /// Why the run could not go on, and when, if it could not.
    pub fn failure(&self) -> Option<String> {
        let failed = self.results.outcome() == Some(Outcome::Failed);
        failed.then(|| format!("{} ({})", self.results.reason(), self.time()))
    }

    /// Looks at those that are expected now.
    fn look(&mut self, is_due: impl Fn(When<ActivityId>) -> bool) {
        let test = self.test;
        for (i, expect) in test.expects.iter().enumerate().filter(|(_, expect)| is_due(expect.when)) {
            let first = !std::mem::replace(&mut self.looked[i], true);
            if expect.when == When::Once {
                // It is awaited until it has held; what it was at the end is told of what never did.
                let is_awaited = first || self.breaches[i].is_some();
                self.breaches[i] = (is_awaited && !self.holds(expect)).then(String::new);
            } else if self.breaches[i].is_none() {
                self.breaches[i] = self.breach(expect);
            }
        }
    }

    /// At the end: what there is to tell of what never held.
    fn tell_unmet(&mut self) {
        let test = self.test;
        for (i, expect) in test.expects.iter().enumerate().filter(|(_, expect)| expect.when == When::Once) {
            if self.breaches[i].is_some() {
                self.breaches[i] = self.breach(expect).map(|found| format!("never; at the end {found}"));
            }
        }
    }

    /// The last tick that was lived, s.
    fn time_s(&self) -> f64 {
        seconds(self.results.ticks.saturating_sub(1))
    }

    /// How long the run has lasted.
    fn time(&self) -> String {
        number::seconds(self.results.ticks.saturating_sub(1)).trim().to_string()
    }

    /// Whether all that an expectation takes for granted is there, and it holds.
    fn holds(&mut self, expect: &ExpectProgram) -> bool {
        let (test, evaluation) = (self.test, &mut self.evaluation);
        if expect.needs.iter().any(|(need, _)| evaluation.words(*need, 1)[0] == 0.0) {
            return false;
        }
        for (point, answer) in &expect.depths {
            evaluation.run(&test.program, point.entry);
            let words = evaluation.words(point.value, 2);
            let depth = self.results.plan.scenario.environment.bottom.depth_at(Point::new(words[0], words[1]));
            evaluation.set(*answer, &[depth]);
        }
        evaluation.run(&test.program, expect.holds.entry);
        evaluation.words(expect.holds.value, 1)[0] != 0.0
    }

    /// What was found, when an expectation does not hold.
    fn breach(&mut self, expect: &ExpectProgram) -> Option<String> {
        let when = match (expect.when, self.ending()) {
            (When::AtTheEnd(_), Some(ending)) => format!("{}, {ending}", self.time()),
            (When::Always | When::While(_), _) if !self.active.is_empty() => {
                format!("{}, in {}", self.time(), self.active)
            }
            _ => self.time(),
        };
        let test = self.test;
        for (need, without) in &expect.needs {
            if self.evaluation.words(*need, 1)[0] == 0.0 {
                return Some(format!("{without} ({when})"));
            }
        }
        if self.holds(expect) {
            return None;
        }
        let evaluation = &mut self.evaluation;
        let mut found: Vec<String> = Vec::new();
        for NamedValue { name, code, shape, needs } in &expect.watched {
            if needs.iter().any(|need| evaluation.words(*need, 1)[0] == 0.0) {
                found.push(format!("{name} is not there"));
                continue;
            }
            evaluation.run(&test.program, code.entry);
            found.push(format!(
                "{name} = {}",
                told(&test.program.texts, shape, evaluation.words(code.value, shape.words()))
            ));
        }
        let found = if found.is_empty() { "it does not hold".to_string() } else { found.join(", ") };
        Some(format!("{found} ({when})"))
    }

    /// How a run ended that did not come to its own end, and why.
    fn ending(&self) -> Option<String> {
        let outcome = self.results.outcome().filter(|outcome| *outcome != Outcome::Completed)?.name();
        let reason = self.results.reason();
        let why = if reason.is_empty() || reason == outcome { String::new() } else { format!(": {reason}") };
        Some(format!("{}{why}", outcome.replace('_', " ")))
    }

    /// Puts what is true now where the expectations look for it.
    fn set_slots(&mut self) {
        let (slots, results, truth, time) = (&self.test.slots, &self.results, self.truth, self.time_s());
        let position = truth.position;
        let start = results.start.unwrap_or(Point::ORIGIN);
        let outcome = results.outcome().map(Outcome::name);
        let nearest = results.nearest_source(results.reports.latest.unwrap_or(position));
        let evaluation = &mut self.evaluation;
        evaluation.set(slots.position, &[position.north, position.east]);
        if let Some(slot) = slots.beacon {
            let beacon = results.plan.scenario.environment.beacon.as_ref().map(|beacon| beacon.position(time));
            evaluation.set(slot, &if_any(beacon));
        }
        for (name, slot) in &slots.boundaries {
            let outline = true_outline(&results.slicks, name.as_deref(), position, time);
            evaluation.set_area(*slot, OUTLINE_CORNERS, outline.as_ref());
        }
        for (input, slot) in &slots.inputs {
            let known = Known { truth: &truth, believed: self.believed, navigation: self.navigation.as_deref() };
            evaluation.set(*slot, &true_words(*input, &known, time, &results.plan.scenario));
        }
        evaluation.set(slots.start, &[start.north, start.east]);
        evaluation.set(slots.deepest, &if_any(results.deepest));
        evaluation.set(slots.time, &[time]);
        for (slot, area) in slots.areas.iter().zip(areas(&self.areas)) {
            evaluation.set(*slot, area);
        }
        for (name, slot) in OUTCOMES.iter().zip(slots.outcomes) {
            evaluation.set(slot, &[f64::from(u8::from(outcome == Some(name)))]);
        }
        for (why, slot) in &slots.reasons {
            let is_why = outcome == Some(Outcome::Aborted.name()) && results.reason() == why;
            evaluation.set(*slot, &[f64::from(u8::from(is_why))]);
        }
        evaluation.set(slots.nearest_source, &if_any(nearest));
        for (name, slot) in &slots.sources {
            evaluation.set(*slot, &if_any(results.source(name)));
        }
        for (counted, name, slot) in &slots.counts {
            let asks = || results.plan.program.asks.iter().zip(&self.asked).find(|(ask, _)| *ask == name);
            let count = match counted {
                Counted::Asks => asks().map_or(0, |(_, count)| *count),
                Counted::Recorded => self.recorded.as_ref().map_or(0, |recorded| recorded.samples(name)),
            };
            evaluation.set(*slot, &[count as f64]);
        }
        for (part, name, slot) in &slots.reports {
            let named = results.reports.named(name);
            let told = |which: &Which| match which {
                Which::Number(number) => named?.number(u64::from(*number)),
                Which::Last => Some(&named?.last),
            };
            let words = match part {
                ReportPart::Value(which, label) => results.labelled(name, label, told(which)),
                ReportPart::Place(which) => if_any(told(which).and_then(|report| report.place)).to_vec(),
                ReportPart::Time(which) => told(which).map_or(vec![0.0; 2], |report| vec![1.0, report.t_s]),
                ReportPart::Count => vec![named.map_or(0.0, |named| named.count as f64)],
            };
            evaluation.set(*slot, &words);
        }
    }
}

impl Recorder for Expectations<'_> {
    fn take(&mut self, record: &TickRecord) {
        self.results.take(record);
        if let Some(recorded) = &mut self.recorded {
            recorded.take(record);
        }
        for event in &record.events {
            if let Event::Asked(action) = event
                && let Some(count) = self.asked.get_mut(*action as usize)
            {
                *count += 1;
            }
        }
        self.truth = record.truth.unwrap_or(self.truth);
        self.believed = record.believed.or(self.believed);
        if record.navigation.is_some() {
            self.navigation.clone_from(&record.navigation);
        }
        if !record.areas.is_empty() {
            self.areas.clone_from(&record.areas);
        }
        // What has been left with the end is not active in its tick any more.
        let within = record.active.get(1..).unwrap_or_default();
        let due = |when| match (&record.step, when) {
            (Step::Wait, _) | (Step::Tick, When::AtTheEnd(_)) | (Step::End(_), When::While(_)) => false,
            // On the first tick nothing has happened yet, and the last one is looked at with the end.
            (Step::Tick, When::Always | When::Once) => record.tick > 0 && !record.is_last,
            (Step::Tick, When::While(id)) => within.contains(&id),
            (Step::End(_), When::Always | When::Once | When::AtTheEnd(_)) => true,
        };
        if self.test.expects.iter().any(|expect| due(expect.when)) {
            let activities = &self.results.plan.program.activities;
            let name = |id: &ActivityId| activities.get(*id as usize).map_or("?", |activity| activity.name.as_str());
            self.active = within.iter().map(name).collect::<Vec<_>>().join(" > ");
            self.set_slots();
            self.look(due);
        }
        if matches!(record.step, Step::End(_)) {
            self.tell_unmet();
        }
    }
}

/// A value as it is told, one below its unit with more decimals: it may be held to some hundredths. A time that would be told as one that it only is
/// very near to, as 5.0 - 4.1 is to 0.9, is told with all its digits: times are held to whole tenths.
fn told(texts: &[Text], shape: &Shape, words: &[f64]) -> String {
    match (shape, words) {
        (Shape::Quantity(display), [x]) if display.unit == "s" && is_nearly_round(*x) => {
            format!("{x} {}", display.unit)
        }
        (Shape::Quantity(display), [x]) if x.abs() < display.scale && display.unit != "%" => {
            let finer = Display { decimals: display.decimals + 2, ..display.clone() };
            number::value(&Shape::Quantity(finer), words)
        }
        _ => number::value_with(texts, shape, words),
    }
}

/// Whether a number is not the one of three decimals to which it is nearer than anything that is measured.
fn is_nearly_round(x: f64) -> bool {
    let round = (x * 1e3).round() / 1e3;
    x != round && (x - round).abs() < 1e-9
}

/// What is known of a tick beside what the mission knows.
struct Known<'a> {
    truth: &'a Truth,
    /// Where the mission believes the vehicle to be.
    believed: Option<Point>,
    navigation: Option<&'a NavigationErrors>,
}

/// The words of what an input would truly tell at a time (s of the run), in SI units.
fn true_words(input: TrueInput, known: &Known, time: f64, scenario: &Scenario) -> Vec<f64> {
    let truth = known.truth;
    let of =
        |value: fn(&NavigationErrors) -> f64| known.navigation.map_or(vec![0.0; 2], |errors| vec![1.0, value(errors)]);
    let layers = || scenario.environment.stratification.at(truth.position, truth.depth, time);
    match input {
        TrueInput::Depth => vec![truth.depth],
        TrueInput::Altitude => vec![truth.altitude],
        TrueInput::Heading => vec![truth.heading.radians()],
        TrueInput::Course => vec![truth.course.radians()],
        TrueInput::Speed => vec![truth.speed_over_ground],
        TrueInput::Temperature => vec![layers().0],
        TrueInput::Salinity => vec![layers().1],
        TrueInput::Chemical => vec![truth.concentration],
        TrueInput::Flow => vec![truth.flow.north, truth.flow.east],
        TrueInput::PositionError => vec![known.believed.map_or(0.0, |believed| believed.distance(truth.position))],
        TrueInput::RollError => of(|errors| errors.of(NavigationErrors::ATTITUDE)[0].abs()),
        TrueInput::PitchError => of(|errors| errors.of(NavigationErrors::ATTITUDE)[1].abs()),
        TrueInput::HeadingError => of(|errors| errors.of(NavigationErrors::ATTITUDE)[2].abs()),
        TrueInput::DepthError => of(|errors| errors.of(NavigationErrors::PLACE)[2].abs()),
        TrueInput::GyroBiasError => of(|errors| errors.greatest(NavigationErrors::GYRO_BIAS)),
        TrueInput::AccelerometerBiasError => of(|errors| errors.greatest(NavigationErrors::ACCELEROMETER_BIAS)),
        TrueInput::PositionSigma => of(|errors| {
            let [north, east, _] = errors.expected(NavigationErrors::PLACE);
            (0.5 * (north * north + east * east)).sqrt()
        }),
    }
}

/// The words of a place that may be absent.
fn if_any(place: Option<Point>) -> [f64; 3] {
    place.map_or([0.0; 3], |place| [1.0, place.north, place.east])
}
