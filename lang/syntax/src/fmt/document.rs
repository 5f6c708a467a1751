//! What is to be laid out: words, the places where lines may end, and what belongs together.

/// A word or sign, and how it stands beside the one before it.
#[derive(Clone, Copy, Debug)]
pub struct Word<'a> {
    pub text: &'a str,
    /// Blanks before it, unless it begins a line.
    pub blanks: usize,
    /// The author has put more blanks there than one: to align something.
    pub padded: bool,
    /// The column of a switching table that it begins.
    pub column: Option<Column>,
}

/// What begins a column of a switching table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    Arrow,
    On,
    Do,
}

/// A comment.
#[derive(Clone, Copy, Debug)]
pub struct Comment<'a> {
    pub text: &'a str,
    /// Where it stands in the source's line.
    pub column: usize,
    /// Nothing else stands on its line.
    pub alone: bool,
}

/// How far in a new line begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Indent {
    /// As the entries of the innermost bracket, or the statements of the block.
    Entry,
    /// Deeper: what goes on from the line before.
    Further,
    /// As the line on which the `if` or the statement began.
    Anchor,
}

/// A document.
#[derive(Debug)]
pub enum Doc<'a> {
    Word(Word<'a>),
    Comment(Comment<'a>),
    /// A line end where what follows does not fit.
    Fill(Indent),
    /// A line end, and whether a blank line follows.
    Hard(Indent, bool),
    /// Between two on one line; a line end when their group is broken.
    Separator(&'static str),
    /// After the last entry, when each line ends in one.
    LastComma,
    /// Before `else`: whether the author has ended the line, and whether all of its kind end theirs.
    Else {
        author: bool,
        all: bool,
    },
    /// What is moved as one.
    Concat(Vec<Doc<'a>>),
    /// On one line if it fits.
    Group {
        docs: Vec<Doc<'a>>,
        hard: bool,
    },
    /// Blocks in it stand as deep as the line on which it begins.
    Anchor(Vec<Doc<'a>>),
    /// A statement, declaration or entry.
    Clause {
        clause: Clause<'a>,
        docs: Vec<Doc<'a>>,
    },
    /// A bracket or block; what is in it stands on lines of its own when it is broken.
    Bracket {
        open: Word<'a>,
        docs: Vec<Doc<'a>>,
        close: Word<'a>,
        hard: bool,
        block: bool,
    },
}

/// What a clause is to the lines above and below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clause<'a> {
    /// Those with the same key may be aligned.
    pub key: &'a str,
    /// The block in which it stands.
    pub block: usize,
    /// It is a row of a switching table.
    pub row: bool,
}

impl<'a> Doc<'a> {
    /// A group, which is broken when a line ends in it anyway.
    pub fn group(docs: Vec<Doc<'a>>) -> Self {
        let hard = docs.iter().any(Doc::is_hard);
        Doc::Group { docs, hard }
    }

    /// Whether a line ends in it, whatever fits.
    pub fn is_hard(&self) -> bool {
        match self {
            Doc::Hard(..) | Doc::Comment(_) | Doc::Else { author: true, .. } => true,
            Doc::Group { hard, .. } | Doc::Bracket { hard, .. } => *hard,
            Doc::Concat(docs) | Doc::Anchor(docs) | Doc::Clause { docs, .. } => docs.iter().any(Doc::is_hard),
            _ => false,
        }
    }
}
