//! The concrete tree: each word, sign and comment of a source in its place, and what could not be read beside what could.
//!
//! It is made once of a text. The tree of what a script says ([`super::tree`]), the formatter and the documentation read it.

use super::Rule;
use super::scan::Scanned;
use super::words::is_mark;
use crate::source::{FileId, Span};
use pest::iterators::Pair;

/// Every byte of a source that is no blank stands in exactly one leaf.
#[derive(Clone, Debug)]
pub struct ConcreteTree {
    file: FileId,
    /// Each node before what is in it.
    nodes: Vec<Data>,
}

#[derive(Clone, Copy, Debug)]
struct Data {
    rule: Rule,
    start: u32,
    end: u32,
    /// Where the next node stands that is not in this one.
    next: u32,
}

/// A node of a tree, with the source that it is of. Beside the rules of the grammar there are [`Rule::sign`] for a sign that no rule
/// names, [`Rule::comment`], and [`Rule::unread`] for what no rule could read.
#[derive(Clone, Copy)]
pub(crate) struct Node<'t> {
    tree: &'t ConcreteTree,
    source: &'t str,
    at: u32,
}

impl ConcreteTree {
    /// The whole source.
    pub(crate) fn root<'t>(&'t self, source: &'t str) -> Node<'t> {
        Node { tree: self, source, at: 0 }
    }

    /// The comments, in order, slashes included.
    pub fn comments(&self) -> impl Iterator<Item = Span> {
        self.of_rules(&[Rule::comment])
    }

    /// Where names and labels stand, in order: what a script declares, and what it means by them.
    pub fn names(&self) -> impl Iterator<Item = Span> {
        self.of_rules(&[Rule::name, Rule::label])
    }

    fn of_rules(&self, rules: &'static [Rule]) -> impl Iterator<Item = Span> {
        let nodes = self.nodes.iter().filter(|data| rules.contains(&data.rule));
        nodes.map(|data| Span { file: self.file, start: data.start, end: data.end })
    }

    /// Where the words, signs and comments stand, in order, and what could not be read.
    pub fn leaves(&self) -> impl Iterator<Item = Span> {
        let leaves = self.nodes.iter().zip(1..).filter(|(data, next)| data.next == *next && data.start < data.end);
        leaves.map(|(data, _)| Span { file: self.file, start: data.start, end: data.end })
    }
}

impl<'t> Node<'t> {
    fn data(self) -> Data {
        self.tree.nodes[self.at as usize]
    }

    /// What it is.
    pub fn rule(self) -> Rule {
        self.data().rule
    }

    /// The first byte.
    pub fn start(self) -> usize {
        self.data().start as usize
    }

    /// One past the last byte, blanks behind it left out.
    pub fn end(self) -> usize {
        self.data().end as usize
    }

    /// Where it stands.
    pub fn span(self) -> Span {
        let Data { start, end, .. } = self.data();
        Span { file: self.tree.file, start, end }
    }

    /// As it is written.
    pub fn text(self) -> &'t str {
        self.source.get(self.start()..self.end()).unwrap_or("")
    }

    /// All that stands directly in it, signs and comments too.
    pub fn children(self) -> impl Iterator<Item = Node<'t>> + Clone {
        let end = self.data().next;
        let first = (self.at + 1 < end).then_some(Node { at: self.at + 1, ..self });
        std::iter::successors(first, move |node| {
            let next = node.data().next;
            (next < end).then_some(Node { at: next, ..*node })
        })
    }

    /// What stands directly in it and has a rule of its own.
    pub fn inner(self) -> impl Iterator<Item = Node<'t>> + Clone {
        self.children().filter(|node| !matches!(node.rule(), Rule::sign | Rule::comment | Rule::unread))
    }

    /// The same without the words that mean nothing by themselves.
    pub fn parts(self) -> impl Iterator<Item = Node<'t>> + Clone {
        self.inner().filter(|node| !is_mark(node.rule()))
    }

    /// Whether nothing stands in it.
    pub fn is_leaf(self) -> bool {
        self.data().next == self.at + 1
    }
}

/// Makes the tree of a source, part after part.
pub(super) struct Planter<'s> {
    /// The source, and what the grammar was given of it: blanks for comments, and for what it cannot read.
    source: &'s str,
    prepared: &'s str,
    comments: &'s [Span],
    /// How many comments have their place.
    placed: usize,
    /// All before it is in the tree.
    at: usize,
    tree: ConcreteTree,
}

impl<'s> Planter<'s> {
    pub fn new(file: FileId, source: &'s str, scanned: &'s Scanned, root: Rule) -> Self {
        let root = Data { rule: root, start: 0, end: source.trim_end().len() as u32, next: 0 };
        let tree = ConcreteTree { file, nodes: vec![root] };
        Planter { source, prepared: &scanned.text, comments: &scanned.comments, placed: 0, at: 0, tree }
    }

    /// What the grammar has read of a part that begins at a byte.
    pub fn read(&mut self, base: usize, pairs: impl Iterator<Item = Pair<'s, Rule>>) {
        pairs.filter(|pair| pair.as_rule() != Rule::EOI).for_each(|pair| self.pair(base, pair));
    }

    /// A part that could not be read.
    pub fn unread(&mut self, end: usize) {
        self.fill(end, true);
    }

    pub fn finish(mut self) -> ConcreteTree {
        self.fill(self.source.len(), false);
        self.tree.nodes[0].next = self.tree.nodes.len() as u32;
        self.tree
    }

    fn pair(&mut self, base: usize, pair: Pair<'s, Rule>) {
        let (rule, span) = (pair.as_rule(), pair.as_span());
        let start = base + span.start();
        // What the grammar looked ahead over is no part of it. The blanks of a text are.
        let end = if rule == Rule::text_part { base + span.end() } else { start + span.as_str().trim_end().len() };
        self.fill(start, false);
        let index = self.tree.nodes.len();
        self.tree.nodes.push(Data { rule, start: start as u32, end: end as u32, next: 0 });
        let mut inner = pair.into_inner().peekable();
        let is_bare = inner.peek().is_none();
        inner.for_each(|child| self.pair(base, child));
        match rule {
            Rule::bad | Rule::bad_item | Rule::bad_head => self.fill(end, true),
            // A word is a leaf; brackets without anything between them are two.
            _ if is_bare && !matches!(self.source.as_bytes().get(start), Some(b'(' | b'[' | b'{')) => self.at = end,
            _ => self.fill(end, false),
        }
        self.tree.nodes[index].next = self.tree.nodes.len() as u32;
    }

    /// Makes leaves of what stands before a byte: comments, and signs, or what could not be read.
    fn fill(&mut self, end: usize, unread: bool) {
        while self.at < end {
            let rest = self.source.get(self.at..end).unwrap_or("");
            let blanks = rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
            self.at += blanks;
            let Some(sign) = rest[blanks..].chars().next() else { break };
            let comment = self.comments.get(self.placed).filter(|comment| comment.start as usize <= self.at);
            if let Some(comment) = comment {
                self.placed += 1;
                self.leaf(Rule::comment, comment.end as usize);
            } else if unread || self.is_taken_out(self.at) {
                let next = self.comments.get(self.placed).map_or(end, |comment| end.min(comment.start as usize));
                let taken_out = (self.at..next).take_while(|&at| unread || self.is_taken_out(at)).count();
                let stretch = self.source.get(self.at..self.at + taken_out).unwrap_or("");
                self.leaf(Rule::unread, self.at + stretch.trim_end().len().max(sign.len_utf8()));
            } else {
                self.leaf(Rule::sign, self.at + sign.len_utf8());
            }
        }
        self.at = self.at.max(end);
    }

    /// Whether the grammar was given a blank for a byte that is none.
    fn is_taken_out(&self, at: usize) -> bool {
        let is_blank = |text: &str| text.as_bytes().get(at).is_none_or(u8::is_ascii_whitespace);
        is_blank(self.prepared) && !is_blank(self.source)
    }

    fn leaf(&mut self, rule: Rule, end: usize) {
        let next = self.tree.nodes.len() as u32 + 1;
        self.tree.nodes.push(Data { rule, start: self.at as u32, end: end as u32, next });
        self.at = end;
    }
}
