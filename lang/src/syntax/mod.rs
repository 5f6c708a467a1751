//! Text to tree. Parsing never fails: it gives the tree of what it could read and findings for the rest.

mod braces;
mod build;
mod build_block;
mod build_expr;
mod confusables;
mod elsewhere;
mod errors;
mod habits;
mod places;
mod quotient;
mod scan;
mod slips;
pub mod tree;
mod words;

pub use errors::begins_item;
pub use scan::{Comment, NESTING_MAX};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};
use grammar::Grammar;
pub(crate) use grammar::Rule;
use pest::Parser;
use scan::Scanned;
use std::collections::BTreeSet;
use std::ops::Range;

/// What the grammar's file becomes.
mod grammar {
    #![allow(missing_docs, reason = "made from grammar.pest, whose rules carry their own comments")]

    #[derive(pest_derive::Parser)]
    #[grammar = "syntax/grammar.pest"]
    pub struct Grammar;
}

/// What a source says.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// All that could be read.
    pub file: tree::File,
    /// All that could not.
    pub findings: Vec<Diagnostic>,
    /// Where that stands.
    pub unread: Vec<Unread>,
    /// The comments, in order: the formatter and the documentation need them.
    pub comments: Vec<Comment>,
}

/// A stretch that could not be read. What it declares, nobody knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unread {
    /// Where.
    pub span: Span,
    /// The declaration in which it stands; none when the declaration itself could not be read.
    pub item: Option<Span>,
}

/// Reads a source file.
pub fn parse(file: FileId, source: &str) -> Parsed {
    let mut unread = Vec::new();
    let (trees, mut findings, comments, passed_over) = read(file, source, Rule::file, declarations, |b, pairs| {
        let before = b.bad.len();
        let tree = build::file(b, pairs);
        let bad = &b.bad[before..];
        unread.extend(bad.iter().map(|bad| Unread { span: bad.span, item: bad.item }));
        // A declaration whose head is unreadable is known by no name.
        unread.extend(
            bad.iter().filter(|bad| bad.place == build::Place::Head).map(|bad| Unread { span: bad.span, item: None }),
        );
        tree
    });
    unread.extend(passed_over.into_iter().map(|span| Unread { span, item: None }));
    if trees.is_empty() {
        unread.push(Unread { span: Span { file, start: 0, end: source.len() as u32 }, item: None });
    }
    findings.extend(quotient::doubts(source, &comments));
    let items = trees.into_iter().flat_map(|tree| tree.items).collect();
    Parsed { file: tree::File { items }, findings, unread, comments }
}

/// Where each declaration stands.
fn declarations(scanned: &Scanned) -> Vec<Range<usize>> {
    let ends = scanned.starts.iter().skip(1).copied().chain([scanned.text.len()]);
    scanned.starts.iter().copied().zip(ends).map(|(start, end)| start..end).collect()
}

/// Reads statements that stand in no block: the lines of a prompt.
pub fn parse_lines(file: FileId, source: &str) -> (tree::Block, Vec<Diagnostic>) {
    let whole = |scanned: &Scanned| std::iter::once(0..scanned.text.len()).collect();
    let (block, mut findings, comments, _) =
        read(file, source, Rule::lines, whole, |b, mut pairs| pairs.next().map(|pair| build_block::block(b, pair)));
    findings.extend(quotient::doubts(source, &comments));
    let nothing = tree::Block { clauses: Vec::new(), span: Span { file, start: 0, end: source.len() as u32 } };
    (block.into_iter().flatten().next().unwrap_or(nothing), findings)
}

/// Whether a text wants another line: a bracket is open, or its last line says that it goes on.
pub fn goes_on(source: &str) -> bool {
    scan::scan(FileId(0), source).goes_on
}

/// The statements and declarations that stand in no block, each as it is written: what `;` and the ends of lines part.
pub fn statements(source: &str) -> Vec<&str> {
    let scanned = scan::scan(FileId(0), source);
    let mut statements = Vec::new();
    let (mut start, mut depth, mut in_text, mut escaped) = (0, 0_usize, false, false);
    // What parts statements is one byte wide, and the text that was scanned is as long as the source.
    for (at, byte) in scanned.text.bytes().enumerate().chain([(source.len(), b'\n')]) {
        match byte {
            b'\n' | b';' if (depth == 0 && !in_text) || at == source.len() => {
                if scanned.text.get(start..at).is_some_and(|s| !s.trim().is_empty()) {
                    statements.extend(source.get(start..at).map(str::trim));
                }
                start = at + 1;
            }
            b'\n' => in_text = false,
            b'"' if !escaped => in_text = !in_text,
            b'(' | b'[' | b'{' if !in_text => depth += 1,
            b')' | b']' | b'}' if !in_text => depth = depth.saturating_sub(1),
            _ => {}
        }
        escaped = in_text && byte == b'\\' && !escaped;
    }
    statements
}

/// What the grammar reads in a source without mistakes: every word, in the rules to which it belongs.
pub(crate) fn concrete<T>(
    file: FileId,
    source: &str,
    build: impl FnOnce(pest::iterators::Pairs<Rule>) -> T,
) -> Option<T> {
    let scanned = scan::scan(file, source);
    if !scanned.brackets_fit() {
        return None;
    }
    Grammar::parse(Rule::file, &scanned.text).ok().map(build)
}

/// A stretch of a source with blanks for its comments.
pub(crate) fn uncommented(file: FileId, stretch: &str) -> String {
    scan::scan(file, stretch).text
}

/// Reads a source by a rule of the grammar, a part at a time: what was built of each, the findings, the comments, the parts that were
/// passed over. What the grammar makes of a text is far larger than the text: of a part it is small, and soon gone. A part whose brackets
/// do not fit, however its margins are read, is passed over: the grammar would look for the end of each block once more for each that it
/// stands in.
fn read<T>(
    file: FileId,
    source: &str,
    rule: Rule,
    parts: impl FnOnce(&Scanned) -> Vec<Range<usize>>,
    mut build: impl FnMut(&mut build::Builder, pest::iterators::Pairs<Rule>) -> T,
) -> (Vec<T>, Vec<Diagnostic>, Vec<Comment>, Vec<Span>) {
    let mut scanned = scan::scan_mended(file, source);
    let mut findings = std::mem::take(&mut scanned.findings);
    // Too deep: the grammar itself would be at the mercy of the thread's stack.
    if findings.iter().any(|f| f.code == Code::SyntaxNesting) {
        return (Vec::new(), findings, scanned.comments, Vec::new());
    }
    let mut builder = build::Builder::new(file);
    let (mut built, mut passed_over) = (Vec::new(), Vec::new());
    let all_fit = !findings.iter().any(|f| f.code == Code::SyntaxBracket);
    for part in parts(&scanned) {
        let span = Span { file, start: part.start as u32, end: part.end as u32 };
        builder.base = part.start;
        let text = &scanned.text[part];
        if !(all_fit || scan::scan(file, text).brackets_fit()) {
            passed_over.push(span);
            continue;
        }
        match Grammar::parse(rule, text) {
            Ok(pairs) => built.push(build(&mut builder, pairs)),
            Err(error) => findings.push(errors::finding(file, text, builder.base, &error)),
        }
    }
    findings.append(&mut builder.refused);
    // A bracket that does not fit has been reported: what it made unreadable is no second mistake.
    let told = ReportedLines::of(&findings, source);
    let unread: Vec<_> = builder.bad.iter().filter(|bad| !told.touches(bad.span)).collect();
    let callable = if unread.is_empty() { BTreeSet::new() } else { errors::callable(&scanned.text) };
    findings.extend(unread.into_iter().map(|bad| errors::of_bad_stretch(file, &scanned.text, &callable, bad)));
    (built, findings, scanned.comments, passed_over)
}

/// Reads one expression, such as the value of `--set lambda=6s`.
pub fn parse_expression(file: FileId, source: &str) -> Result<tree::Expr, Diagnostic> {
    let scanned = scan::scan(file, source);
    if let Some(finding) = scanned.findings.into_iter().next() {
        return Err(finding);
    }
    let text = scanned.text.trim_end();
    let mut builder = build::Builder::new(file);
    match Grammar::parse(Rule::expr_only, text) {
        Ok(mut pairs) => match pairs.next() {
            Some(pair) => {
                let value = build_expr::expr(&mut builder, pair);
                builder.refused.into_iter().next().map_or(Ok(value), Err)
            }
            None => Err(Diagnostic::error(Code::SyntaxExpected, Span { file, start: 0, end: 0 }, "a value is missing")),
        },
        Err(error) => Err(errors::finding(file, text, 0, &error)),
    }
}

/// The lines of which something has been said, in order: from the first byte of the first to the last of the last.
struct ReportedLines(Vec<(u32, u32)>);

impl ReportedLines {
    fn of(findings: &[Diagnostic], source: &str) -> Self {
        // Where lines end is looked up: there may be as many findings as there are characters, and all of them on one line.
        let ends: Vec<u32> = source.match_indices('\n').map(|(at, _)| at as u32).collect();
        let lines = findings.iter().filter(|f| f.code.group() == "syntax").map(|finding| {
            let Span { start, end, .. } = finding.span();
            let before = ends[..ends.partition_point(|at| *at < start)].last().map_or(0, |at| at + 1);
            let after = ends.get(ends.partition_point(|at| *at < end));
            (before, after.copied().unwrap_or(source.len() as u32))
        });
        let mut lines: Vec<(u32, u32)> = lines.collect();
        lines.sort_unstable();
        ReportedLines(lines)
    }

    /// Stretches of which something has been said overlap nowhere, but for those of one line.
    fn touches(&self, span: Span) -> bool {
        let next = self.0.partition_point(|&(start, _)| start <= span.end);
        self.0[..next].last().is_some_and(|&(_, end)| span.start <= end)
    }
}

#[cfg(test)]
mod tests {
    use super::statements;

    #[test]
    fn statements_are_parted_where_nothing_is_open() {
        assert_eq!(statements("a; b\nc // d; e\n"), ["a", "b", "c // d; e"]);
        assert_eq!(
            statements("fn f() -> Int {\n 1; 2\n}\nlog \"a; {b}\""),
            ["fn f() -> Int {\n 1; 2\n}", "log \"a; {b}\""]
        );
        assert_eq!(statements("a +\n b"), ["a +\n b"]);
        assert_eq!(statements("if x { a }\nelse { b }"), ["if x { a }\nelse { b }"]);
        assert_eq!(statements("log \"é\"; ( ; "), ["log \"é\"", "( ;"]);
        assert!(statements(" ;; \n // nothing").is_empty());
    }
}
