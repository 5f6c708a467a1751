//! Which name is told of where: the links between pages.

use super::{Import, Module};
use std::collections::BTreeMap;

/// The names of all pages that are made together.
pub struct Names {
    /// By module: what it is called, and its declarations by name, each with its word.
    modules: Vec<(String, BTreeMap<String, Vec<Named>>)>,
    /// Modules whose names every script knows.
    known: Vec<usize>,
}

/// What has a name.
struct Named {
    word: &'static str,
    /// A clause that is the value of another, such as `kinematic`, is written without brackets where its defaults do.
    is_value: bool,
}

impl Named {
    /// Whether it is a part of a clause.
    fn is_part(&self) -> bool {
        self.word == "clause" && self.is_value
    }

    /// The anchor of its heading.
    fn anchor(&self, name: &str) -> String {
        anchor(&format!("{} {name}", self.word))
    }
}

/// Where a name stands.
#[derive(Clone, Copy, PartialEq)]
pub enum Use {
    /// Before `(`.
    Called,
    /// Anywhere else in a script.
    Value,
    /// In a comment.
    Told,
}

/// What can be called. A record is called too, and a type besides.
const CALLED: [&str; 6] = ["behavior", "clause", "fn", "mission", "overlay", "strategy"];

impl Names {
    pub fn new(modules: &[Module]) -> Self {
        let named = |module: &Module| {
            let mut names: BTreeMap<String, Vec<Named>> = BTreeMap::new();
            for declaration in &module.page.declarations {
                let word = declaration.word;
                let is_value = !CALLED.contains(&word) || (word == "clause" && declaration.result.is_some());
                names.entry(declaration.name.clone()).or_default().push(Named { word, is_value });
            }
            (module.name.clone(), names)
        };
        let known = (0..modules.len()).filter(|&i| modules[i].standard == Some(Import::Known)).collect();
        Names { modules: modules.iter().map(named).collect(), known }
    }

    /// The link to what a name means on a page: `search.find` of another module, `duck_2003` of one that every script knows.
    pub fn link(&self, path: &str, home: usize, used: Use) -> Option<String> {
        if let Some((module, name)) = path.split_once('.')
            && let Some(at) = self.modules.iter().position(|(named, _)| named == module)
        {
            return self.in_module(at, name, used).map(|named| self.from(home, at, &named.anchor(name)));
        }
        let own = self.in_module(home, path, used).map(|named| (home, named));
        let known = self.known.iter().filter_map(|&at| Some((at, self.in_module(at, path, used)?)));
        // A sensor is called as the input that comes of it, and means something within `fault(…)` alone: the input is meant.
        let (at, named) = own.or_else(|| known.min_by_key(|(_, named)| named.is_part()))?;
        Some(self.from(home, at, &named.anchor(path)))
    }

    fn in_module(&self, at: usize, name: &str, used: Use) -> Option<&Named> {
        let (_, names) = self.modules.get(at)?;
        let fits = |named: &&Named| match used {
            Use::Called => CALLED.contains(&named.word) || named.word == "record",
            Use::Value => named.is_value,
            Use::Told => true,
        };
        names.get(name)?.iter().find(fits)
    }

    fn from(&self, home: usize, at: usize, anchor: &str) -> String {
        match self.modules.get(at) {
            Some((module, _)) if at != home => format!("{}.md#{anchor}", url(module)),
            _ => format!("#{anchor}"),
        }
    }
}

/// A page's name as it stands in a link: what means something there, and what is no ASCII, by its bytes.
pub fn url(name: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.~".contains(&byte);
    name.bytes().fold(String::new(), |url, byte| match is_plain(byte) {
        true => url + char::from(byte).encode_utf8(&mut [0; 4]),
        false => url + &format!("%{byte:02X}"),
    })
}

/// The anchor of a heading, as forges make it.
pub fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}
