//! What the expectations of a test ask of a run: what was reported, asked and recorded, and why it was aborted.

use super::Checker;
use super::expr::article;
use super::truth::TestScope;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::hir::{Builtin, Counted, Expr, ExprKind, Interval, ReportPart, TextPart, VarKind, Which};
use crate::source::Span;
use crate::syntax::tree;
use crate::types::Type;
use albacore_wording::listed;
use std::collections::{BTreeMap, BTreeSet};

/// The questions for a report.
const QUESTIONS: [&str; 6] =
    ["reported", "reported_at", "has_reported", "last_reported", "last_reported_at", "times_reported"];

/// The greatest number of a report that can be asked for.
const NUMBER_MAX: f64 = 1e6;
/// No run reports more often: so many lines in each of its ticks.
const REPORTS_MAX: f64 = 1e12;

impl<'t> Checker<'t> {
    /// `reported("source")`: where that was first reported, `reported_at("source")`: when, `has_reported("source")`: whether; with `last_`
    /// the last of its reports, with `number: 2` the second, and `times_reported("source")` how many there were. Where no `has_reported`
    /// shows that there is one, an expectation without such a report fails, and says so.
    pub(super) fn test_call(&mut self, name: &str, args: &[tree::Arg], span: Span) -> Option<Expr> {
        self.test.as_ref()?;
        match name {
            "aborted" => return Some(self.aborted_for(args, span)),
            "times_asked" => return Some(self.count_of(Counted::Asks, name, args, span)),
            "times_recorded" => return Some(self.count_of(Counted::Recorded, name, args, span)),
            _ => {}
        }
        if !QUESTIONS.contains(&name) {
            return None;
        }
        let asks_for_value = matches!(name, "reported" | "last_reported");
        let (args, which) = self.which(name, args);
        let args = args.as_slice();
        if asks_for_value && args.len() == 2 {
            let Some([text, label]) = self.positional::<2>(name, args, span) else { return Some(self.unknown(span)) };
            let (what, label_text) = (self.plain_text(&text), self.plain_text(&label));
            return Some(self.reported_value(&what, (&label_text, label.span), which, span));
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
            return Some(self.reported_value(&what, ("", text.span), which, span));
        }
        let part = match name {
            "times_reported" => {
                let count = self.report_var(&what, ReportPart::Count, text.span);
                return Some(self.variable(count, span));
            }
            "has_reported" => return Some(self.has_reported(&what, which, all_places, text.span, span)),
            "reported_at" | "last_reported_at" => ReportPart::Time(which),
            _ => ReportPart::Place(which),
        };
        // Whether it was reported is known with when.
        let without = match (&part, all_places) {
            (ReportPart::Place(_), false) => format!("{} has no place, or there is none", told(which, &what)),
            _ => lacking(which, &what),
        };
        let var = self.report_var(&what, part, text.span);
        let value = self.taken_for_granted(var, without, span);
        // What nothing reports is told once: it may be anything.
        Some(if sites.is_empty() && asks_for_value { self.unknown(span) } else { value })
    }

    /// `reported("wreck").size`: the record that was reported, where a field of it is asked for. Without one it is the place in it.
    pub(super) fn reported_record(&mut self, question: &tree::Expr, field: &str) -> Option<Expr> {
        let tree::ExprKind::Call(asked, args) = &question.kind else { return None };
        let tree::ExprKind::Name(name) = &asked.kind else { return None };
        let text = args.first().filter(|_| matches!(name.as_str(), "reported" | "last_reported"))?;
        let what = match &text.value.kind {
            tree::ExprKind::Text(parts) if args[1..].iter().all(|arg| arg.label.is_some()) => match parts.as_slice() {
                [tree::TextPart::Literal(what)] => what,
                _ => return None,
            },
            _ => return None,
        };
        let has_field = |ty: &Type| match ty {
            Type::Record(id) => self.types.records[*id].fields.iter().any(|(name, _)| name == field),
            _ => false,
        };
        let sites = self.test.as_ref()?.reports.get(what)?;
        if !sites.iter().filter_map(|labelled| labelled.get("")).all(has_field) {
            return None;
        }
        let (_, which) = self.which(name, args);
        Some(self.reported_value(what, ("", text.value.span), which, question.span))
    }

    /// Which report of a name a question is about, and its other arguments.
    fn which(&mut self, name: &str, args: &[tree::Arg]) -> (Vec<tree::Arg>, Which) {
        let is_number = |arg: &tree::Arg| arg.label.as_ref().is_some_and(|label| label.node == "number");
        let (numbers, args): (Vec<tree::Arg>, Vec<tree::Arg>) = args.iter().cloned().partition(is_number);
        let of_name = if name.starts_with("last_") { Which::Last } else { Which::FIRST };
        if let [_, second, ..] = numbers.as_slice() {
            self.report(Diagnostic::error(Code::ArgsTwice, second.value.span, "`number` is given twice"));
        }
        let Some(number) = numbers.into_iter().next() else {
            if let [_, arg] = args.as_slice()
                && matches!(arg.value.kind, tree::ExprKind::Number { .. })
            {
                let message = "this is neither the name of a report nor a label of it";
                let finding = Diagnostic::error(Code::ArgsLabel, arg.value.span, message);
                self.report(finding.help(format!("the second report is `{name}(\"NAME\", number: 2)`")));
                return (args[..1].to_vec(), of_name);
            }
            return (args, of_name);
        };
        let span = number.value.span;
        if !matches!(name, "reported" | "reported_at" | "has_reported") {
            let finding = Diagnostic::error(Code::ArgsLabel, span, format!("`{name}` asks for no report of a number"));
            let help = "`reported`, `reported_at` and `has_reported` do: `reported(\"NAME\", number: 2)` is the second";
            self.report(finding.help(help));
            return (args, of_name);
        }
        let value = self.expr_as(&number.value, &Type::Int, "the number of a report");
        match value.range.constant() {
            Some(of) if (1.0..=NUMBER_MAX).contains(&of) => (args, Which::Number(of as u32)),
            _ => {
                if value.ty != Type::Unknown {
                    let message = format!("which report it is must be known: a number from 1 to {NUMBER_MAX}");
                    self.report(Diagnostic::error(Code::TestsReport, span, message));
                }
                (args, of_name)
            }
        }
    }

    /// `times_asked("camera.start")`: how often the mission asked that; `times_recorded("temperature")`: how many samples of it were recorded.
    fn count_of(&mut self, counted: Counted, name: &str, args: &[tree::Arg], span: Span) -> Expr {
        let Some([text]) = self.positional::<1>(name, args, span) else { return self.unknown(span) };
        let (what, Some(mission)) = (self.plain_text(&text), self.test.as_ref().map(|test| test.mission)) else {
            return self.unknown(span);
        };
        let (known, does, nothing) = match counted {
            Counted::Asks => (self.hir.asks(mission).into_keys().collect(), "asks", "it asks no payload"),
            Counted::Recorded => (self.hir.recorded(mission), "records", "it records nothing"),
        };
        if !known.contains(&what) {
            // That it is no text has been told.
            if !what.is_empty() {
                let finding =
                    Diagnostic::error(Code::TestsReport, text.span, format!("the mission never {does} \"{what}\""));
                self.report(match known.is_empty() {
                    true => finding.help(nothing),
                    false => finding.help(format!("it {does} {}", listed(&known))),
                });
            }
            return self.unknown(span);
        }
        let id = self.declare_hidden(format!("{name} \"{what}\""), VarKind::Signal, Type::Int, span);
        self.scope.vars[id].range = Interval::new(0.0, REPORTS_MAX);
        if let Some(test) = &mut self.test {
            test.names.counts.push((counted, what, id));
        }
        self.variable(id, span)
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
        let written = |parts: &[TextPart]| match parts {
            [] => (String::new(), true),
            [TextPart::Literal(text)] => (text.clone(), true),
            // What stands behind the first value is known when it is told.
            [TextPart::Literal(text), ..] => (text.clone(), false),
            [TextPart::Hole(_), ..] => (String::new(), false),
        };
        let may_be = |parts: &&[TextPart]| {
            let (text, is_whole) = written(parts);
            if is_whole { why == text } else { why.starts_with(&text) }
        };
        // Such as "no fresh `flow`".
        let of_machine =
            why.split('`').nth(1).is_some_and(|name| self.hir.inputs.iter().any(|input| input.name == name));
        if !of_machine && !reasons.iter().any(may_be) {
            let told = |parts: &&[TextPart]| {
                let (text, is_whole) = written(parts);
                if is_whole { text } else { text + "…" }
            };
            let known: BTreeSet<String> = reasons.iter().map(told).collect();
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

    /// `reported("leg", "length")`: what stood behind a label, or without one the value itself, in one of the reports of a name.
    fn reported_value(&mut self, what: &str, (label, at): (&str, Span), which: Which, span: Span) -> Expr {
        let sites = self.test.as_ref().and_then(|test| test.reports.get(what).cloned()).unwrap_or_default();
        let types: Vec<&Type> = sites.iter().filter_map(|labelled| labelled.get(label)).collect();
        // Whether there is such a report at all is known with when; a name that nothing reports is told there.
        let when = self.report_var(what, ReportPart::Time(which), span);
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
        if let Some(other) = another {
            let name = self.type_name(&ty);
            let message = format!("this is reported as {} here, as {} there", article(&name), article(&other));
            let finding = Diagnostic::error(Code::TestsReport, at, message);
            self.report(finding.help("`has_reported` tells whether it was reported, `reported_at` when"));
            return self.unknown(span);
        }
        let var = self.report_var_of(what, ReportPart::Value(which, label.to_string()), ty.optional(), span);
        if types.len() < sites.len() {
            let without = format!("{} has no \"{label}\", or there is none", told(which, what));
            return self.taken_for_granted(var, without, span);
        }
        self.taken_for_granted(when, lacking(which, what), span);
        self.variable(var, span).unwrapped()
    }

    /// Whether something was reported: then its first report and its last are known, or the one of a number, and their places, where each
    /// is one.
    fn has_reported(&mut self, what: &str, which: Which, all_places: bool, named: Span, span: Span) -> Expr {
        let of = |which| match all_places {
            true => vec![ReportPart::Time(which), ReportPart::Place(which)],
            false => vec![ReportPart::Time(which)],
        };
        let shown: &[Which] = if which == Which::FIRST { &[Which::FIRST, Which::Last] } else { &[which] };
        let known: Vec<Expr> = shown
            .iter()
            .copied()
            .flat_map(of)
            .map(|part| {
                let var = self.report_var(what, part, named);
                self.is_known(var, span)
            })
            .collect();
        let both = |a: Expr, b: Expr| self.operation(Builtin::And, vec![a, b], Type::Bool, span);
        known.into_iter().reduce(both).unwrap_or_else(|| self.unknown(span))
    }

    /// The value of something that may be absent: unless it is known to be there, the expectation fails without it.
    pub(super) fn taken_for_granted(&mut self, id: usize, without: String, span: Span) -> Expr {
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
            ReportPart::Time(_) => Type::Quantity(Dimension::TIME).optional(),
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

/// One of the reports of a name, in words.
fn told(which: Which, what: &str) -> String {
    match which {
        Which::FIRST => format!("the first report \"{what}\""),
        Which::Number(number) => format!("report number {number} of \"{what}\""),
        Which::Last => format!("the last report \"{what}\""),
    }
}

/// What is said where there is no such report.
fn lacking(which: Which, what: &str) -> String {
    match which {
        Which::FIRST | Which::Last => format!("nothing was reported as \"{what}\""),
        Which::Number(number) => format!("\"{what}\" was reported fewer than {number} times"),
    }
}
