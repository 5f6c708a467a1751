//! A scenario as a person looks at it: every number in force, those of the library's defaults too, and a picture.

mod view;

use crate::files::Files;
use crate::plan::PlanError;
use crate::scenario;
use crate::world::{self, place_of};
use albacore_geometry::{Point, TangentFrame, Vector};
use albacore_lang::source::Source;
use albacore_lang::{ScenarioClause, ScenarioProgram, ScenarioValue, Script, doc};
use albacore_program::{AREA_CORNER_WORDS, Shape, number};
use albacore_sim::{Grid, Ground, Scenario, Simulator};
use std::path::Path;

/// A scenario, laid open.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Its name.
    pub name: String,
    /// What it says, in order, and after it what holds without being said.
    pub clauses: Vec<ShownClause>,
    /// Clauses of which there is none.
    pub absent: Vec<String>,
    /// Filaments alive when the run begins; none without a plume.
    pub filaments: Option<usize>,
    /// The world at the start of a run, as SVG.
    pub svg: String,
}

/// A clause and its numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShownClause {
    /// Its name; of a value of another clause, both: `vehicle kinematic`.
    pub name: String,
    /// Whether the scenario says it.
    pub is_said: bool,
    /// Its parameters and their values (of an area each corner, of a list each item on a line), and whether the scenario says nothing of them.
    pub values: Vec<(String, String, bool)>,
}

impl Shown {
    /// A scenario that the script knows, by its name, else the only one of its own or the one that its mission runs in; its
    /// picture is that of a seed.
    pub fn new(script: &Script, file: &str, wanted: Option<&str>, seed: u64) -> Result<Self, PlanError> {
        let wanted = chosen(script, file, wanted)?;
        let (lowered, understood) = world::scenario(script, &wanted, place_of(script, &wanted)?)?;
        let world = understood.world;
        let simulator = Simulator::new(&world, seed).map_err(|error| world::cannot_be(&error))?;
        let defaults = Defaults::read();
        let mut clauses = Vec::new();
        let words = scenario::words(&lowered);
        let teller = Teller { words: &words, frame: lowered.origin.map(|origin| TangentFrame { origin }) };
        for clause in &lowered.clauses {
            teller.tell(clause, "", true, &mut clauses);
            if let ("bottom_grid", Ground::Grid(grid), Some(told)) =
                (clause.name.as_str(), &world.bottom.ground, clauses.last_mut())
            {
                told.values.extend(teller.survey(grid));
            }
        }
        let said = |name: &str| lowered.clauses.iter().any(|clause| clause.name == name);
        let mut absent = Vec::new();
        for name in &defaults.names {
            match defaults.in_force(name) {
                _ if said(name) => {}
                Some(clause) => defaults.teller().tell(clause, "", false, &mut clauses),
                None => absent.push(name.clone()),
            }
        }
        let filaments = world.plume.is_some().then(|| simulator.filaments().count());
        let svg = view::svg(&lowered.name, &world, &simulator, seed);
        Ok(Shown { name: lowered.name, clauses, absent, filaments, svg })
    }
}

/// Which scenario of a script is meant.
fn chosen(script: &Script, file: &str, wanted: Option<&str>) -> Result<String, PlanError> {
    let own: Vec<&str> = script.own_scenarios().collect();
    let of_mission = || script.missions().find_map(|mission| mission.scenario.clone());
    let only = || if let [only] = own.as_slice() { Some((*only).to_string()) } else { None };
    wanted.map(str::to_string).or_else(only).or_else(of_mission).ok_or_else(|| {
        let help = format!("name it: `{file}#NAME`; there is {}", script.scenarios().collect::<Vec<_>>().join(", "));
        PlanError::Asked(format!("which scenario of `{file}` is to be shown?"), Some(help))
    })
}

/// The clauses of the standard library, with all that they say of themselves.
struct Defaults {
    /// Those that stand on a line of their own, in order.
    names: Vec<String>,
    /// Each as it is when it is given nothing, where it needs nothing.
    probe: Option<ScenarioProgram>,
    words: Vec<f64>,
}

impl Defaults {
    /// Asks the library's own words, through the same steps as any scenario.
    fn read() -> Self {
        let everywhere = crate::standard_modules().filter(|module| crate::is_known_everywhere(module));
        let scripts = everywhere.filter_map(|module| crate::load_or_module(module.as_ref()).ok());
        let pages = scripts.filter_map(|script| script.sources.iter().next().and_then(doc::page));
        let declared: Vec<doc::Declaration> = pages.flat_map(|page| page.declarations).collect();
        let clauses = || declared.iter().filter(|d| d.word == "clause");
        // What needs no number can be left to itself; the kinds of other clauses may be left out.
        let kinds: Vec<&String> = clauses().filter_map(|d| d.result.as_ref()).collect();
        let alone = |d: &&doc::Declaration| d.params.iter().all(|p| p.default.is_some() || kinds.contains(&&p.ty));
        let lines: String =
            clauses().filter(alone).filter(|d| d.result.is_none()).map(|d| format!("    {}()\n", d.name)).collect();
        let text = format!("scenario defaults {{\n{lines}}}\n");
        let script = crate::load_text(Source { name: "defaults.alb".into(), text: text.into() });
        let probe = script.scenario("defaults", None).and_then(Result::ok);
        let words = probe.as_ref().map_or_else(Vec::new, scenario::words);
        Defaults { names: clauses().filter(|d| d.result.is_none()).map(|d| d.name.clone()).collect(), probe, words }
    }

    fn teller(&self) -> Teller<'_> {
        Teller { words: self.words.as_slice(), frame: None }
    }

    /// A clause as it is when it is given nothing, if to say it so changes nothing: then it holds without being said.
    fn in_force(&self, name: &str) -> Option<&ScenarioClause> {
        let probe = self.probe.as_ref()?;
        let clause = probe.clauses.iter().find(|clause| clause.name == name)?;
        let alone = ScenarioProgram { clauses: vec![clause.clone()], ..probe.clone() };
        let understood = scenario::scenario(&alone, &Files::around(Path::new("")));
        understood.is_ok_and(|understood| understood.world == Scenario::default()).then_some(clause)
    }
}

/// Tells clauses of one scenario.
struct Teller<'a> {
    words: &'a [f64],
    frame: Option<TangentFrame>,
}

impl Teller<'_> {
    /// Adds a clause, and after it the clauses that are its values.
    fn tell(&self, clause: &ScenarioClause, outer: &str, is_said: bool, told: &mut Vec<ShownClause>) {
        let name = if outer.is_empty() { clause.name.clone() } else { format!("{outer} {}", clause.name) };
        let values = clause.args.iter().filter_map(|arg| {
            let text = self.value(&arg.value)?;
            Some((arg.name.clone(), text, arg.is_default))
        });
        told.push(ShownClause { name: name.clone(), is_said, values: values.collect() });
        for arg in &clause.args {
            if let ScenarioValue::Clause(nested) = &arg.value
                && !nested.args.is_empty()
            {
                self.tell(nested, &name, is_said, told);
            }
        }
    }

    fn value(&self, value: &ScenarioValue) -> Option<String> {
        match value {
            ScenarioValue::Text(text) => Some(format!("\"{text}\"")),
            ScenarioValue::Words(slot, shape) => {
                let words = self.words.get(*slot as usize..).unwrap_or(&[]);
                Some(self.text(shape, words.get(..shape.words() as usize).unwrap_or(words)))
            }
            // What has no parameters is said by its name.
            ScenarioValue::Clause(value) => value.args.is_empty().then(|| value.name.clone()),
        }
    }

    fn text(&self, shape: &Shape, words: &[f64]) -> String {
        match (shape, words) {
            (Shape::Vector(display), &[north, east]) => {
                let vector = Vector::new(north, east);
                let size = number::brief(&[], &Shape::Quantity(display.clone()), &[vector.length()]);
                let toward = number::brief(&[], &Shape::Heading, &[vector.toward().radians()]);
                format!("{size} toward {toward}")
            }
            (Shape::Point, &[north, east]) => self.point(Point::new(north, east)),
            (Shape::Area, [count, corners @ ..]) => {
                let corners = corners.chunks(AREA_CORNER_WORDS as usize).take(*count as usize);
                corners.map(|c| self.point(Point::new(c[0], c[1]))).collect::<Vec<_>>().join("\n")
            }
            (Shape::List(item, _), [count, items @ ..]) => {
                let items = items.chunks(item.words().max(1) as usize).take(*count as usize);
                items.map(|words| self.text(item, words)).collect::<Vec<_>>().join("\n")
            }
            _ => number::brief(&[], shape, words),
        }
    }

    /// What a survey came to be: where its corners lie, how large it is, and how deep.
    fn survey(&self, grid: &Grid) -> Vec<(String, String, bool)> {
        let Grid { south_west, north_east, rows, columns, depths } = grid;
        let size = *north_east - *south_west;
        let length = |m: f64| if m < 10_000.0 { format!("{m:.1} m") } else { format!("{:.1} km", m / 1000.0) };
        let (step, across) = (size.north / f64::from(rows - 1), size.east / f64::from(columns - 1));
        let ends = |(low, high): (f64, f64), depth: &f64| (low.min(*depth), high.max(*depth));
        let (least, most) = depths.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        let land = depths.iter().filter(|depth| **depth <= 0.0).count();
        let on_land = if land == 0 { String::new() } else { format!(", {land} cells on land") };
        let told = [
            ("south-west", self.point(*south_west)),
            ("north-east", self.point(*north_east)),
            ("size", format!("{} north, {} east", length(size.north), length(size.east))),
            ("cells", format!("{rows} x {columns}, each {} x {}", length(step), length(across))),
            ("depths", format!("{least:.1} m to {most:.1} m{on_land}")),
        ];
        told.into_iter().map(|(name, value)| (name.to_string(), value, false)).collect()
    }

    /// A place in the frame, and on the globe if it lies there.
    fn point(&self, p: Point) -> String {
        let local = number::point(p);
        match self.frame {
            Some(frame) => format!("{} {local}", frame.to_geodetic(p)),
            None => local,
        }
    }
}
