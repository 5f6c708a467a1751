//! How well a broken script is told where it is broken: each script loses every 24th of its tokens in turn, and is cut off
//! after each of them. The figures of all tokens, and what is not told well, are printed by
//!
//! ```text
//! TOKENS=all cargo test --test scripts resilience:: -- --nocapture
//! ```
//!
//! - A *case* is a script that an edit made wrong. What is sound without a token is none.
//! - A case is told *in place* when the first finding that it did not have before, in the order shown, lies within one line of the edit.
//! - It is told *usefully* when that finding also is an error which says more than that something is wrong: it has a help,
//!   or says what was expected, what is missing or what is open; and when no more than three errors come of the one edit.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test whose scripts cannot be read has failed; figures are printed"
)]

use albacore_lang::syntax::words::is_reserved;
use albacore_session::{Diagnostic, FileId, Files, Script, Severity, Source};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A line further from the edit than this is another place.
const NEAR_LINES: usize = 1;
/// More errors than this are a cascade.
const ERRORS_MAX: usize = 3;
/// Every how manieth token counts: all of them take minutes.
const EVERY: usize = 24;
/// What must be told in place, in hundredths.
const FLOOR: usize = 90;

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Kind {
    Keyword,
    Name,
    Number,
    Text,
    Bracket,
    Sign,
}

struct Token {
    start: usize,
    end: usize,
    kind: Kind,
}

/// The tokens of a script; comments are none.
fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let (length, kind) = match c {
            c if c.is_whitespace() => (c.len_utf8(), None),
            '/' if rest.starts_with("//") => (rest.find('\n').unwrap_or(rest.len()), None),
            '"' => (text_length(rest), Some(Kind::Text)),
            '0'..='9' => (number_length(rest), Some(Kind::Number)),
            c if word(c) => {
                let length = rest.find(|c| !word(c)).unwrap_or(rest.len());
                let keyword = is_reserved(&rest[..length]);
                (length, Some(if keyword { Kind::Keyword } else { Kind::Name }))
            }
            '(' | ')' | '[' | ']' | '{' | '}' => (1, Some(Kind::Bracket)),
            c => {
                let long = ["..<", "->", "..", "==", "!=", "<=", ">="].into_iter().find(|sign| rest.starts_with(sign));
                (long.map_or(c.len_utf8(), str::len), Some(Kind::Sign))
            }
        };
        tokens.extend(kind.map(|kind| Token { start: at, end: at + length, kind }));
        at += length;
    }
    tokens
}

fn text_length(rest: &str) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            '\n' => return at,
            _ => escaped = c == '\\' && !escaped,
        }
    }
    rest.len()
}

fn number_length(rest: &str) -> usize {
    let digits = |from: usize| rest[from..].find(|c: char| !c.is_ascii_digit()).map_or(rest.len(), |n| from + n);
    let whole = digits(0);
    if rest[whole..].starts_with('.') && digits(whole + 1) > whole + 1 { digits(whole + 1) } else { whole }
}

/// The scripts of the repository that are sound.
fn scripts() -> Vec<(PathBuf, String)> {
    let mut paths: Vec<PathBuf> = ["stdlib", "missions", "missions/figures", "tests/rules", "tests/link"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "alb"))
        .collect();
    paths.sort();
    let texts = paths.into_iter().map(|path| {
        let text = std::fs::read_to_string(&path).unwrap();
        (path, text)
    });
    let sound: Vec<_> = texts.filter(|(path, text)| check(path, text).is_sound()).collect();
    assert!(sound.len() > 20);
    sound
}

fn check(path: &Path, text: &str) -> Script {
    let source = Source { name: path.display().to_string().into(), text: text.into() };
    albacore_lang::load(source, &Files::around(path), None, &[])
}

/// A script as it is, with the messages that it gives.
struct Whole<'a> {
    path: &'a Path,
    text: &'a str,
    warnings: BTreeSet<String>,
}

impl<'a> Whole<'a> {
    fn of(path: &'a Path, text: &'a str) -> Self {
        let warnings = check(path, text).findings.into_iter().map(|finding| finding.message).collect();
        Whole { path, text, warnings }
    }
}

/// What became of some edits.
#[derive(Default, Clone)]
struct Tally {
    edits: usize,
    cases: usize,
    in_place: usize,
    useful: usize,
}

impl Tally {
    fn share(&self, part: usize) -> f64 {
        100.0 * part as f64 / self.cases.max(1) as f64
    }
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Tally { edits, cases, in_place, useful } = self;
        let (place, use_) = (self.share(*in_place), self.share(*useful));
        write!(
            f,
            "{edits:6} edits {:6} sound {cases:6} cases {place:6.2} % in place {use_:6.2} % useful",
            edits - cases
        )
    }
}

/// What is told of one edit; nothing when the script is sound without what it took.
struct Told {
    in_place: bool,
    useful: bool,
    said: String,
}

fn says_more(finding: &Diagnostic) -> bool {
    let says = |what: &str| finding.message.contains(what);
    finding.help.is_some() || says("expected ") || says("missing") || says("never closed") || says(", not ")
}

/// Judges what is newly said of a script: `near` tells which places are the edit's own.
fn told(whole: &Whole, script: &Script, near: impl Fn(&Diagnostic) -> bool) -> Option<Told> {
    if script.is_sound() {
        return None;
    }
    let first = script.findings.iter().find(|finding| !whole.warnings.contains(&finding.message))?;
    let errors = script.findings.iter().filter(|f| f.severity == Severity::Error).count();
    let in_place = near(first);
    let useful = in_place && first.severity == Severity::Error && says_more(first) && errors <= ERRORS_MAX;
    let (line, column) = script.sources.line_column(first.span());
    let file = script.sources.get(first.span().file);
    let said = format!("{file}:{line}:{column} [{} errors] {} | {:?}", errors, first.message, first.help);
    Some(Told { in_place, useful, said })
}

fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}

fn is_near(script: &Script, finding: &Diagnostic, line: usize) -> bool {
    let span = finding.span();
    span.file == FileId(0) && script.sources.line_column(span).0.abs_diff(line) <= NEAR_LINES
}

/// A script without one of its tokens.
fn without(whole: &Whole, token: &Token) -> Option<Told> {
    let text = whole.text;
    let script = check(whole.path, &format!("{}{}", &text[..token.start], &text[token.end..]));
    let line = line_of(text, token.start);
    told(whole, &script, |finding| is_near(&script, finding, line))
}

/// A script that ends with one of its tokens: told in place is also what was opened and is not closed.
fn cut(whole: &Whole, token: &Token) -> Option<Told> {
    let script = check(whole.path, &whole.text[..token.end]);
    let line = line_of(whole.text, token.start);
    told(whole, &script, |finding| finding.message.contains("never closed") || is_near(&script, finding, line))
}

/// Makes an edit at every 24th token of every script, or at each; gives what all of them come to. Each is passed on to `each`.
fn measure(
    edit: impl Fn(&Whole, &Token) -> Option<Told>,
    mut each: impl FnMut(&Whole, &Token, &Option<Told>),
) -> Tally {
    let every = if std::env::var_os("TOKENS").is_some() { 1 } else { EVERY };
    let mut all = Tally::default();
    for (path, text) in scripts() {
        let whole = Whole::of(&path, &text);
        for token in tokens(&text).into_iter().step_by(every) {
            let told = edit(&whole, &token);
            add(&mut all, &told);
            each(&whole, &token, &told);
        }
    }
    all
}

fn add(tally: &mut Tally, told: &Option<Told>) {
    tally.edits += 1;
    if let Some(told) = told {
        tally.cases += 1;
        tally.in_place += usize::from(told.in_place);
        tally.useful += usize::from(told.useful);
    }
}

/// Prints what is not told well, and the figures.
fn report(name: &str, edit: impl Fn(&Whole, &Token) -> Option<Told>) -> Tally {
    let mut kinds: BTreeMap<Kind, Tally> = BTreeMap::new();
    let mut files: BTreeMap<PathBuf, Tally> = BTreeMap::new();
    let all = measure(edit, |Whole { path, text, .. }, token, told| {
        add(kinds.entry(token.kind).or_default(), told);
        add(files.entry(path.to_path_buf()).or_default(), told);
        if let Some(told) = told.as_ref().filter(|told| !told.useful) {
            let what = if told.in_place { "useless" } else { "elsewhere" };
            let line = text.lines().nth(line_of(text, token.start) - 1).unwrap_or("").trim();
            let place = format!("{}:{}", path.display(), line_of(text, token.start));
            println!("{name} {what} {place} `{}` of `{line}`\n    {}", &text[token.start..token.end], told.said);
        }
    });
    let mut worst: Vec<_> = files.into_iter().collect();
    worst.sort_by(|(_, a), (_, b)| a.share(a.in_place).total_cmp(&b.share(b.in_place)));
    for (path, tally) in worst.iter().take(8) {
        println!("{name}: {tally}  {}", path.display());
    }
    for (kind, tally) in kinds {
        println!("{name}: {tally}  {kind:?}");
    }
    println!("{name}: {all}  all");
    all
}

#[test]
fn a_missing_token_is_told_where_it_is_missing() {
    let tally = report("missing", without);
    assert!(tally.in_place * 100 >= tally.cases * FLOOR, "{tally}");
    assert!(tally.useful * 100 >= tally.cases * FLOOR, "{tally}");
}

#[test]
fn a_script_cut_off_is_told_what_is_open() {
    let tally = report("cut", cut);
    assert!(tally.in_place * 100 >= tally.cases * FLOOR, "{tally}");
    assert!(tally.useful * 100 >= tally.cases * FLOOR, "{tally}");
}
