//! What the expectations of a test speak of: the truth that only the simulator knows, and what the mission has reported.

use super::expr::article;
use super::{Checker, Def};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{
    Builtin, Expr, ExprKind, Interval, OUTCOMES, ReportPart, TestNames, TextPart, TrueInput, Var, VarKind,
};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_wording::listed;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// What stands after `truth`, beside the inputs.
const TRUTHS: [&str; 7] = ["position", "nearest_source", "source", "start", "deepest", "depth_at", "beacon"];
/// The questions for a report.
const QUESTIONS: [&str; 6] =
    ["reported", "reported_at", "has_reported", "last_reported", "last_reported_at", "times_reported"];

/// No run lasts longer, s: three years.
const RUN_MAX_S: f64 = 1e8;

/// Nothing moves faster, m/s.
const SPEED_MAX: f64 = 1e4;

/// No run reports more often: so many lines in each of its ticks.
const REPORTS_MAX: f64 = 1e12;

/// What is said without a source.
const NO_SOURCE: &str = "the scenario has no source";
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
    reports: Rc<Reports>,
    /// The variables that hold what is asked of a report, by its name.
    report_vars: BTreeMap<(ReportPart, String), usize>,
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
            sources: Vec::new(),
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
            ("truth", "start") => test.names.start,
            ("truth", "deepest") => {
                return Some(self.taken_for_granted(test.names.deepest, NO_DEEPEST.to_string(), span));
            }
            ("truth", "beacon") => {
                let id = self.beacon_var(span);
                return Some(self.taken_for_granted(id, NO_BEACON.to_string(), span));
            }
            ("truth", other) => match TrueInput::ALL.into_iter().find(|input| input.name() == other) {
                Some(input) => self.true_input(input, span),
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

    /// Two sides of which one is `truth.depth` and the other a depth, or of altitudes: both are, so that they can be subtracted and compared.
    pub(super) fn as_measured(&self, (a, b): (Expr, Expr)) -> (Expr, Expr) {
        let true_type = |e: &Expr| {
            let (ExprKind::Var(id), Some(test)) = (&e.kind, &self.test) else { return None };
            match test.names.inputs.iter().find(|(_, known)| known == id)?.0 {
                TrueInput::Depth => Some(Type::Depth),
                TrueInput::Altitude => Some(Type::Altitude),
                _ => None,
            }
        };
        let measured = |e: Expr, beside: &Type| match true_type(&e).filter(|ty| ty == beside.present()) {
            Some(ty) => Expr { ty, ..e },
            None => e,
        };
        let types = (a.ty.clone(), b.ty.clone());
        (measured(a, &types.1), measured(b, &types.0))
    }

    /// Says that there is no such member of `truth`.
    fn no_truth(&mut self, asked: &str, named: Span, span: Span) -> Expr {
        let known: Vec<&str> = TRUTHS.into_iter().chain(TrueInput::ALL.map(TrueInput::name)).collect();
        let finding = Diagnostic::error(Code::TestsTruth, named, format!("there is no `truth.{asked}` to ask for"));
        let finding = match self.nearest(asked.trim_end_matches("(…)"), known.iter().copied()) {
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

    /// `reported("source")`: where that was first reported, `reported_at("source")`: when, `has_reported("source")`: whether; with `last_`
    /// the last of its reports, and `times_reported("source")` how many there were. Where no `has_reported` shows that there is one, an
    /// expectation without such a report fails, and says so.
    pub(super) fn test_call(&mut self, name: &str, args: &[tree::Arg], span: Span) -> Option<Expr> {
        self.test.as_ref()?;
        if name == "aborted" {
            return Some(self.aborted_for(args, span));
        }
        if !QUESTIONS.contains(&name) {
            return None;
        }
        let asks_for_value = matches!(name, "reported" | "last_reported");
        if asks_for_value && args.len() == 2 {
            let Some([text, label]) = self.positional::<2>(name, args, span) else { return Some(self.unknown(span)) };
            let (what, label_text) = (self.plain_text(&text), self.plain_text(&label));
            return Some(self.reported_value(&what, (&label_text, label.span), name == "reported", span));
        }
        if asks_for_value && args.len() > 2 {
            let message =
                format!("`{name}` takes the name of a report and a label of it, not {} arguments", args.len());
            let finding = Diagnostic::error(Code::ArgsMany, span, message);
            self.report(finding.help(format!("write `{name}(\"NAME\")` or `{name}(\"NAME\", \"LABEL\")`")));
            return Some(self.unknown(span));
        }
        let Some([text]) = self.positional::<1>(name, args, span) else { return Some(self.unknown(span)) };
        let what = self.plain_text(&text);
        let sites = self.test.as_ref().and_then(|test| test.reports.get(&what).cloned()).unwrap_or_default();
        let is_place = |ty: &Type| self.types.shape(ty).first_point().is_some();
        let values: Vec<&Type> = sites.iter().filter_map(|labelled| labelled.get("")).collect();
        // What is reported as a place each time is one whenever it was reported.
        let all_places = values.iter().copied().all(is_place);
        if asks_for_value && !values.is_empty() && !values.iter().copied().any(is_place) {
            return Some(self.reported_value(&what, ("", text.span), name == "reported", span));
        }
        let none = format!("nothing was reported as \"{what}\"");
        let no_place = |which: &str| format!("the {which} report \"{what}\" has no place, or there is none");
        let part = match name {
            "times_reported" => {
                let count = self.report_var(&what, ReportPart::Count, text.span);
                return Some(self.variable(count, span));
            }
            "has_reported" => return Some(self.has_reported(&what, all_places, text.span, span)),
            "reported_at" => ReportPart::FirstTime,
            "last_reported_at" => ReportPart::LastTime,
            "last_reported" => ReportPart::LastPlace,
            _ => ReportPart::FirstPlace,
        };
        // Whether it was reported is known with when.
        let without = match (&part, all_places) {
            (ReportPart::FirstPlace, false) => no_place("first"),
            (ReportPart::LastPlace, false) => no_place("last"),
            _ => none,
        };
        let var = self.report_var(&what, part, text.span);
        Some(self.taken_for_granted(var, without, span))
    }

    /// `aborted("far outside")`: whether that aborted the mission. What the machine says by itself begins with the name of an input.
    fn aborted_for(&mut self, args: &[tree::Arg], span: Span) -> Expr {
        let Some([text]) = self.positional::<1>("aborted", args, span) else { return self.unknown(span) };
        let (why, Some(mission)) = (self.plain_text(&text), self.test.as_ref().map(|test| test.mission)) else {
            return self.unknown(span);
        };
        // That it is no text has been told.
        if why.is_empty() {
            return self.unknown(span);
        }
        let reasons = self.hir.abort_reasons(mission);
        let is_plain = |parts: &[TextPart]| parts.iter().all(|part| matches!(part, TextPart::Literal(_)));
        let plain = |parts: &[TextPart]| {
            let literal =
                |part: &TextPart| if let TextPart::Literal(text) = part { text.clone() } else { String::new() };
            parts.iter().map(literal).collect::<String>()
        };
        let all_plain = reasons.iter().all(|parts| is_plain(parts));
        let known: BTreeSet<String> = reasons.iter().map(|parts| plain(parts)).collect();
        if all_plain && !known.contains(&why) && !why.starts_with('`') {
            let finding =
                Diagnostic::error(Code::TestsReport, text.span, format!("nothing aborts the mission with \"{why}\""));
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            self.report(match self.nearest(&why, known.iter().copied()) {
                Some(near) => finding.help(format!("did you mean \"{near}\"?")),
                None if known.is_empty() => {
                    finding.help("no `abort \"WHY\"` stands in it; `expect aborted` asks for no reason")
                }
                None => finding.help(format!("it may be aborted with \"{}\"", known.join("\", \""))),
            });
            return self.unknown(span);
        }
        let id = self.declare_hidden(format!("aborted \"{why}\""), VarKind::Signal, Type::Bool, span);
        if let Some(test) = &mut self.test {
            test.names.reasons.push((why, id));
        }
        self.variable(id, span)
    }

    /// `reported("leg", "length")`: what stood behind a label, or without one the value itself, in the first report of a name or in the last.
    fn reported_value(&mut self, what: &str, (label, at): (&str, Span), first: bool, span: Span) -> Expr {
        let sites = self.test.as_ref().and_then(|test| test.reports.get(what).cloned()).unwrap_or_default();
        let types: Vec<&Type> = sites.iter().filter_map(|labelled| labelled.get(label)).collect();
        let which = if first { "first" } else { "last" };
        let time = if first { ReportPart::FirstTime } else { ReportPart::LastTime };
        // Whether there is such a report at all is known with when; a name that nothing reports is told there.
        let when = self.report_var(what, time, span);
        let Some(ty) = types.first().map(|ty| (*ty).clone()) else {
            if !sites.is_empty() {
                let message = format!("what is reported as \"{what}\" has no label \"{label}\"");
                let finding = Diagnostic::error(Code::TestsReport, at, message);
                let labels: Vec<&str> = sites.iter().flat_map(BTreeMap::keys).map(String::as_str).collect();
                let labels: BTreeSet<&str> = labels.into_iter().filter(|label| !label.is_empty()).collect();
                self.report(match labels.is_empty() {
                    true => finding.help("it has none: `report \"NAME\": VALUE, label: VALUE` gives it some"),
                    false => finding.help(format!("it has {}", listed(&Vec::from_iter(labels)))),
                });
            }
            return self.unknown(span);
        };
        let another = types.iter().find(|other| ***other != ty).map(|other| self.type_name(other));
        if another.is_some() || *ty.present() == Type::Text {
            let name = self.type_name(&ty);
            let message = match another {
                Some(other) => format!("this is reported as {} here, as {} there", article(&name), article(&other)),
                None => format!("what is reported is {}, and no two texts can be compared", article(&name)),
            };
            let finding = Diagnostic::error(Code::TestsReport, at, message);
            self.report(finding.help("`has_reported` tells whether it was reported, `reported_at` when"));
            return self.unknown(span);
        }
        let part = if first { ReportPart::FirstValue } else { ReportPart::LastValue };
        let var = self.report_var_of(what, part(label.to_string()), ty.optional(), span);
        if types.len() < sites.len() {
            let without = format!("the {which} report \"{what}\" has no \"{label}\", or there is none");
            return self.taken_for_granted(var, without, span);
        }
        self.taken_for_granted(when, format!("nothing was reported as \"{what}\""), span);
        self.variable(var, span).unwrapped()
    }

    /// Whether something was reported: then its first report and its last are known, and their places, where each is one.
    fn has_reported(&mut self, what: &str, all_places: bool, named: Span, span: Span) -> Expr {
        let parts: &[ReportPart] = match all_places {
            true => &[ReportPart::FirstTime, ReportPart::FirstPlace, ReportPart::LastTime, ReportPart::LastPlace],
            false => &[ReportPart::FirstTime, ReportPart::LastTime],
        };
        let known: Vec<Expr> = parts
            .iter()
            .map(|part| {
                let var = self.report_var(what, part.clone(), named);
                self.is_known(var, span)
            })
            .collect();
        let both = |a: Expr, b: Expr| self.operation(Builtin::And, vec![a, b], Type::Bool, span);
        known.into_iter().reduce(both).unwrap_or_else(|| self.unknown(span))
    }

    /// The value of something that may be absent: unless it is known to be there, the expectation fails without it.
    fn taken_for_granted(&mut self, id: usize, without: String, span: Span) -> Expr {
        let value = self.variable(id, span);
        if value.ty.is_optional()
            && let Some(test) = &mut self.test
        {
            test.needs.push((id, without));
        }
        value.unwrapped()
    }

    /// Whether something is there, although it may be known already.
    fn is_known(&self, id: usize, span: Span) -> Expr {
        let ty = self.scope.vars[id].ty.clone();
        let value = Expr { kind: ExprKind::Var(id), ty, span, range: Interval::ANY };
        self.make(ExprKind::IsPresent(Box::new(value)), Type::Bool, span)
    }

    /// The variable that holds what is asked of a report: one for each name.
    fn report_var(&mut self, what: &str, part: ReportPart, span: Span) -> usize {
        let ty = match part {
            ReportPart::FirstTime | ReportPart::LastTime => Type::Quantity(Dimension::TIME).optional(),
            ReportPart::Count => Type::Int,
            _ => Type::Point.optional(),
        };
        self.report_var_of(what, part, ty, span)
    }

    /// The same, of a type that the reports have.
    fn report_var_of(&mut self, what: &str, part: ReportPart, ty: Type, span: Span) -> usize {
        let key = (part.clone(), what.to_string());
        if let Some(id) = self.test.as_ref().and_then(|test| test.report_vars.get(&key)) {
            return *id;
        }
        let id = self.declare_hidden(format!("report \"{what}\" {part:?}"), VarKind::Signal, ty, span);
        if part == ReportPart::Count {
            self.scope.vars[id].range = Interval::new(0.0, REPORTS_MAX);
        }
        if let Some(TestScope { names, report_vars, .. }) = &mut self.test {
            names.reports.push((part, what.to_string(), id));
            report_vars.insert(key, id);
        }
        id
    }
}
