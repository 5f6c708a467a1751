//! `let n = 7 // 3`: elsewhere a quotient that is rounded down, here a comment that leaves the divisor out.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// What is to be said of comments that are a whole number alone, after a bare number or name that is given to another.
pub(super) fn doubts(source: &str, comments: &[Span]) -> Vec<Diagnostic> {
    comments.iter().filter_map(|comment| doubt(source, *comment)).collect()
}

fn doubt(source: &str, comment: Span) -> Option<Diagnostic> {
    let (before, divisor) = (source.get(..comment.start as usize)?, source.get(comment.start as usize..)?);
    let divisor = divisor.lines().next()?.strip_prefix("//")?.trim();
    let line = before.rsplit(['\n', ';', '{']).next()?;
    let (name, operand) = line.split_once('=')?;
    let is_given = name.trim_end().ends_with(|c: char| c.is_alphanumeric() || c == '_');
    let operand = operand.trim();
    // A unit, a range, a comparison or anything else that is computed is followed by a comment more often than by a divisor.
    let is_plain = !operand.is_empty() && operand.chars().all(|c| c.is_alphanumeric() || c == '_');
    let is_number = !divisor.is_empty() && divisor.chars().all(|c| c.is_ascii_digit());
    (is_given && is_plain && is_number).then(|| {
        Diagnostic::warning(Code::SyntaxComment, comment, "`//` begins a comment: nothing is divided here").help(
            format!("what is rounded down is written `floor({operand} / {divisor})`; for a comment begin with a word"),
        )
    })
}
