//! Source text to one tree. Parsing never fails: it gives the tree of what it could read and findings for the rest.
//!
//! A script is scanned (`scan`), mended where brackets are missing (`braces`), read by the grammar (`albacore_grammar`) into a
//! concrete tree (`concrete`), and built (`build`) into what the checker reads (`tree`). Layout (`fmt`) and the pages about
//! scripts (`doc`) read the same tree. What is wrong is a [`Diagnostic`] with a [`Code`].

mod braces;
mod build;
mod build_block;
mod build_expr;
pub mod code;
mod concrete;
mod confusables;
pub mod diagnostic;
pub mod doc;
mod elsewhere;
mod errors;
pub mod fmt;
mod habits;
pub mod other_languages;
mod places;
mod quotient;
mod scan;
mod slips;
pub mod source;
pub mod tree;
pub mod words;

pub use concrete::ConcreteTree;
pub(crate) use concrete::Node;
pub use scan::NESTING_MAX;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Span};
use albacore_grammar::Grammar;
pub(crate) use albacore_grammar::Rule;
use concrete::Planter;
use pest::Parser;
use pest::iterators::Pair;
use scan::Scanned;
use std::collections::BTreeSet;
use std::ops::Range;

/// What a source says.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// All that could be read, and where what could not stands.
    pub concrete: ConcreteTree,
    /// What that says.
    pub file: tree::File,
    /// All that could not be read.
    pub findings: Vec<Diagnostic>,
    /// Where that stands.
    pub unread: Vec<Unread>,
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
    let Read { concrete, built, bad, passed_over, findings } =
        read(file, source, Rule::file, declarations, build::file);
    let mut unread: Vec<Unread> = bad.iter().map(|bad| Unread { span: bad.span, item: bad.item }).collect();
    // A declaration whose head is unreadable is known by no name.
    let heads = bad.iter().filter(|bad| bad.place == build::Place::Head).map(|bad| bad.span);
    unread.extend(heads.chain(passed_over).map(|span| Unread { span, item: None }));
    Parsed { concrete, file: built, findings, unread }
}

/// A source as the grammar is given it: blanks for comments, and line ends only where they end something. For who measures what is added to the
/// grammar's own work.
pub fn prepared(source: &str) -> String {
    scan::scan(FileId(0), source).text
}

/// Where each declaration stands.
fn declarations(scanned: &Scanned) -> Vec<Range<usize>> {
    let ends = scanned.starts.iter().skip(1).copied().chain([scanned.text.len()]);
    scanned.starts.iter().copied().zip(ends).map(|(start, end)| start..end).collect()
}

/// Reads statements that stand in no block: the lines of a prompt.
pub fn parse_lines(file: FileId, source: &str) -> (tree::Block, Vec<Diagnostic>) {
    let whole = |scanned: &Scanned| std::iter::once(0..scanned.text.len()).collect();
    let read = read(file, source, Rule::lines, whole, build_block::block);
    (read.built, read.findings)
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

/// A stretch of a source with blanks for its comments.
pub fn uncommented(file: FileId, stretch: &str) -> String {
    scan::scan(file, stretch).text
}

/// What came of reading a source.
struct Read<T> {
    concrete: ConcreteTree,
    built: T,
    /// The stretches that could not be read, and the parts that were passed over.
    bad: Vec<build::Bad>,
    passed_over: Vec<Span>,
    findings: Vec<Diagnostic>,
}

/// Reads a source by a rule of the grammar, a part at a time, and builds what it says. What the grammar makes of a text is far larger than
/// the text: of a part it is small, and soon gone. A part whose brackets do not fit, however its margins are read, is passed over: the
/// grammar would look for the end of each block once more for each that it stands in.
fn read<T>(
    file: FileId,
    source: &str,
    rule: Rule,
    parts: impl FnOnce(&Scanned) -> Vec<Range<usize>>,
    build: impl FnOnce(&mut build::Builder, Node) -> T,
) -> Read<T> {
    let mut scanned = scan::scan_mended(file, source);
    let mut findings = std::mem::take(&mut scanned.findings);
    let scanned = scanned;
    let mut planter = Planter::new(file, source, &scanned, rule);
    let mut passed_over = Vec::new();
    // Too deep: the grammar itself would be at the mercy of the thread's stack.
    let too_deep = findings.iter().any(|f| f.code == Code::SyntaxNesting);
    let all_fit = !findings.iter().any(|f| f.code == Code::SyntaxBracket);
    for part in parts(&scanned) {
        let span = Span { file, start: part.start as u32, end: part.end as u32 };
        let text = &scanned.text[part.clone()];
        if too_deep || !(all_fit || scan::scan(file, text).brackets_fit()) {
            planter.unread(part.end);
            passed_over.push(span);
            continue;
        }
        match Grammar::parse(rule, text) {
            Ok(pairs) => planter.read(part.start, pairs.flat_map(Pair::into_inner)),
            Err(error) => {
                planter.unread(part.end);
                passed_over.push(span);
                findings.push(errors::finding(file, text, part.start, &error));
            }
        }
    }
    let concrete = planter.finish();
    let mut builder = build::Builder::new(&scanned.text);
    let built = build(&mut builder, concrete.root(source));
    findings.append(&mut builder.refused);
    // A bracket that does not fit has been reported: what it made unreadable is no second mistake.
    let told = ReportedLines::of(&findings, source);
    let unread: Vec<_> = builder.bad.iter().filter(|bad| !told.touches(bad.span)).collect();
    let callable = if unread.is_empty() { BTreeSet::new() } else { errors::callable(&scanned.text) };
    findings.extend(unread.into_iter().map(|bad| errors::of_bad_stretch(file, &scanned.text, &callable, bad)));
    findings.extend(quotient::doubts(source, &scanned.comments));
    Read { concrete, built, bad: builder.bad, passed_over, findings }
}

/// Reads one expression, such as the value of `--set lambda=6s`.
pub fn parse_expression(file: FileId, source: &str) -> Result<tree::Expr, Diagnostic> {
    let mut scanned = scan::scan(file, source);
    if !scanned.findings.is_empty() {
        return Err(scanned.findings.swap_remove(0));
    }
    let text = scanned.text.trim_end();
    let pairs = Grammar::parse(Rule::expr_only, text).map_err(|error| errors::finding(file, text, 0, &error))?;
    let mut planter = Planter::new(file, source, &scanned, Rule::expr_only);
    planter.read(0, pairs);
    let concrete = planter.finish();
    let mut builder = build::Builder::new(&scanned.text);
    let Some(node) = concrete.root(source).inner().next() else {
        return Err(Diagnostic::error(Code::SyntaxExpected, Span { file, start: 0, end: 0 }, "a value is missing"));
    };
    let value = build_expr::expr(&mut builder, node);
    builder.refused.into_iter().next().map_or(Ok(value), Err)
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
