//! Messages on standard error: findings with their source, and plain errors with their help.

use albacore_session::seen::{masked, one_line, shortened, shown};
use albacore_session::{Diagnostic, FileId, Severity, Sources, Span};
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource};
use std::collections::BTreeSet;
use std::fmt;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Lines longer than this, in bytes, are not drawn.
const LINE_MAX: usize = 400;

/// So many findings are drawn, errors before warnings: nobody reads more, and each takes a look through its whole file.
const DRAWN_MAX: usize = 100;

/// A label this many lines from the mistake, or more, is drawn after it: else all between would be drawn, or the label
/// before the mistake.
const FAR_LINES: usize = 5;

/// A finding in the form that the renderer takes: first the mistake with what is labelled near it, then, each as
/// a finding of its own, what stands in other files or far away.
struct Shown<'a> {
    finding: &'a Diagnostic,
    source: NamedSource<String>,
    labels: Vec<LabeledSpan>,
    related: Vec<Shown<'a>>,
    message: String,
    is_part: bool,
}

impl<'a> Shown<'a> {
    fn new(finding: &'a Diagnostic, sources: &Sources) -> Self {
        let place = finding.span();
        let line = |span: Span| sources.line_column(span).0;
        // The file in whose "see also" a label is drawn: none when it is drawn with the mistake.
        let apart = |span: Span| {
            let far = span.file != place.file || line(span).abs_diff(line(place)) >= FAR_LINES;
            far.then_some(span.file)
        };
        let frames: Vec<Option<FileId>> = finding.labels.iter().map(|(span, _)| apart(*span)).collect();
        let part = |frame: Option<FileId>, message: &str| {
            let labels = finding.labels.iter().enumerate().filter(|(i, _)| frames[*i] == frame);
            let source = sources.get(frame.unwrap_or(place.file));
            Shown {
                finding,
                source: NamedSource::new(one_line(&source.name), masked(&source.text)),
                labels: labels.map(|(i, label)| drawn(i == 0, label)).collect(),
                related: Vec::new(),
                message: words(message),
                is_part: frame.is_some(),
            }
        };
        let others: BTreeSet<FileId> = frames.iter().flatten().copied().collect();
        let related = others.into_iter().map(|file| part(Some(file), "see also")).collect();
        Shown { related, ..part(None, &finding.message) }
    }
}

/// The frame is headed by the line and column of the mistake, not of the first label in the file.
fn drawn(is_mistake: bool, (span, text): &(Span, String)) -> LabeledSpan {
    let text = if text.is_empty() { None } else { Some(words(text)) };
    let place = (span.start as usize, (span.end - span.start) as usize);
    if is_mistake { LabeledSpan::new_primary_with_span(text, place) } else { LabeledSpan::new_with_span(text, place) }
}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Shown<'_> {}

impl miette::Diagnostic for Shown<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        (!self.is_part).then(|| Box::new(self.finding.code) as Box<dyn fmt::Display>)
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match (self.is_part, self.finding.severity) {
            (true, _) => miette::Severity::Advice,
            (_, Severity::Error) => miette::Severity::Error,
            (_, Severity::Warning) => miette::Severity::Warning,
            (_, Severity::Note) => miette::Severity::Advice,
        })
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        let help = self.finding.help.as_ref().filter(|_| !self.is_part)?;
        Some(Box::new(words(help)))
    }

    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        Some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }

    fn related<'b>(&'b self) -> Option<Box<dyn Iterator<Item = &'b dyn miette::Diagnostic> + 'b>> {
        if self.related.is_empty() {
            return None;
        }
        Some(Box::new(self.related.iter().map(|r| r as &dyn miette::Diagnostic)))
    }
}

/// A finding without its frame: for lines that no terminal could show.
fn plain(finding: &Diagnostic, sources: &Sources) -> String {
    let place = finding.span();
    let (line, column) = sources.line_column(place);
    let help = finding.help.as_ref().map(|help| self::line(&format!("  help: {help}"))).unwrap_or_default();
    let name = &sources.get(place.file).name;
    let (message, place) = (self::line(&finding.message), self::line(&format!("[{name}:{line}:{column}]")));
    // The signs with which the others are drawn.
    let sign = match finding.severity {
        Severity::Error => '×',
        Severity::Warning => '⚠',
        Severity::Note => '☞',
    };
    format!("{}\n\n  {sign} {message}    {place}{help}\n", finding.code)
}

/// Findings that were printed already: a script that is read again has the same again.
#[derive(Default)]
pub struct Said(BTreeSet<(String, u32, u32, String)>);

impl Said {
    /// Those of findings that were not printed yet, which they now are taken to be.
    pub fn news(&mut self, findings: &[Diagnostic], sources: &Sources) -> Vec<Diagnostic> {
        let is_new = |finding: &&Diagnostic| {
            let Span { file, start, end } = finding.span();
            self.0.insert((sources.get(file).name.to_string(), start, end, finding.message.clone()))
        };
        findings.iter().filter(is_new).cloned().collect()
    }
}

/// Prints findings, in order, and how many there are.
pub fn findings(findings: &[Diagnostic], sources: &Sources) {
    let theme = match (std::io::stderr().is_terminal(), std::env::var_os("NO_COLOR")) {
        (true, None) => GraphicalTheme::unicode(),
        _ => GraphicalTheme::unicode_nocolor(),
    };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(120).with_links(false);
    let mut text = String::new();
    let mut drawn: Vec<&Diagnostic> = findings.iter().collect();
    if drawn.len() > DRAWN_MAX {
        drawn.sort_by_key(|f| f.severity);
        drawn.truncate(DRAWN_MAX);
    }
    for &finding in &drawn {
        if finding.labels.iter().any(|(span, _)| sources.line_length(*span) > LINE_MAX) {
            text.push_str(&plain(finding, sources));
            continue;
        }
        let drawable = Shown::new(finding, sources);
        if handler.render_report(&mut text, &drawable).is_err() {
            text.push_str(&drawable.message);
        }
        text.push('\n');
    }
    if drawn.len() < findings.len() {
        text.push_str(&format!("and {} more\n\n", findings.len() - drawn.len()));
    }
    let count = |severity: Severity| findings.iter().filter(|f| f.severity == severity).count();
    let several = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let counted: Vec<String> = [(Severity::Error, "error"), (Severity::Warning, "warning"), (Severity::Note, "note")]
        .into_iter()
        .map(|(severity, what)| (count(severity), what))
        .filter(|(n, _)| *n > 0)
        .map(|(n, what)| several(n, what))
        .collect();
    if !counted.is_empty() {
        text.push_str(&format!("{}\n", counted.join(", ")));
    }
    raw(&text);
}

/// Says where a person learns more of what was found. Who reads a log, or has the next message a line later, needs no such line.
pub fn more(findings: &[Diagnostic]) {
    let error = findings.iter().find(|f| f.severity == Severity::Error);
    if let Some(error) = error.filter(|_| std::io::stderr().is_terminal()) {
        write(&format!("`albacore explain {}` tells more\n", error.code));
    }
}

/// Prints an error that stands in no script.
pub fn error(message: &str, help: Option<&str>) {
    write(&error_text(message, help));
}

/// The same, for who prints it: two lines at most, whatever texts of others are on them.
pub fn error_text(message: &str, help: Option<&str>) -> String {
    let mut text = line(&format!("error: {message}"));
    if let Some(help) = help {
        text.push_str(&line(&format!("  help: {help}")));
    }
    text
}

/// A warning that belongs to no place in a script.
pub fn warning(message: &str, help: &str) {
    write(&(line(&format!("warning: {message}")) + &line(&format!("  help: {help}"))));
}

/// Says that a file which was written anew has had other names: those lead to what it held before.
pub fn parted(path: &Path, others: u64) {
    if others == 0 {
        return;
    }
    let names = if others == 1 {
        "another name (a hard link)".to_string()
    } else {
        format!("{others} other names (hard links)")
    };
    let what = format!(
        "warning: `{}` had {names}, which {} what it held before",
        path.display(),
        if others == 1 { "keeps" } else { "keep" }
    );
    write(&(line(&what) + &line("  help: link them anew where they should be one file")));
}

/// A line of a message, which stays one.
pub fn line(text: &str) -> String {
    words(text) + "\n"
}

/// What a message says, on one line, however long the names are that it quotes.
fn words(text: &str) -> String {
    one_line(&shortened(text))
}

/// Writes for a person: what cannot be seen is written out, for texts of scripts, vehicles and files are in it.
pub fn write(text: &str) {
    raw(&shown(text));
}

/// Who takes messages in the place of standard error.
type Taker = Box<dyn Fn(&str) + Send>;

static TAKER: Mutex<Option<Taker>> = Mutex::new(None);

/// From here on somebody else sees to it that messages are written; or nobody, and then each is written at once.
pub fn hand_to(taker: Option<Taker>) {
    *TAKER.lock().unwrap_or_else(PoisonError::into_inner) = taker;
}

/// Writes what has been made to be seen, or hands it to who does.
fn raw(text: &str) {
    match &*TAKER.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(take) => take(text),
        None => print(text),
    }
}

/// Writes it at once. Standard error may be closed: then nobody listens, and that is all.
pub fn print(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}
