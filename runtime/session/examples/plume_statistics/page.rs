//! The page's figures, between marks that the page itself has: `<!-- figures: NAME -->` and `<!-- end -->`.

use std::path::PathBuf;
use std::{fs, io};

/// A page with places for figures.
pub struct Page {
    path: PathBuf,
    /// By the names of their places.
    figures: Vec<(String, String)>,
}

impl Page {
    /// The page at a path.
    pub fn new(path: PathBuf) -> Self {
        Page { path, figures: Vec::new() }
    }

    /// Keeps figures for their place.
    pub fn put(&mut self, name: &str, figures: String) {
        self.figures.push((String::from(name), figures));
    }

    /// Puts all figures into their places, and leaves the rest of the page as it is.
    pub fn write(&self) -> io::Result<()> {
        let mut text = fs::read_to_string(&self.path)?;
        for (name, figures) in &self.figures {
            let mark = format!("<!-- figures: {name} -->\n");
            let missing = || io::Error::other(format!("{} has no place for `{name}`", self.path.display()));
            let begin = text.find(&mark).ok_or_else(missing)? + mark.len();
            let end = begin + text[begin..].find("<!-- end -->").ok_or_else(missing)?;
            text.replace_range(begin..end, figures);
        }
        fs::write(&self.path, text)
    }
}

/// A table in Markdown.
pub fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let dashes = format!("|{}\n", "---|".repeat(head.len()));
    let head = line(head.iter().map(|cell| String::from(*cell)).collect());
    rows.fold(format!("{head}{dashes}"), |text, row| text + &line(row))
}
