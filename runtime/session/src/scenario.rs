//! From what a scenario's script says to the simulator's own plain numbers.

use albacore_geometry::{Area, Heading, Point, Vector};
use albacore_guidance::Rows;
use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{ScenarioClause, ScenarioProgram, ScenarioValue};
use albacore_machine::Evaluation;
use albacore_program::{AREA_CORNER_WORDS, Slot};
use albacore_sim::{
    Adcp, Bottom, Fluorometer, Handover, KinematicVehicle, Lbl, Meander, Navigation, OwnMission, Pit, Plume, Scenario,
    Sounder, Source,
};
use albacore_vehicle::Vertical;

/// A clause of a scenario with its numbers computed.
struct Clause<'a> {
    clause: &'a ScenarioClause,
    words: &'a [f64],
}

/// The simulator's scenario; else what of it cannot be understood, and where.
pub(crate) fn scenario(program: &ScenarioProgram) -> Result<Scenario, Diagnostic> {
    let mut evaluation = Evaluation::new(&program.program);
    evaluation.run(&program.program, program.program.mission.activity);
    let words = evaluation.words(0, program.program.words);
    let mut scenario = Scenario::default();
    for clause in &program.clauses {
        let clause = Clause { clause, words };
        apply(&mut scenario, &clause).map_err(|what| {
            let message = format!("this clause cannot be: {what}");
            Diagnostic::error(Code::ScenariosClause, clause.clause.span, message)
        })?;
    }
    Ok(scenario)
}

fn apply(scenario: &mut Scenario, c: &Clause) -> Result<(), String> {
    match c.clause.name.as_str() {
        "flow" => {
            scenario.flow.mean = c.vector("mean")?;
            let direction_sd = c.number("meander")?;
            scenario.flow.meander = if direction_sd > 0.0 {
                Some(Meander {
                    direction_sd,
                    period: c.number("period")?,
                    damping: c.number("damping")?,
                    viscosity: c.number("viscosity")?,
                    margin: c.number("margin")?,
                    cell: c.number("cell")?,
                    ..Meander::default()
                })
            } else {
                None
            };
        }
        "region" => scenario.region = Some(c.area("area")?),
        "bottom" => {
            scenario.bottom = Bottom {
                from: c.number("from")?,
                to: c.number("to")?,
                toward: c.heading("toward")?,
                across: c.number("across")?,
                pits: std::mem::take(&mut scenario.bottom.pits),
            };
        }
        "pit" => scenario.bottom.pits.push(Pit {
            name: c.text("name")?,
            at: c.point("at")?,
            depth: c.number("depth")?,
            radius: c.number("radius")?,
        }),
        "plume" => {
            let layer = c.number("layer")?;
            scenario.plume = Some(Plume {
                growth: c.number("growth")?,
                initial_radius: c.number("initial_radius")?,
                diffusivity: c.number("diffusivity")?,
                vertical: c.number("vertical")?,
                layer: (layer > 0.0).then_some(layer),
                step: c.number("step")?,
            });
        }
        "source" => scenario.sources.push(Source {
            name: c.text("name")?,
            at: c.point("at")?,
            height: c.number("height")?,
            rate: c.number("rate")?,
            peak: c.number("peak")?,
            reference_age: c.number("peak_age")?,
        }),
        "vehicle" => {
            let model = c.clause("model").ok_or("a vehicle needs a model: write `vehicle(kinematic, start: …)`")?;
            scenario.vehicle = KinematicVehicle {
                start: c.point("start")?,
                start_spread: c.number("spread")?,
                heading: c.heading("heading")?,
                depth: c.number("depth")?,
                speed_max: model.number("speed_max")?,
                turn_rate: model.number("turn_rate")?,
                acceleration: model.number("acceleration")?,
                depth_rate: model.number("depth_rate")?,
                altitude_jitter: model.number("wobble")?,
                altitude_jitter_max: model.number("wobble_max")?,
                altitude_jitter_time: model.number("wobble_time")?,
                endurance: model.number("endurance")?,
                ..KinematicVehicle::default()
            };
        }
        "rows" => {
            let depth = c.number("depth")?;
            let vertical = if depth > 0.0 { Vertical::Depth(depth) } else { Vertical::Altitude(c.number("altitude")?) };
            let rows = Rows {
                length: c.number("length")?,
                spacing: c.number("spacing")?,
                count: c.number("count")? as u32,
                speed: c.number("speed")?,
            };
            scenario.own_mission = Some(OwnMission { rows, vertical });
        }
        "handover" => {
            scenario.handover = Some(Handover {
                after: c.number("after")?,
                refuses: c.number("refuses")? != 0.0,
                silent: c.number("silent")? != 0.0,
                suspends: c.number("suspends")?,
                lasting: c.number("lasting")?,
                takes_back: c.number("takes_back")?,
                offers: c.number("offers")?,
            });
        }
        "navigation" => {
            let mut navigation = Navigation { walk: 0.0, lbl: None };
            if let Some(reckoning) = c.clause("dead_reckoning") {
                navigation.walk = reckoning.number("walk")?;
            }
            if let Some(lbl) = c.clause("fixes") {
                navigation.lbl =
                    Some(Lbl { every: lbl.number("every")?, sigma: lbl.number("sigma")?, gate: lbl.number("gate")? });
            }
            scenario.navigation = Some(navigation);
        }
        "fluorometer" => {
            scenario.fluorometer = Fluorometer {
                rate: c.number("rate")?,
                noise: c.number("noise")?,
                false_alarms: c.number("false_alarms")?,
                ahead: c.number("ahead")?,
            };
        }
        "adcp" => scenario.adcp = Adcp { noise: c.number("noise")? },
        "sounder" => scenario.sounder = Sounder { noise: c.number("noise")? },
        other => return Err(format!("the simulator knows no `{other}`")),
    }
    Ok(())
}

impl<'a> Clause<'a> {
    fn value(&self, name: &str) -> Option<&'a ScenarioValue> {
        self.clause.args.iter().find(|(n, _)| n == name).map(|(_, value)| value)
    }

    fn slot(&self, name: &str) -> Result<Slot, String> {
        match self.value(name) {
            Some(ScenarioValue::Words(slot, _)) => Ok(*slot),
            _ => Err(format!("`{}` has no `{name}`", self.clause.name)),
        }
    }

    fn word(&self, slot: Slot) -> f64 {
        self.words.get(slot as usize).copied().unwrap_or(0.0)
    }

    fn number(&self, name: &str) -> Result<f64, String> {
        Ok(self.word(self.slot(name)?))
    }

    fn heading(&self, name: &str) -> Result<Heading, String> {
        Ok(Heading::from_radians(self.number(name)?))
    }

    fn point(&self, name: &str) -> Result<Point, String> {
        let at = self.slot(name)?;
        Ok(Point::new(self.word(at), self.word(at + 1)))
    }

    fn vector(&self, name: &str) -> Result<Vector, String> {
        let at = self.slot(name)?;
        Ok(Vector::new(self.word(at), self.word(at + 1)))
    }

    fn area(&self, name: &str) -> Result<Area, String> {
        let at = self.slot(name)?;
        let corners: Vec<Point> = (0..self.word(at) as u32)
            .map(|i| at + 1 + AREA_CORNER_WORDS * i)
            .map(|slot| Point::new(self.word(slot), self.word(slot + 1)))
            .collect();
        Area::polygon(&corners).map_err(|error| format!("`{name}`: {error}"))
    }

    fn text(&self, name: &str) -> Result<String, String> {
        match self.value(name) {
            Some(ScenarioValue::Text(text)) => Ok(text.clone()),
            _ => Err(format!("`{}` has no `{name}`", self.clause.name)),
        }
    }

    fn clause(&self, name: &str) -> Option<Clause<'a>> {
        match self.value(name) {
            Some(ScenarioValue::Clause(clause)) => Some(Clause { clause, words: self.words }),
            _ => None,
        }
    }
}
