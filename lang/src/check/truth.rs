//! What the expectations of a test speak of: the truth that only the simulator knows, and what the mission has reported.

use super::{Checker, Def};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Expr, ExprKind, Interval, OUTCOMES, ReportPart, TestNames, TrueInput, Var, VarKind};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_geometry::OUTLINE_CORNERS;
use albacore_wording::listed;
use std::collections::BTreeMap;
use std::rc::Rc;

/// What stands after `truth`, beside the inputs.
const TRUTHS: [&str; 8] =
    ["position", "nearest_source", "source", "boundary", "start", "deepest", "depth_at", "beacon"];

/// No run lasts longer, s: three years.
const RUN_MAX_S: f64 = 1e8;

/// Nothing moves faster, m/s.
const SPEED_MAX: f64 = 1e4;

/// What is said without a source.
const NO_SOURCE: &str = "the scenario has no source";
/// What is said without a spill.
const NO_SPILL: &str = "the scenario has no spill whose outline makes an area";
/// What is said of a vehicle whose navigation is not inertial, and before its first second.
const NO_NAVIGATOR: &str = "the vehicle has no inertial navigator";
/// What is said without a beacon.
const NO_BEACON: &str = "the scenario has no beacon";
/// What is said without a deepest point.
const NO_DEEPEST: &str = "no point of the mission's area is the deepest";

/// The types of what a mission reports, by name and by label.
pub(super) type Reports = BTreeMap<String, Vec<BTreeMap<String, Type>>>;

/// The test whose expectations are being checked.
pub(super) struct TestScope {
    /// The mission that it runs.
    pub mission: usize,
    /// The types of what that reports, by name.
    pub reports: Rc<Reports>,
    /// The variables that hold what is asked of a report, by its name.
    pub report_vars: BTreeMap<(ReportPart, String), usize>,
    /// The parameters of the mission that are spoken of, and the variables of their values.
    pub params: Vec<(usize, usize)>,
    /// What its expectations speak of.
    pub names: TestNames<usize>,
    /// The points whose true water depth they ask for, and the variables of the answers.
    pub depths: Vec<(Expr, usize)>,
    /// What the expectation at hand takes for granted, and what to say when that is absent.
    pub needs: Vec<(usize, String)>,
}

impl<'t> Checker<'t> {
    /// The names that only tests know.
    pub(super) fn test_scope(&mut self, mission: usize) {
        let span = self.activity_signatures[mission].span;
        let var = |c: &mut Self, name: &str, ty: Type| c.declare_hidden(name.to_string(), VarKind::Signal, ty, span);
        let areas = self.hir.activities[mission].mission.as_ref().map_or(0, |mission| mission.areas.len());
        let vars = TestNames {
            position: var(self, "truth.position", Type::Point),
            nearest_source: var(self, "truth.nearest_source", Type::Point.optional()),
            start: var(self, "truth.start", Type::Point),
            deepest: var(self, "truth.deepest", Type::Point.optional()),
            time: var(self, "time", Type::Quantity(Dimension::TIME)),
            outcomes: OUTCOMES.map(|name| var(self, name, Type::Bool)),
            reasons: Vec::new(),
            areas: (0..areas).map(|_| var(self, "an area of the mission", Type::Area)).collect(),
            reports: Vec::new(),
            counts: Vec::new(),
            sources: Vec::new(),
            boundaries: Vec::new(),
            beacon: None,
            inputs: Vec::new(),
        };
        // It has run for no time yet, or for some.
        self.scope.vars[vars.time].range = Interval::new(0.0, RUN_MAX_S);
        self.test = Some(TestScope {
            mission,
            reports: self.reports_of(mission),
            report_vars: BTreeMap::new(),
            params: Vec::new(),
            names: vars,
            depths: Vec::new(),
            needs: Vec::new(),
        });
    }

    /// What a mission reports: looked through once for the tests of one mission that stand together.
    fn reports_of(&mut self, mission: usize) -> Rc<Reports> {
        match &self.reports {
            Some((of, reports)) if *of == mission => Rc::clone(reports),
            _ => {
                let reports = Rc::new(self.hir.reports(mission));
                self.reports = Some((mission, Rc::clone(&reports)));
                reports
            }
        }
    }

    /// `truth.position` and the like, and the area of the mission by the mission's name.
    pub(super) fn test_member(&mut self, base: &tree::Expr, member: &tree::Name, span: Span) -> Option<Expr> {
        let test = self.test.as_ref()?;
        match self.mission_meant(base) {
            Some(id) if id == test.mission => return self.member_of_the_tested(base, member, span),
            Some(_) if self.module_named(base).is_none() => return Some(self.not_run(base, span)),
            _ => {}
        }
        let tree::ExprKind::Name(name) = &base.kind else { return None };
        let id = match (name.as_str(), member.node.as_str()) {
            ("truth", "position") => test.names.position,
            ("truth", "nearest_source") => {
                return Some(self.taken_for_granted(test.names.nearest_source, NO_SOURCE.to_string(), span));
            }
            ("truth", "boundary") => return Some(self.true_boundary(None, NO_SPILL.to_string(), span)),
            ("truth", "start") => test.names.start,
            ("truth", "deepest") => {
                return Some(self.taken_for_granted(test.names.deepest, NO_DEEPEST.to_string(), span));
            }
            ("truth", "beacon") => {
                let id = self.beacon_var(span);
                return Some(self.taken_for_granted(id, NO_BEACON.to_string(), span));
            }
            ("truth", other) => match TrueInput::ALL.into_iter().find(|input| input.name() == other) {
                Some(input) => {
                    let id = self.true_input(input, span);
                    return Some(self.taken_for_granted(id, NO_NAVIGATOR.to_string(), span));
                }
                None => return Some(self.no_truth(other, member.span, span)),
            },
            _ => return None,
        };
        Some(self.variable(id, span))
    }

    /// The variable that holds where the beacon truly is.
    fn beacon_var(&mut self, span: Span) -> usize {
        if let Some(id) = self.test.as_ref().and_then(|test| test.names.beacon) {
            return id;
        }
        let id = self.declare_hidden("truth.beacon".into(), VarKind::Signal, Type::Point.optional(), span);
        if let Some(test) = &mut self.test {
            test.names.beacon = Some(id);
        }
        id
    }

    /// The variable that holds what an input would truly tell: one for each of these.
    fn true_input(&mut self, input: TrueInput, span: Span) -> usize {
        let known = self.test.as_ref().and_then(|test| test.names.inputs.iter().find(|(known, _)| *known == input));
        if let Some(&(_, id)) = known {
            return id;
        }
        let id = self.declare_hidden(format!("truth.{}", input.name()), VarKind::Signal, input.ty(), span);
        if input == TrueInput::Speed {
            self.scope.vars[id].range = Interval::new(0.0, SPEED_MAX);
        }
        if let Some(test) = &mut self.test {
            test.names.inputs.push((input, id));
        }
        id
    }

    /// Two sides as a test means them: `truth.depth` beside a depth is one, `truth.altitude` beside an altitude, and an outcome beside a value
    /// that can be called so is that variant.
    pub(super) fn as_meant(&self, a: Expr, b: Expr) -> (Expr, Expr) {
        let meant = (self.meant_beside(&a, b.ty.present()), self.meant_beside(&b, a.ty.present()));
        (meant.0.unwrap_or(a), meant.1.unwrap_or(b))
    }

    fn meant_beside(&self, e: &Expr, other: &Type) -> Option<Expr> {
        let (ExprKind::Var(id), Some(test)) = (&e.kind, &self.test) else { return None };
        if let Type::Enum(of) = other {
            let outcome = OUTCOMES[test.names.outcomes.iter().position(|known| known == id)?];
            let variant = self.types.enums[*of].variants.iter().position(|variant| variant == outcome)?;
            return Some(Expr {
                kind: ExprKind::Number(variant as f64),
                ty: other.clone(),
                span: e.span,
                range: Interval::ANY,
            });
        }
        let measured = match test.names.inputs.iter().find(|(_, known)| known == id)?.0 {
            TrueInput::Depth => Type::Depth,
            TrueInput::Altitude => Type::Altitude,
            _ => return None,
        };
        (measured == *other).then(|| Expr { ty: measured, ..e.clone() })
    }

    /// Says that there is no such member of `truth`.
    fn no_truth(&mut self, asked: &str, named: Span, span: Span) -> Expr {
        let known: Vec<&str> = TRUTHS.into_iter().chain(TrueInput::ALL.map(TrueInput::name)).collect();
        let finding = Diagnostic::error(Code::TestsTruth, named, format!("there is no `truth.{asked}` to ask for"));
        let finding = match self.nearest(asked.trim_end_matches("(…)"), known.iter().copied()) {
            Some("source") if asked == "source" => finding.help("say which: `truth.source(\"NAME\")`"),
            Some("depth_at") if asked == "depth_at" => finding.help("say where: `truth.depth_at(POINT)`"),
            Some(near) => finding.help(format!("did you mean `truth.{near}`?")),
            None => finding.help(format!("there is {}", listed(&known))),
        };
        self.report(finding);
        self.unknown(span)
    }

    /// The mission that is named: `box`, or `surveys.box` of a module that is imported. The name alone is that of the one which is run.
    fn mission_meant(&self, base: &tree::Expr) -> Option<usize> {
        let test = self.test.as_ref()?;
        let found = match &base.kind {
            tree::ExprKind::Name(name) if *name == self.mission_name(test.mission) => return Some(test.mission),
            tree::ExprKind::Name(name) if self.local(name).is_none() => self.lookup(self.scope.module, name),
            tree::ExprKind::Member(module, name) => self.defined_in(self.module_named(module)?, name),
            _ => None,
        };
        match found {
            Some(&Def::Activity(id)) if self.mission_ids.contains(&id) => Some(id),
            _ => None,
        }
    }

    /// An expectation that speaks of a mission which its test does not run.
    fn not_run(&mut self, base: &tree::Expr, span: Span) -> Expr {
        let run = self.test.as_ref().map_or("", |test| self.mission_name(test.mission)).to_string();
        let finding =
            Diagnostic::error(Code::NamesValue, base.span, format!("this test runs `{run}`, not this mission"));
        self.report(finding.help(format!("the area that is known here is that of `{run}`")));
        self.unknown(span)
    }

    /// `box.op`: an area of the mission that a test runs; `box.size`: a parameter of it, with the value that it is given.
    fn member_of_the_tested(&mut self, base: &tree::Expr, member: &tree::Name, span: Span) -> Option<Expr> {
        let test = self.test.as_ref()?;
        let mission = &self.hir.activities[test.mission];
        let params = &mission.vars[..mission.params];
        if let Some(param) = params.iter().position(|var| var.name == member.node)
            && self.module_named(base).is_none()
        {
            self.names_used.refer(base.span, mission.span);
            self.names_used.refer(member.span, mission.vars[param].span);
            return Some(self.param_of_the_tested(test.mission, param, span));
        }
        let areas = || mission.vars.iter().filter(|var| var.kind == VarKind::Area);
        let area = areas().zip(&test.names.areas).find(|(area, _)| area.name == member.node);
        let Some((area, &id)) = area else {
            // A module may have the name of its mission.
            if self.module_named(base).is_some() {
                return None;
            }
            let message = format!("the mission has no area or parameter `{}`", member.node);
            let finding = Diagnostic::error(Code::NamesUnknown, member.span, message);
            let known = params.iter().chain(areas()).map(|var| var.name.as_str());
            let help = self.suggestion(&member.node, known);
            let otherwise = || "`truth.position` and the like tell where the vehicle truly was".to_string();
            self.report(finding.help(help.unwrap_or_else(otherwise)));
            return Some(self.unknown(span));
        };
        self.names_used.refer(base.span, mission.span);
        self.names_used.refer(member.span, area.span);
        Some(self.variable(id, span))
    }

    /// The mission that a test runs, if it has a parameter or an area of a name.
    pub(super) fn tested_that_has(&self, name: &str) -> Option<&str> {
        let test = self.test.as_ref()?;
        let mission = &self.hir.activities[test.mission];
        let is_known =
            |(nth, var): (usize, &Var)| var.name == name && (nth < mission.params || var.kind == VarKind::Area);
        mission.vars.iter().enumerate().any(is_known).then(|| self.mission_name(test.mission))
    }

    /// The value that the mission is given for a parameter. It is the same whatever the mission does.
    fn param_of_the_tested(&mut self, mission: usize, param: usize, span: Span) -> Expr {
        let known = self.test.as_ref().and_then(|test| test.params.iter().find(|(known, _)| *known == param));
        if let Some(&(_, id)) = known {
            return self.variable(id, span);
        }
        let var = &self.hir.activities[mission].vars[param];
        let (ty, range) = (var.ty.clone(), var.range);
        let id = self.declare_hidden(format!("parameter {}", var.name), VarKind::Param, ty, span);
        self.scope.vars[id].range = range;
        if let Some(test) = &mut self.test {
            test.params.push((param, id));
        }
        self.variable(id, span)
    }

    /// `truth.depth_at(p)`: how deep the water truly is at a point.
    pub(super) fn test_method(
        &mut self,
        base: &tree::Expr,
        member: &tree::Name,
        args: &[tree::Arg],
        span: Span,
    ) -> Option<Expr> {
        self.test.as_ref()?;
        let is_truth = matches!(&base.kind, tree::ExprKind::Name(name) if name == "truth");
        if is_truth && member.node == "source" {
            return Some(self.true_source(args, span));
        }
        if is_truth && member.node == "boundary" {
            let Some([name]) = self.positional::<1>("boundary", args, span) else { return Some(self.unknown(span)) };
            let name = self.plain_text(&name);
            let without = format!("the scenario has no spill \"{name}\" whose outline makes an area");
            return Some(self.true_boundary(Some(name), without, span));
        }
        if !is_truth {
            return None;
        }
        if member.node != "depth_at" {
            return Some(self.no_truth(&format!("{}(…)", member.node), member.span, span));
        }
        let Some(given) = self.simple_args("depth_at", &[("point", Type::Point)], args, span) else {
            return Some(self.unknown(span));
        };
        let id = self.declare_hidden("truth.depth_at".into(), VarKind::Signal, Type::Quantity(Dimension::LENGTH), span);
        if let Some(test) = &mut self.test {
            test.depths.extend(given.into_iter().map(|point| (point, id)));
        }
        Some(self.variable(id, span))
    }

    /// `truth.boundary`, `truth.boundary("oil")`: the true outline of a spill.
    fn true_boundary(&mut self, name: Option<String>, without: String, span: Span) -> Expr {
        let known = self.test.as_ref().and_then(|test| test.names.boundaries.iter().find(|(known, _)| *known == name));
        let id = known.map(|(_, id)| *id).unwrap_or_else(|| {
            self.types.corners = self.types.corners.max(OUTLINE_CORNERS);
            let id = self.declare_hidden("truth.boundary".into(), VarKind::Signal, Type::Area.optional(), span);
            if let Some(test) = &mut self.test {
                test.names.boundaries.push((name, id));
            }
            id
        });
        self.taken_for_granted(id, without, span)
    }

    fn mission_name(&self, mission: usize) -> &str {
        let full = &self.activity_signatures[mission].name;
        full.rsplit('.').next().unwrap_or(full)
    }

    /// `truth.source("north")`: where a source truly is, by its name.
    fn true_source(&mut self, args: &[tree::Arg], span: Span) -> Expr {
        let Some([name]) = self.positional::<1>("source", args, span) else { return self.unknown(span) };
        let name = self.plain_text(&name);
        let without = format!("the scenario has no source \"{name}\"");
        let id = self.declare_hidden(format!("source \"{name}\""), VarKind::Signal, Type::Point.optional(), span);
        if let Some(test) = &mut self.test {
            test.names.sources.push((name, id));
        }
        self.taken_for_granted(id, without, span)
    }
}
