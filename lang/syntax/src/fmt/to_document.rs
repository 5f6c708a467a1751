//! From what the grammar has read to a document. The words are the source's own: nothing is spelt anew.

use super::document::{Clause, Column, Comment, Doc, Indent, Word};
use crate::{ConcreteTree, Node, Rule};

/// What editors of other systems put before a text in UTF-8.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// The document of a file.
pub fn file<'a>(source: &'a str, tree: &'a ConcreteTree) -> Doc<'a> {
    let starts = std::iter::once(0).chain(source.match_indices('\n').map(|(at, _)| at + 1)).collect();
    let comments = tree.comments().map(|c| (c.start as usize, c.end as usize)).collect();
    let at = if source.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len_utf8() } else { 0 };
    let mut builder =
        Builder { source, starts, comments, seen: 0, at, led: None, tight: false, after: None, blocks: 0 };
    let items = tree.root(source).inner().collect();
    Doc::Concat(builder.entries(items, source.len(), ";", true))
}

/// What may come after the last word.
#[derive(Clone, Copy, PartialEq)]
enum After {
    /// A line end, where the author has one.
    Author(Indent),
    /// A line end, where the author has one or what follows does not fit.
    Fill(Indent),
}

/// On which sides a word stands close.
#[derive(Clone, Copy, Default)]
struct Tight {
    left: bool,
    right: bool,
}

const LEFT: Tight = Tight { left: true, right: false };
const RIGHT: Tight = Tight { left: false, right: true };
const BOTH: Tight = Tight { left: true, right: true };
const NEITHER: Tight = Tight { left: false, right: false };

struct Builder<'a> {
    source: &'a str,
    /// Where lines begin.
    starts: Vec<usize>,
    comments: Vec<(usize, usize)>,
    /// How many comments have had their place.
    seen: usize,
    /// Where the last word or comment ended.
    at: usize,
    /// What stands before the word that begins here has been seen to.
    led: Option<usize>,
    /// The last word stands close to what follows.
    tight: bool,
    after: Option<After>,
    /// How many blocks there are so far: each has its number.
    blocks: usize,
}

impl<'a> Builder<'a> {
    fn line(&self, at: usize) -> usize {
        self.starts.partition_point(|&start| start <= at)
    }

    fn slice(&self, start: usize, end: usize) -> &'a str {
        self.source.get(start..end).unwrap_or("")
    }

    /// The next comment, if it begins before a place.
    fn comment(&mut self, before: usize) -> Option<Comment<'a>> {
        let &(start, end) = self.comments.get(self.seen).filter(|&&(start, _)| start < before)?;
        self.seen += 1;
        let line_start = self.starts.get(self.line(start) - 1).copied().unwrap_or(0);
        let column = self.slice(line_start, start).chars().count();
        Some(Comment {
            text: self.slice(start, end).trim_end(),
            column,
            alone: !self.has_begun() || self.breaks(start),
        })
    }

    /// Whether a blank line stands between the last word or comment and a place.
    fn blank(&self, start: usize) -> bool {
        self.has_begun() && self.line(start) > self.line(self.at - 1) + 1
    }

    /// Whether a word or a comment has come: a byte-order mark is neither.
    fn has_begun(&self) -> bool {
        self.at > if self.source.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len_utf8() } else { 0 }
    }

    fn breaks(&self, start: usize) -> bool {
        self.has_begun() && self.line(start) > self.line(self.at - 1)
    }

    /// Sees to what stands before a word: comments and line ends.
    fn lead(&mut self, docs: &mut Vec<Doc<'a>>, start: usize) {
        if self.led.replace(start) == Some(start) {
            return;
        }
        let after = self.after.take();
        let indent = match after {
            Some(After::Author(indent) | After::Fill(indent)) => indent,
            None => Indent::Further,
        };
        if self.comments_before(docs, start, indent) || (after.is_some() && self.breaks(start)) {
            docs.push(Doc::Hard(indent, self.blank(start)));
        } else if let Some(After::Fill(indent)) = after {
            docs.push(Doc::Fill(indent));
        }
    }

    fn comments_before(&mut self, docs: &mut Vec<Doc<'a>>, start: usize, indent: Indent) -> bool {
        let mut any = false;
        while let Some(&(begin, end)) = self.comments.get(self.seen)
            && let Some(comment) = self.comment(start)
        {
            if comment.alone {
                docs.push(Doc::Hard(indent, self.blank(begin)));
            }
            docs.push(Doc::Comment(comment));
            self.at = end;
            any = true;
        }
        any
    }

    fn word(&mut self, docs: &mut Vec<Doc<'a>>, start: usize, end: usize, tight: Tight, column: Option<Column>) {
        self.lead(docs, start);
        docs.push(Doc::Word(self.bare(start, end, tight, column)));
    }

    fn bare(&mut self, start: usize, end: usize, tight: Tight, column: Option<Column>) -> Word<'a> {
        let gap = self.slice(self.at, start);
        let padded = gap.len() > 1 && gap.bytes().all(|b| b == b' ');
        let blanks = usize::from(!(self.tight || tight.left));
        self.at = end;
        self.tight = tight.right;
        self.led = None;
        self.after = None;
        Word { text: self.slice(start, end), blanks, padded: padded && blanks > 0, column }
    }

    /// A sign that the grammar has no rule for.
    fn sign(&mut self, docs: &mut Vec<Doc<'a>>, sign: Node<'a>, of: Rule) {
        let tight = match sign.text() {
            "(" | "[" if matches!(of, Rule::index | Rule::ask | Rule::action | Rule::behavior_ty | Rule::map_ty) => {
                BOTH
            }
            "(" | "[" => RIGHT,
            "." | "^" | "°" | "'" => BOTH,
            ")" | "]" | "," | ":" | ";" => LEFT,
            _ => NEITHER,
        };
        self.word(docs, sign.start(), sign.end(), tight, None);
        self.after = match sign.text() {
            "," => Some(After::Fill(Indent::Further)),
            "=" => Some(After::Author(Indent::Further)),
            _ => None,
        };
    }

    fn node(&mut self, node: Node<'a>) -> Doc<'a> {
        match node.rule() {
            Rule::expr => {
                let items: Vec<_> = node.inner().collect();
                self.chain(&items)
            }
            Rule::params | Rule::clause_params | Rule::args | Rule::others | Rule::list => self.list(node),
            Rule::if_expr => self.choice(node),
            Rule::match_expr => Doc::Anchor(vec![self.sequence(node)]),
            Rule::text => self.leaf(node),
            _ if node.is_leaf() => self.leaf(node),
            _ => self.sequence(node),
        }
    }

    fn leaf(&mut self, node: Node<'a>) -> Doc<'a> {
        let tight = match node.rule() {
            Rule::range_op | Rule::dim_op => BOTH,
            Rule::neg | Rule::pos => RIGHT,
            Rule::maybe | Rule::colon | Rule::north_south | Rule::east_west => LEFT,
            _ => NEITHER,
        };
        let mut docs = Vec::new();
        self.word(&mut docs, node.start(), node.end(), tight, None);
        self.after = match node.rule() {
            Rule::arrow | Rule::kw_on | Rule::kw_do => Some(After::Author(Indent::Further)),
            _ => None,
        };
        Doc::Concat(docs)
    }

    /// What has no layout of its own: its parts, one after the other.
    fn sequence(&mut self, node: Node<'a>) -> Doc<'a> {
        let (rule, end) = (node.rule(), node.end());
        let mut docs = Vec::new();
        let mut parts = node.children().filter(|part| part.rule() != Rule::comment);
        while let Some(part) = parts.next() {
            match (rule, part.rule()) {
                (_, Rule::sign) if part.text() == "{" => {
                    let inside = parts.filter(|part| part.rule() != Rule::sign).collect();
                    self.block(&mut docs, part.start(), inside, end, rule);
                    return Doc::Concat(docs);
                }
                (_, Rule::sign) => self.sign(&mut docs, part, rule),
                (Rule::switching, Rule::arrow) => self.begin(&mut docs, part, Column::Arrow),
                (Rule::switching, Rule::kw_on) => self.begin(&mut docs, part, Column::On),
                (Rule::do_block, Rule::kw_do) => self.begin(&mut docs, part, Column::Do),
                _ => {
                    self.lead(&mut docs, part.start());
                    docs.push(self.node(part));
                }
            }
        }
        Doc::Concat(docs)
    }

    /// A word that begins a column of a switching table.
    fn begin(&mut self, docs: &mut Vec<Doc<'a>>, part: Node<'a>, column: Column) {
        self.word(docs, part.start(), part.end(), NEITHER, Some(column));
        self.after = Some(After::Author(Indent::Further));
    }

    /// `( … )` and `[ … ]` with entries.
    fn list(&mut self, node: Node<'a>) -> Doc<'a> {
        let (rule, start, end) = (node.rule(), node.start(), node.end());
        let mut before = Vec::new();
        self.lead(&mut before, start);
        let tight = if matches!(rule, Rule::list | Rule::others) { RIGHT } else { BOTH };
        let open = self.bare(start, start + 1, tight, None);
        let mut docs = Vec::new();
        let (mut any, mut comma) = (false, None);
        let brackets = |part: &Node| part.rule() == Rule::sign && (part.start() == start || part.end() == end);
        for part in node.children().filter(|part| part.rule() != Rule::comment && !brackets(part)) {
            if part.rule() == Rule::sign {
                comma = Some(part);
                continue;
            }
            // One behind the last entry is not the author's: whether it stands there depends on the layout.
            if let Some(comma) = comma.take() {
                self.sign(&mut docs, comma, rule);
            }
            self.after = Some(if any { After::Fill(Indent::Entry) } else { After::Author(Indent::Entry) });
            self.lead(&mut docs, part.start());
            docs.push(self.node(part));
            any = true;
        }
        if any {
            docs.push(Doc::LastComma);
        }
        self.comments_before(&mut docs, end - 1, Indent::Entry);
        self.led = Some(end - 1);
        let close = self.bare(end - 1, end, LEFT, None);
        let hard = self.line(start) != self.line(end - 1);
        before.push(Doc::Bracket { open, docs, close, hard, block: false });
        Doc::Concat(before)
    }

    /// `{ … }`.
    fn block(&mut self, docs: &mut Vec<Doc<'a>>, start: usize, parts: Vec<Node<'a>>, end: usize, rule: Rule) {
        let separator = match rule {
            Rule::enum_item | Rule::record_item | Rule::input_item | Rule::payload_item | Rule::limits => ",",
            _ => ";",
        };
        self.lead(docs, start);
        let open = self.bare(start, start + 1, NEITHER, None);
        let hard = self.line(start) != self.line(end - 1);
        let inside = self.entries(parts, end - 1, separator, hard);
        let tight = if inside.is_empty() { LEFT } else { NEITHER };
        self.tight = false;
        let close = self.bare(end - 1, end, tight, None);
        let hard = hard && !inside.is_empty();
        docs.push(Doc::Bracket { open, docs: inside, close, hard, block: true });
    }

    /// Clauses or entries up to a place. When the author has written them on several lines, each line is a group.
    fn entries(&mut self, parts: Vec<Node<'a>>, end: usize, separator: &'static str, hard: bool) -> Vec<Doc<'a>> {
        self.blocks += 1;
        let block = self.blocks;
        let mut lines = Vec::new();
        let mut line = Vec::new();
        for part in parts {
            let start = part.start();
            let is_else = part.rule() == Rule::match_arm && self.slice(start, start + 4) == "else";
            if self.next_entry(&mut lines, &mut line, start) {
                lines.push(Doc::Hard(Indent::Entry, self.blank(start)));
            } else if !line.is_empty() {
                line.push(Doc::Separator(if is_else { "" } else { separator }));
            }
            (self.at, self.led) = (start, Some(start));
            self.tight = false;
            self.after = None;
            let clause = Clause { key: self.key(part), block, row: part.rule() == Rule::switching };
            let docs = vec![self.node(part)];
            line.push(Doc::Clause { clause, docs });
        }
        self.next_entry(&mut lines, &mut line, end);
        self.led = Some(end);
        if !hard {
            return line;
        }
        if !line.is_empty() {
            lines.push(Doc::group(line));
        }
        lines
    }

    /// Sees to what stands before an entry, or before the end: whether it begins a line.
    fn next_entry(&mut self, lines: &mut Vec<Doc<'a>>, line: &mut Vec<Doc<'a>>, start: usize) -> bool {
        let mut begins = false;
        while let Some(&(begin, end)) = self.comments.get(self.seen)
            && let Some(comment) = self.comment(start)
        {
            if !line.is_empty() {
                lines.push(Doc::group(std::mem::take(line)));
            }
            if comment.alone {
                lines.push(Doc::Hard(Indent::Entry, self.blank(begin)));
            }
            lines.push(Doc::Comment(comment));
            self.at = end;
            begins = true;
        }
        begins |= self.breaks(start);
        if begins && !line.is_empty() {
            lines.push(Doc::group(std::mem::take(line)));
        }
        begins
    }

    /// What the clauses that may be aligned with this one have in common: its first word, or what it is.
    fn key(&self, part: Node<'a>) -> &'a str {
        match part.rule() {
            Rule::assign => "=",
            Rule::field => ":",
            Rule::match_arm => "{",
            Rule::require => "fresh",
            Rule::switching => "->",
            _ => {
                let start = part.start();
                let rest = self.slice(start, part.end());
                let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
                &rest[..length]
            }
        }
    }

    /// `if … { } else if … { } else { }`, which is one thing and not nested.
    fn choice(&mut self, node: Node<'a>) -> Doc<'a> {
        let mut docs = Vec::new();
        let mut part = Vec::new();
        let mut parts: Vec<_> = node.inner().collect();
        parts.reverse();
        while let Some(next) = parts.pop() {
            let start = next.start();
            match next.rule() {
                Rule::if_expr => parts.extend(next.inner().collect::<Vec<_>>().into_iter().rev()),
                Rule::kw_else => {
                    docs.push(Doc::Concat(std::mem::take(&mut part)));
                    let author = self.breaks(start);
                    if self.comments_before(&mut docs, start, Indent::Anchor) {
                        docs.push(Doc::Hard(Indent::Anchor, false));
                    } else {
                        docs.push(Doc::Else { author, all: false });
                    }
                    self.led = Some(start);
                    part.push(self.node(next));
                }
                _ => {
                    self.lead(&mut part, start);
                    part.push(self.node(next));
                }
            }
        }
        docs.push(Doc::Concat(part));
        let hard = docs.iter().any(Doc::is_hard);
        for doc in &mut docs {
            if let Doc::Else { all, .. } = doc {
                *all = !hard;
            }
        }
        Doc::Anchor(vec![Doc::Group { docs, hard }])
    }

    /// Operands and operators: what binds least is broken first.
    fn chain(&mut self, items: &[Node<'a>]) -> Doc<'a> {
        let Some(least) = items.iter().filter_map(|item| strength(item.rule())).min() else {
            let mut docs = Vec::new();
            for item in items {
                self.lead(&mut docs, item.start());
                docs.push(self.node(*item));
            }
            return Doc::Concat(docs);
        };
        let mut docs = Vec::new();
        for part in items.chunk_by(|a, b| strength(a.rule()) != Some(least) && strength(b.rule()) != Some(least)) {
            let Some(first) = part.first() else { continue };
            self.lead(&mut docs, first.start());
            if strength(first.rule()) == Some(least) {
                docs.push(self.node(*first));
                self.after = Some(After::Fill(Indent::Further));
            } else {
                docs.push(self.chain(part));
            }
        }
        Doc::group(docs)
    }
}

/// How closely an operator binds.
fn strength(rule: Rule) -> Option<u8> {
    Some(match rule {
        Rule::op_else => 0,
        Rule::op_or => 1,
        Rule::op_and => 2,
        Rule::op_eq | Rule::op_ne | Rule::op_le | Rule::op_ge | Rule::op_lt | Rule::op_gt => 3,
        Rule::op_add | Rule::op_sub => 4,
        Rule::op_toward => 5,
        Rule::op_mul | Rule::op_div => 6,
        Rule::op_pow => 7,
        _ => return None,
    })
}
