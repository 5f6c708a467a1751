//! The page's figures, between marks that the page itself has: `<!-- figures: NAME -->` and `<!-- end -->`.

use std::path::PathBuf;
use std::{fs, io};

/// A page with places for figures.
pub struct Page {
    path: PathBuf,
    text: String,
}

impl Page {
    /// Reads the page.
    pub fn read(path: PathBuf) -> io::Result<Self> {
        Ok(Page { text: fs::read_to_string(&path)?, path })
    }

    /// Puts figures into their place.
    pub fn put(&mut self, name: &str, figures: &str) -> io::Result<()> {
        let mark = format!("<!-- figures: {name} -->\n");
        let missing = || io::Error::other(format!("{} has no place for `{name}`", self.path.display()));
        let begin = self.text.find(&mark).ok_or_else(missing)? + mark.len();
        let end = begin + self.text[begin..].find("<!-- end -->").ok_or_else(missing)?;
        self.text.replace_range(begin..end, figures);
        Ok(())
    }

    /// Writes it.
    pub fn write(&self) -> io::Result<()> {
        fs::write(&self.path, &self.text)
    }
}

/// A table in Markdown.
pub fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let dashes = format!("|{}\n", "---|".repeat(head.len()));
    let head = line(head.iter().map(|cell| String::from(*cell)).collect());
    rows.fold(format!("{head}{dashes}"), |text, row| text + &line(row))
}
