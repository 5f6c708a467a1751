//! What the expectations of a test speak of: the truth that only the simulator knows, and what the mission has reported.

use super::expr::article;
use super::{Checker, Def};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Expr, ExprKind, Interval, TestNames, VarKind};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_wording::listed;
use std::collections::BTreeMap;
use std::rc::Rc;

/// What stands after `truth`.
const TRUTHS: [&str; 5] = ["position", "nearest_source", "start", "deepest", "depth_at"];

/// No run lasts longer, s: three years.
const RUN_MAX_S: f64 = 1e8;

/// What is said without a source.
const NO_SOURCE: &str = "the scenario has no source";
/// What is said without a deepest point.
const NO_DEEPEST: &str = "no point of the mission's area is the deepest";

/// The types of what a mission reports, by name.
pub(super) type Reports = BTreeMap<String, Vec<Type>>;

/// The test whose expectations are being checked.
pub(super) struct TestScope {
    /// The mission that it runs.
    mission: usize,
    /// The types of what that reports, by name.
    reports: Rc<Reports>,
    /// The variables that hold where and when something was reported, by its name.
    report_vars: [BTreeMap<String, usize>; 2],
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
        let vars = TestNames {
            position: var(self, "truth.position", Type::Point),
            nearest_source: var(self, "truth.nearest_source", Type::Point.optional()),
            start: var(self, "truth.start", Type::Point),
            deepest: var(self, "truth.deepest", Type::Point.optional()),
            time: var(self, "time", Type::Quantity(Dimension::TIME)),
            completed: var(self, "completed", Type::Bool),
            area: var(self, "the mission's area", Type::Area),
            reported: Vec::new(),
            reported_at: Vec::new(),
        };
        // It has run for no time yet, or for some.
        self.scope.vars[vars.time].range = Interval::new(0.0, RUN_MAX_S);
        self.test = Some(TestScope {
            mission,
            reports: self.reports_of(mission),
            report_vars: Default::default(),
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
            Some(id) if id == test.mission => return self.area_of_the_tested(base, member, span),
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
            ("truth", other) => {
                let finding =
                    Diagnostic::error(Code::TestsTruth, member.span, format!("there is no `truth.{other}` to ask for"));
                let finding = match self.nearest(other, TRUTHS) {
                    Some(near) => finding.help(format!("did you mean `truth.{near}`?")),
                    None => finding.help(format!("there is {}", listed(&TRUTHS))),
                };
                self.report(finding);
                return Some(self.unknown(span));
            }
            _ => return None,
        };
        Some(self.variable(id, span))
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

    /// `box.op`: the area of the mission that a test runs.
    fn area_of_the_tested(&mut self, base: &tree::Expr, member: &tree::Name, span: Span) -> Option<Expr> {
        let test = self.test.as_ref()?;
        let mission = &self.hir.activities[test.mission];
        let area = mission.vars.iter().find(|var| var.kind == VarKind::Area);
        let Some(area) = area.filter(|area| area.name == member.node) else {
            // A module may have the name of its mission.
            if self.module_named(base).is_some() {
                return None;
            }
            let message = format!("the mission has no area `{}`", member.node);
            let finding = Diagnostic::error(Code::NamesUnknown, member.span, message);
            self.report(match area {
                Some(area) => finding.help(format!("its area is `{}`", area.name)),
                None => finding.help("`truth.position` and the like tell where the vehicle truly was"),
            });
            return Some(self.unknown(span));
        };
        let id = test.names.area;
        self.names_used.refer(base.span, mission.span);
        self.names_used.refer(member.span, area.span);
        Some(self.variable(id, span))
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
        if !is_truth || member.node != "depth_at" {
            return None;
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

    /// `reported("source")`: where that was first reported, `reported_at("source")`: when, `has_reported("source")`: whether.
    /// Where no `has_reported` shows that there is one, an expectation without such a report fails, and says so.
    pub(super) fn test_call(&mut self, name: &str, args: &[tree::Arg], span: Span) -> Option<Expr> {
        self.test.as_ref()?;
        if !matches!(name, "reported" | "reported_at" | "has_reported") {
            return None;
        }
        let Some([text]) = self.positional::<1>(name, args, span) else { return Some(self.unknown(span)) };
        let what = self.plain_text(&text);
        let values = self.test.as_ref().and_then(|test| test.reports.get(&what).cloned()).unwrap_or_default();
        let is_place = |ty: &Type| self.types.shape(ty).first_point().is_some();
        // What is reported as a place each time is one whenever it was reported.
        let all_places = values.iter().all(is_place);
        let never = !values.is_empty() && !values.iter().any(is_place);
        if let Some(ty) = values.first().filter(|_| name == "reported" && never).map(|ty| self.type_name(ty)) {
            let what = format!("what is reported as \"{what}\" is no place: it is {}", article(&ty));
            self.report(
                Diagnostic::error(Code::TestsReport, text.span, what)
                    .help("`has_reported` tells whether it was reported, `reported_at` when"),
            );
            return Some(self.unknown(span));
        }
        let at = self.report_var(&what, true, text.span);
        let place = all_places.then(|| self.report_var(&what, false, text.span));
        Some(match name {
            "has_reported" => {
                let at = self.is_known(at, span);
                match place {
                    Some(place) => {
                        let place = self.is_known(place, span);
                        self.operation(Builtin::And, vec![at, place], Type::Bool, span)
                    }
                    None => at,
                }
            }
            "reported_at" => self.taken_for_granted(at, format!("nothing was reported as \"{what}\""), span),
            _ if all_places => {
                let place = self.report_var(&what, false, text.span);
                self.taken_for_granted(place, format!("nothing was reported as \"{what}\""), span)
            }
            _ => {
                let place = self.report_var(&what, false, text.span);
                self.taken_for_granted(
                    place,
                    format!("the first report \"{what}\" has no place, or there is none"),
                    span,
                )
            }
        })
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

    /// The variable that holds where or when something was reported: one for each name.
    fn report_var(&mut self, what: &str, when: bool, span: Span) -> usize {
        let known = self.test.as_ref().and_then(|test| test.report_vars[usize::from(when)].get(what));
        if let Some(id) = known {
            return *id;
        }
        let (ty, of) = if when { (Type::Quantity(Dimension::TIME), "at") } else { (Type::Point, "place") };
        let id = self.declare_hidden(format!("report \"{what}\" {of}"), VarKind::Signal, ty.optional(), span);
        if let Some(TestScope { names, report_vars, .. }) = &mut self.test {
            report_vars[usize::from(when)].insert(what.to_string(), id);
            let table = if when { &mut names.reported_at } else { &mut names.reported };
            table.push((what.to_string(), id));
        }
        id
    }
}
