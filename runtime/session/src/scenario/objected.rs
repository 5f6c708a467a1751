//! What the simulator objects to, at its place in the script and in the script's own units.

use albacore_lang::code::Code;
use albacore_lang::diagnostic::Diagnostic;
use albacore_lang::{ScenarioArg, ScenarioClause, ScenarioProgram, ScenarioValue};
use albacore_program::{Shape, number};
use albacore_sim::{IssueCause, ScenarioIssue};

/// What cannot be, at the argument or the clause that says it; what no clause says, at the scenario's name.
pub fn objected(scenario: &ScenarioProgram, objection: &ScenarioIssue) -> Diagnostic {
    let clause = clause(&scenario.clauses, objection);
    let arg = clause.zip(objection.param).and_then(|(clause, param)| argument(clause, param));
    // What nobody wrote stands nowhere.
    let written = arg.filter(|arg| !arg.is_default);
    let span = written.map(|arg| arg.span).or(clause.map(|clause| clause.span)).unwrap_or(scenario.span);
    let (message, mend) = match &objection.why {
        IssueCause::Said(message, mend) => (message.clone(), mend.clone()),
        IssueCause::Over(value, most) => {
            let param = objection.param.unwrap_or_default();
            let message = format!("`{param}` of `{}` is {}", objection.clause, in_units(arg, *value));
            (message, format!("it must be {} at most", in_units(arg, *most)))
        }
    };
    Diagnostic::error(Code::ScenariosWorld, span, message).help(mend)
}

/// The clause that is meant: one on a line of the scenario, else one that is the value of another.
fn clause<'a>(clauses: &'a [ScenarioClause], objection: &ScenarioIssue) -> Option<&'a ScenarioClause> {
    let line = clauses.iter().filter(|clause| clause.name == objection.clause).nth(objection.nth);
    line.or_else(|| clauses.iter().find_map(|clause| value_of(clause, objection.clause)))
}

/// The clause of a name among the values of another.
fn value_of<'a>(clause: &'a ScenarioClause, name: &str) -> Option<&'a ScenarioClause> {
    values(clause).find_map(|value| if value.name == name { Some(value) } else { value_of(value, name) })
}

/// An argument of a clause, or of those that are its values.
fn argument<'a>(clause: &'a ScenarioClause, param: &str) -> Option<&'a ScenarioArg> {
    let own = clause.args.iter().find(|arg| arg.name == param);
    own.or_else(|| values(clause).find_map(|value| argument(value, param)))
}

fn values(clause: &ScenarioClause) -> impl Iterator<Item = &ScenarioClause> {
    clause.args.iter().filter_map(|arg| match &arg.value {
        ScenarioValue::Clause(value) => Some(value),
        ScenarioValue::Words(..) | ScenarioValue::Text(_) => None,
    })
}

/// A number in the unit of an argument; of a velocity its size.
fn in_units(arg: Option<&ScenarioArg>, x: f64) -> String {
    let shape = match arg.map(|arg| &arg.value) {
        Some(ScenarioValue::Words(_, Shape::Vector(display))) => Shape::Quantity(display.clone()),
        Some(ScenarioValue::Words(_, shape)) => shape.clone(),
        _ => return format!("{x}"),
    };
    number::brief(&[], &shape, &[x])
}
