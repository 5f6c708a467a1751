//! `7 // 3`: elsewhere a quotient that is rounded down, here a comment that leaves the divisor out.

use super::scan::Comment;
use crate::code::Code;
use crate::diagnostic::Diagnostic;

/// What is to be said of comments that are a number, after a number or what is computed.
pub(super) fn doubts(source: &str, comments: &[Comment]) -> Vec<Diagnostic> {
    comments.iter().filter_map(|comment| doubt(source, comment)).collect()
}

fn doubt(source: &str, comment: &Comment) -> Option<Diagnostic> {
    let (before, divisor) = (source.get(..comment.span.start as usize)?, source.get(comment.span.start as usize..)?);
    let divisor = divisor.lines().next()?.strip_prefix("//")?.trim().trim_end_matches(')');
    let is_number = divisor.starts_with(|c: char| c.is_ascii_digit())
        && divisor.chars().all(|c| c.is_ascii_digit() || c == '.' || c == '_');
    let line = before.rsplit(['\n', ';', '{']).next()?.trim_end();
    let operand = &line[line.trim_end_matches(|c: char| c.is_alphanumeric() || matches!(c, '.' | '_')).len()..];
    let computes = operand.starts_with(|c: char| c.is_ascii_digit()) || line.contains('=');
    (is_number && !operand.is_empty() && computes).then(|| {
        Diagnostic::warning(Code::SyntaxComment, comment.span, "`//` begins a comment: nothing is divided here").help(
            format!("what is rounded down is written `floor({operand} / {divisor})`; for a comment begin with a word"),
        )
    })
}
