//! The columns of what is exported, as they grow: each begins with what comes first for it, and has nothing where nothing came.

use albacore_export::{Column, Role, Values};
use albacore_program::seen::one_line;
use std::collections::BTreeMap;

/// So many columns there are: some four for each measurement that we know.
const COLUMNS_MAX: usize = 256;

/// Which column it is; they stand in the order of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    /// A number of a measurement: whether it was withheld, how many of its tick came after it, and which number.
    Sensed(u16, bool, usize, usize),
    /// Whether a measurement is doubted.
    Doubted(u16),
    /// Whether the vehicle lies on the bottom.
    Aground,
    /// What is commanded, by its place among all that can be.
    Commanded(usize),
    /// Who drives.
    Control,
    /// What is active.
    Behavior,
    /// What is so, by its place among all that is known.
    True(usize),
    /// What the navigation is off by, by its place among all that is known of that.
    Navigation(usize),
}

/// What a column is.
pub struct Head {
    pub name: String,
    pub unit: &'static str,
    pub meaning: String,
    pub role: Option<Role>,
    pub standard_name: Option<&'static str>,
    pub kind: Kind,
}

/// What its values are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Number,
    Date,
    Text,
}

/// A column in the making.
struct Growing {
    head: Head,
    numbers: Vec<f64>,
    texts: Vec<String>,
    rows: Vec<u32>,
    /// Where each text stands.
    places: BTreeMap<String, u32>,
}

/// All of them.
#[derive(Default)]
pub struct Columns {
    columns: BTreeMap<Key, Growing>,
    /// Values for which there is no column.
    pub left_out: u64,
}

/// Stands in a row that has no text.
const NO_TEXT: u32 = u32::MAX;

impl Columns {
    /// There is such a column, though nothing may come for it.
    pub fn declare(&mut self, key: Key, head: impl FnOnce() -> Head) {
        self.growing(key, head);
    }

    fn growing(&mut self, key: Key, head: impl FnOnce() -> Head) -> Option<&mut Growing> {
        if !self.columns.contains_key(&key) {
            if self.columns.len() >= COLUMNS_MAX {
                self.left_out += 1;
                return None;
            }
            let (numbers, texts, rows, places) = (Vec::new(), Vec::new(), Vec::new(), BTreeMap::new());
            self.columns.insert(key, Growing { head: head(), numbers, texts, rows, places });
        }
        self.columns.get_mut(&key)
    }

    /// A number of a row; one that is none is absent.
    pub fn number(&mut self, key: Key, row: usize, x: f64, head: impl FnOnce() -> Head) {
        let Some(growing) = self.growing(key, head) else { return };
        growing.numbers.resize(row, f64::NAN);
        growing.numbers.push(x);
    }

    /// A text of a row.
    pub fn text(&mut self, key: Key, row: usize, text: &str, head: impl FnOnce() -> Head) {
        let Some(growing) = self.growing(key, head) else { return };
        let place = match growing.places.get(text) {
            Some(known) => *known,
            None => {
                let place = growing.texts.len() as u32;
                growing.texts.push(one_line(text));
                growing.places.insert(text.to_string(), place);
                place
            }
        };
        growing.rows.resize(row, NO_TEXT);
        growing.rows.push(place);
    }

    /// All of them, with so many rows.
    pub fn finish(self, rows: usize) -> Vec<Column> {
        self.columns.into_values().map(|growing| growing.finish(rows)).collect()
    }
}

impl Growing {
    fn finish(mut self, rows: usize) -> Column {
        let Head { name, unit, meaning, role, standard_name, kind } = self.head;
        self.numbers.resize(if kind == Kind::Text { 0 } else { rows }, f64::NAN);
        self.rows.resize(if kind == Kind::Text { rows } else { 0 }, NO_TEXT);
        let values = match kind {
            Kind::Number => Values::Numbers(self.numbers),
            Kind::Date => Values::Dates(self.numbers),
            Kind::Text => Values::Texts(self.texts, self.rows),
        };
        Column { name: one_line(&name), unit, meaning: one_line(&meaning), role, standard_name, values }
    }
}
