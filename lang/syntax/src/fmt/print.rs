//! Chooses where lines end: what fits stays on one line, else the outermost bracket or operator is broken first.

use super::document::{Clause, Comment, Doc, Indent, Word};
use super::{INDENT, WIDTH};

/// A line of the result.
#[derive(Debug, Default)]
pub struct Line<'a> {
    /// A blank line comes before it.
    pub blank: bool,
    pub indent: usize,
    pub words: Vec<Word<'a>>,
    pub comment: Option<Comment<'a>>,
    /// Blanks before the comment.
    pub comment_blanks: usize,
    /// The declaration of the file in which it stands.
    pub item: usize,
    /// The clause that begins here, and whether it ends here.
    pub clause: Option<(Clause<'a>, bool)>,
}

impl Line<'_> {
    /// Where its words end.
    pub fn width(&self) -> usize {
        self.indent + self.words.iter().map(width).sum::<usize>()
    }

    /// As it is written.
    pub fn text(&self) -> String {
        let mut text = String::new();
        if self.blank {
            text.push('\n');
        }
        let blanks = |text: &mut String, n: usize| text.extend(std::iter::repeat_n(' ', n));
        blanks(&mut text, self.indent);
        for word in &self.words {
            blanks(&mut text, word.blanks);
            text.push_str(word.text);
        }
        if let Some(comment) = &self.comment {
            blanks(&mut text, self.comment_blanks);
            text.push_str(comment.text);
        }
        text.push('\n');
        text
    }
}

/// How wide a word is with the blanks before it.
pub fn width(word: &Word) -> usize {
    word.blanks + word.text.chars().count()
}

/// The lines of a document.
pub fn print<'a>(doc: &Doc<'a>) -> Vec<Line<'a>> {
    let mut printer = Printer {
        lines: Vec::new(),
        line: Line::default(),
        column: 0,
        next: None,
        opened: true,
        item: 0,
        todo: Vec::new(),
    };
    printer.todo.push(Todo::Doc(doc, Mode { flat: false, entry: 0, further: INDENT, anchor: 0 }));
    while let Some(todo) = printer.todo.pop() {
        printer.step(todo);
    }
    printer.end_line();
    printer.lines
}

/// How a document is printed.
#[derive(Clone, Copy)]
struct Mode {
    flat: bool,
    entry: usize,
    further: usize,
    anchor: usize,
}

impl Mode {
    fn indent(self, indent: Indent) -> usize {
        match indent {
            Indent::Entry => self.entry,
            Indent::Further => self.further,
            Indent::Anchor => self.anchor,
        }
    }
}

/// What is still to be done.
#[derive(Clone, Copy)]
enum Todo<'d, 'a> {
    Doc(&'d Doc<'a>, Mode),
    Word(Word<'a>),
    /// The line ends before the bracket that closes.
    Close(usize),
    /// A clause that began on a line ends.
    EndClause(usize),
}

struct Printer<'d, 'a> {
    lines: Vec<Line<'a>>,
    line: Line<'a>,
    column: usize,
    /// The line that begins with the next word: how far in, and whether after a blank line.
    next: Option<(usize, bool)>,
    /// Nothing has been printed since a bracket was opened, or the file: no blank line comes here.
    opened: bool,
    item: usize,
    todo: Vec<Todo<'d, 'a>>,
}

impl<'d, 'a> Printer<'d, 'a> {
    fn step(&mut self, todo: Todo<'d, 'a>) {
        let (doc, mode) = match todo {
            Todo::Doc(doc, mode) => (doc, mode),
            Todo::Word(word) => return self.word(word),
            Todo::Close(indent) => return self.next = Some((indent, false)),
            Todo::EndClause(line) => {
                if line == self.lines.len()
                    && let Some((_, whole)) = &mut self.line.clause
                {
                    *whole = true;
                }
                return;
            }
        };
        match doc {
            Doc::Word(word) => self.word(*word),
            Doc::Comment(comment) => self.comment(*comment, mode),
            Doc::Hard(indent, blank) => self.end(mode.indent(*indent), *blank),
            Doc::Fill(indent) => {
                if !mode.flat && !self.next_fits() {
                    self.end(mode.indent(*indent), false);
                }
            }
            Doc::Separator(sign) if mode.flat => self.word(Word { text: sign, blanks: 0, padded: false, column: None }),
            Doc::Separator(_) => self.end(mode.entry, false),
            Doc::LastComma => {
                if !mode.flat {
                    self.word(Word { text: ",", blanks: 0, padded: false, column: None });
                }
            }
            Doc::Else { author, all } => {
                let after_block = self.next.is_none() && self.line.words.len() == 1;
                if !mode.flat && !after_block && (*author || *all || !self.next_fits()) {
                    self.end(mode.anchor, false);
                }
            }
            Doc::Concat(docs) => self.push(docs, mode),
            Doc::Group { docs, hard } => {
                let flat = mode.flat || (!hard && self.fits(doc));
                self.push(docs, Mode { flat, ..mode });
            }
            Doc::Anchor(docs) => {
                let at = self.indent();
                self.push(docs, Mode { anchor: at, further: at + INDENT, ..mode });
            }
            Doc::Clause { clause, docs } => {
                self.item += usize::from(mode.entry == 0 && mode.anchor == 0);
                if self.begins_line() {
                    self.begin_line();
                    self.line.clause = Some((*clause, false));
                    self.todo.push(Todo::EndClause(self.lines.len()));
                }
                let at = self.indent();
                // A table is read by its columns: only the author breaks a row.
                let flat = mode.flat || clause.row;
                self.push(docs, Mode { flat, anchor: at, further: at + INDENT, ..mode });
            }
            Doc::Bracket { open, docs, close, hard, block } => {
                let flat = !hard && (mode.flat || docs.is_empty() || self.fits(doc));
                let at = if *block { mode.anchor } else { self.indent() };
                self.word(*open);
                self.todo.push(Todo::Word(*close));
                if flat {
                    return self.push(docs, Mode { flat, ..mode });
                }
                let entry = at + INDENT;
                self.todo.push(Todo::Close(at));
                self.push(docs, Mode { flat, entry, further: entry + INDENT, anchor: entry });
                self.opened = true;
                self.end(entry, false);
            }
        }
    }

    fn push(&mut self, docs: &'d [Doc<'a>], mode: Mode) {
        self.todo.extend(docs.iter().rev().map(|doc| Todo::Doc(doc, mode)));
    }

    fn begins_line(&self) -> bool {
        self.next.is_some() || (self.line.words.is_empty() && self.line.comment.is_none())
    }

    /// How far in the line begins on which the next word stands.
    fn indent(&self) -> usize {
        self.next.map_or(self.line.indent, |(indent, _)| indent)
    }

    /// Ends the line, before what comes next.
    fn end(&mut self, indent: usize, blank: bool) {
        let blank = blank || self.next.is_some_and(|(_, blank)| blank);
        self.next = Some((indent, blank && !self.opened));
    }

    fn begin_line(&mut self) {
        if let Some((indent, blank)) = self.next.take() {
            self.end_line();
            self.line = Line { blank, indent, ..Line::default() };
            self.column = indent;
        }
        self.line.item = self.item;
        self.opened = false;
    }

    fn end_line(&mut self) {
        if !self.line.words.is_empty() || self.line.comment.is_some() {
            self.lines.push(std::mem::take(&mut self.line));
        }
    }

    fn word(&mut self, mut word: Word<'a>) {
        if word.text.is_empty() {
            return;
        }
        self.begin_line();
        if self.line.words.is_empty() {
            word.blanks = 0;
        }
        self.column += width(&word);
        self.line.words.push(word);
    }

    /// A comment beside words stands on their line, also when that has been ended.
    fn comment(&mut self, comment: Comment<'a>, mode: Mode) {
        if comment.alone {
            self.begin_line();
        }
        self.line.comment = Some(comment);
        self.end(self.next.map_or(mode.further, |(indent, _)| indent), false);
    }

    /// Whether a document fits on the line as a whole, with what cannot be parted from it.
    fn fits(&self, doc: &Doc<'a>) -> bool {
        let mut room = Room::new(self);
        room.whole(doc).unwrap_or_else(|| room.rest(self.todo.iter().rev()))
    }

    /// Whether what comes next fits on the line as a whole.
    fn next_fits(&self) -> bool {
        let mut room = Room::new(self);
        let mut todo = self.todo.iter().rev();
        match todo.next() {
            Some(Todo::Doc(doc, _)) => room.whole(doc).unwrap_or_else(|| room.rest(todo)),
            _ => true,
        }
    }
}

/// How much room there is on a line. The answer is `None` as long as there is some.
struct Room {
    left: usize,
    line_begins: bool,
}

impl Room {
    fn new(printer: &Printer) -> Self {
        let column = printer.next.map_or(printer.column, |(indent, _)| indent);
        Room { left: WIDTH.saturating_sub(column), line_begins: printer.begins_line() }
    }

    fn word(&mut self, word: &Word) -> Option<bool> {
        let blanks = if std::mem::take(&mut self.line_begins) { 0 } else { word.blanks };
        // A word that is wider than the line need not be counted to its end.
        let length = word.text.chars().take(WIDTH + 1).count() + blanks;
        match self.left.checked_sub(length) {
            Some(left) => {
                self.left = left;
                None
            }
            None => Some(false),
        }
    }

    /// All of a document on the line, up to where it must end.
    fn whole(&mut self, doc: &Doc) -> Option<bool> {
        match doc {
            Doc::Word(word) => self.word(word),
            Doc::Hard(..) => Some(true),
            Doc::Else { author: true, .. } => Some(true),
            Doc::Separator(sign) => self.word(&Word { text: sign, blanks: 0, padded: false, column: None }),
            Doc::Comment(_) | Doc::Fill(_) | Doc::LastComma | Doc::Else { .. } => None,
            Doc::Concat(docs) | Doc::Group { docs, .. } | Doc::Anchor(docs) | Doc::Clause { docs, .. } => {
                docs.iter().find_map(|doc| self.whole(doc))
            }
            Doc::Bracket { open, hard: true, .. } => self.word(open).or(Some(true)),
            Doc::Bracket { open, docs, close, .. } => {
                self.word(open).or_else(|| docs.iter().find_map(|doc| self.whole(doc))).or_else(|| self.word(close))
            }
        }
    }

    /// What follows, up to where the line may end.
    fn rest<'x, 'd: 'x, 'a: 'd>(&mut self, todo: impl Iterator<Item = &'x Todo<'d, 'a>>) -> bool {
        todo.into_iter()
            .find_map(|todo| match todo {
                Todo::Doc(doc, mode) if mode.flat => self.whole(doc),
                Todo::Doc(doc, _) => self.part(doc),
                Todo::Word(word) => self.word(word),
                Todo::Close(_) => Some(true),
                Todo::EndClause(_) => None,
            })
            .unwrap_or(true)
    }

    fn part(&mut self, doc: &Doc) -> Option<bool> {
        match doc {
            Doc::Fill(_) | Doc::Separator(_) | Doc::Else { .. } => Some(true),
            Doc::LastComma => self.word(&Word { text: ",", blanks: 0, padded: false, column: None }),
            Doc::Concat(docs) | Doc::Group { docs, .. } | Doc::Anchor(docs) | Doc::Clause { docs, .. } => {
                docs.iter().find_map(|doc| self.part(doc))
            }
            Doc::Bracket { open, docs, .. } if !docs.is_empty() => self.word(open).or(Some(true)),
            _ => self.whole(doc),
        }
    }
}
