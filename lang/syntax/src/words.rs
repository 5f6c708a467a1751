//! The words of the language: what each may begin, whether a line goes on after it, and what it declares.
//!
//! The grammar spells each word once more, for it cannot be made of a table; a test holds it to this one.

use super::Rule;
use albacore_program::Guide;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// A word of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// As it is written.
    pub text: &'static str,
    uses: u16,
}

/// Never a name.
const RESERVED: u16 = 1;
/// Begins a declaration of a file.
const ITEM: u16 = 1 << 1;
/// Begins what may stand at the left margin inside a block too.
const NESTED: u16 = 1 << 2;
/// Begins a clause of a block.
const CLAUSE: u16 = 1 << 3;
/// Begins a clause of a test.
const TEST: u16 = 1 << 4;
/// Begins a statement, and never goes on with the line before.
const FRESH: u16 = 1 << 5;
/// A line that ends in it goes on.
const OPEN: u16 = 1 << 6;
/// Stands between two operands, or between a statement and what belongs to it.
const BETWEEN: u16 = 1 << 7;
/// A name follows that it declares in a block.
const LOCAL: u16 = 1 << 8;
/// A name follows that it declares in a file or a block.
const NAMES: u16 = 1 << 9;
/// What it declares can be called.
const CALLED: u16 = 1 << 10;
/// ... with arguments in brackets.
const ARGUMENTS: u16 = 1 << 11;

/// Every word that means something somewhere, but for those that guidance laws begin with: these are in the table of laws.
const WORDS: [Word; 82] = [
    // Declarations.
    word("use", RESERVED | ITEM | FRESH),
    word("const", RESERVED | ITEM | FRESH | NAMES),
    word("enum", RESERVED | ITEM | NAMES),
    word("record", RESERVED | ITEM | CLAUSE | NAMES | CALLED | ARGUMENTS),
    word("unit", ITEM | NAMES),
    word("input", ITEM | NAMES),
    word("fn", RESERVED | ITEM | NAMES | CALLED | ARGUMENTS),
    word("signal", RESERVED | ITEM | NESTED | CLAUSE | FRESH | LOCAL | NAMES),
    word("behavior", RESERVED | ITEM | NESTED | CLAUSE | FRESH | LOCAL | NAMES | CALLED | ARGUMENTS),
    word("strategy", RESERVED | ITEM | FRESH | NAMES | CALLED | ARGUMENTS),
    word("overlay", RESERVED | ITEM | FRESH | NAMES | CALLED),
    word("mission", RESERVED | ITEM | FRESH | NAMES),
    word("scenario", RESERVED | ITEM | FRESH | NAMES),
    word("vehicle", ITEM),
    word("payload", ITEM | NAMES),
    word("test", RESERVED | ITEM | FRESH),
    word("clause", ITEM | LOCAL | NAMES),
    // Clauses of a block.
    word("with", RESERVED | CLAUSE | TEST | FRESH),
    word("memory", RESERVED | CLAUSE | FRESH | LOCAL | NAMES),
    word("let", RESERVED | CLAUSE | FRESH | LOCAL | NAMES),
    word("var", RESERVED | CLAUSE | FRESH | LOCAL | NAMES),
    word("on", RESERVED | CLAUSE | OPEN | BETWEEN),
    word("start", RESERVED | CLAUSE | FRESH),
    word("area", CLAUSE | LOCAL | NAMES),
    word("limits", CLAUSE),
    word("requires", CLAUSE),
    word("recovery", CLAUSE),
    word("amend", CLAUSE),
    word("ask", CLAUSE),
    word("abort", RESERVED | CLAUSE),
    word("finish", RESERVED | CLAUSE),
    word("report", RESERVED | CLAUSE | FRESH),
    word("log", RESERVED | CLAUSE | FRESH),
    word("if", RESERVED | CLAUSE),
    word("match", RESERVED | CLAUSE),
    word("for", RESERVED | CLAUSE | LOCAL),
    word("while", RESERVED | CLAUSE | FRESH),
    word("loop", RESERVED | CLAUSE | FRESH),
    word("watch", RESERVED | CLAUSE),
    word("override", RESERVED | CLAUSE),
    // Clauses of a test.
    word("run", TEST),
    word("expect", TEST),
    word("snapshot", TEST),
    // Operators, and what joins the parts of a statement.
    word("and", RESERVED | OPEN | BETWEEN),
    word("or", RESERVED | OPEN | BETWEEN),
    word("toward", RESERVED | OPEN | BETWEEN),
    word("do", RESERVED | OPEN | BETWEEN),
    word("then", RESERVED | BETWEEN),
    word("until", RESERVED | BETWEEN),
    word("within", RESERVED | BETWEEN),
    word("at", RESERVED | BETWEEN),
    word("in", RESERVED | BETWEEN),
    word("not", RESERVED | OPEN),
    word("no", RESERVED | OPEN),
    word("becomes", RESERVED | OPEN),
    word("else", RESERVED | OPEN),
    word("after", RESERVED),
    word("every", RESERVED),
    word("any", RESERVED),
    word("by", RESERVED),
    word("of", RESERVED),
    // Values.
    word("done", RESERVED),
    word("true", RESERVED),
    word("false", RESERVED),
    word("none", RESERVED),
    // Words that mean something in one place only.
    word("always", 0),
    word("amends", 0),
    word("sets", 0),
    word("back", 0),
    word("first", 0),
    word("fresh", 0),
    word("least", 0),
    word("Map", 0),
    word("most", 0),
    word("new", 0),
    word("offered", 0),
    word("once", 0),
    word("runs", 0),
    word("seed", 0),
    word("seeds", 0),
    word("switches", 0),
    word("when", 0),
];

const fn word(text: &'static str, uses: u16) -> Word {
    Word { text, uses }
}

/// All of them.
fn words() -> impl Iterator<Item = Word> {
    let verbs: BTreeSet<&str> = Guide::ALL.into_iter().map(|guide| guide.law().verb).collect();
    WORDS.into_iter().chain(verbs.into_iter().map(|verb| word(verb, RESERVED | CLAUSE)))
}

/// All of them by their first letters: every word of a text is looked for.
static BY_INITIAL: LazyLock<Vec<Vec<Word>>> = LazyLock::new(|| {
    let mut initials = vec![Vec::new(); 128];
    for word in words() {
        let initial = word.text.bytes().next().and_then(|first| initials.get_mut(usize::from(first)));
        initial.into_iter().for_each(|alike: &mut Vec<Word>| alike.push(word));
    }
    initials
});

/// The word of a text, if it is one.
pub fn find(text: &str) -> Option<Word> {
    let alike = BY_INITIAL.get(usize::from(*text.as_bytes().first()?))?;
    alike.iter().find(|word| word.text == text).copied()
}

fn has(text: &str, uses: u16) -> bool {
    find(text).is_some_and(|word| word.uses & uses != 0)
}

fn all(uses: u16) -> impl Iterator<Item = &'static str> {
    words().filter(move |word| word.uses & uses != 0).map(|word| word.text)
}

/// Every word of the language.
pub fn every() -> impl Iterator<Item = &'static str> {
    words().map(|word| word.text)
}

/// Whether a word is never a name.
pub fn is_reserved(text: &str) -> bool {
    has(text, RESERVED)
}

/// Whether a word begins a declaration of a file.
pub fn begins_item(text: &str) -> bool {
    has(text, ITEM)
}

/// Whether it begins one that stands in no block: at the left margin it shows that what is open was never closed.
pub(super) fn begins_outer_item(text: &str) -> bool {
    begins_item(text) && !has(text, NESTED)
}

/// Whether it begins a clause of a block.
pub(super) fn begins_clause(text: &str) -> bool {
    has(text, CLAUSE)
}

/// Whether it begins a statement and never goes on with one.
pub(super) fn begins_afresh(text: &str) -> bool {
    has(text, FRESH)
}

/// Whether a line that ends in a word goes on in the next.
pub(super) fn goes_on_after(text: &str) -> bool {
    has(text, OPEN)
}

/// Whether it stands between two operands, or between a statement and what belongs to it.
pub(super) fn stands_between(text: &str) -> bool {
    has(text, BETWEEN)
}

/// Whether a name follows that it declares inside a declaration.
pub fn declares_inside(text: &str) -> bool {
    has(text, LOCAL)
}

/// Whether a name follows that it declares.
pub fn declares(text: &str) -> bool {
    has(text, NAMES)
}

/// Whether what it declares can be called.
pub fn declares_called(text: &str) -> bool {
    has(text, CALLED)
}

/// Whether what it declares is called as a statement or a value, with arguments in brackets.
pub(super) fn declares_with_arguments(text: &str) -> bool {
    has(text, ARGUMENTS)
}

/// The words that begin a declaration of a file.
pub(super) fn of_items() -> impl Iterator<Item = &'static str> {
    all(ITEM)
}

/// The words that begin a clause of a block.
pub(super) fn of_clauses() -> impl Iterator<Item = &'static str> {
    all(CLAUSE)
}

/// The words that begin a clause of a test.
pub(super) fn of_tests() -> impl Iterator<Item = &'static str> {
    all(TEST)
}

/// Whether a rule of the grammar is a word or a sign that means nothing by itself: a tree has no place for it.
pub(super) fn is_mark(rule: Rule) -> bool {
    matches!(rule, Rule::arrow | Rule::colon) || word_of(rule).is_some_and(|(_, mark)| mark)
}

/// The word that a rule of the grammar stands for: `kw_goto` for `goto`, `w_fresh` for `fresh`, `v_true` for `true`.
pub(super) fn of_rule(rule: Rule) -> Option<&'static str> {
    word_of(rule).map(|(text, _)| text)
}

/// For each rule that is a word, which, and whether it means nothing by itself. The names of such rules begin with `kw_` where the word is
/// reserved, with `w_` where it is not, and with `v_` where it is a value.
static RULES: LazyLock<Vec<Option<(&'static str, bool)>>> = LazyLock::new(|| {
    let mut rules = Vec::new();
    for &rule in Rule::all_rules() {
        let name = format!("{rule:?}");
        let found = name.split_once('_').filter(|(kind, _)| matches!(*kind, "kw" | "w" | "v"));
        let word = found.and_then(|(kind, text)| Some((find(text)?.text, kind != "v")));
        rules.resize(rules.len().max(rule as usize + 1), None);
        rules[rule as usize] = word;
    }
    rules
});

fn word_of(rule: Rule) -> Option<(&'static str, bool)> {
    RULES.get(rule as usize).copied().flatten()
}

#[cfg(test)]
mod tests {
    use super::super::Grammar;
    use super::*;
    use pest::Parser;

    fn reads(rule: Rule, text: &str) -> bool {
        Grammar::parse(rule, text).is_ok_and(|mut pairs| pairs.next().is_some_and(|pair| pair.as_str() == text))
    }

    #[test]
    fn the_grammar_reserves_the_same_words() {
        for word in words() {
            assert_eq!(reads(Rule::reserved, word.text), word.uses & RESERVED != 0, "{}", word.text);
            assert_eq!(reads(Rule::name, word.text), word.uses & RESERVED == 0, "{}", word.text);
            assert_eq!(Grammar::parse(Rule::item_start, word.text).is_ok(), word.uses & ITEM != 0, "{}", word.text);
            assert_eq!(words().filter(|other| other.text == word.text).count(), 1, "{}", word.text);
        }
    }

    #[test]
    fn each_word_of_the_grammar_has_its_row() {
        for &rule in Rule::all_rules() {
            let name = format!("{rule:?}");
            let Some((kind @ ("kw" | "w" | "v"), text)) = name.split_once('_') else { continue };
            let row = find(text).unwrap_or_else(|| panic!("`{name}` is in the grammar only"));
            assert_eq!(row.uses & RESERVED != 0, kind != "w", "{name}");
            assert!(reads(rule, text), "{name}");
            assert_eq!(of_rule(rule), Some(text), "{name}");
        }
    }
}
