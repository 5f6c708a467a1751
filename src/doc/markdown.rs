//! A page as Markdown. Comments are taken as such, so that they may hold lists and emphasis.

use super::names::{Names, Use, anchor, url};
use super::{Import, Module};
use albacore_session::doc::{Declaration, Param};

/// The mark of a code block in whose place a diagram is drawn.
pub const DIAGRAM: &str = "diagram ";

/// A module's page.
pub fn page(module: &Module, home: usize, names: &Names, with_diagrams: bool) -> String {
    let mut text = format!("# {}\n", module.name);
    let link = |told: &str| linked(told, &[], home, names);
    paragraph(&mut text, &link(&module.page.text));
    match module.standard {
        Some(Import::Needed) => paragraph(&mut text, &format!("Imported with `use {}`.", module.name)),
        Some(Import::Known) => paragraph(&mut text, "Every script knows these names."),
        None => {}
    }
    if module.page.declarations.len() > 1 {
        text.push_str("\n| declaration | what it is |\n|---|---|\n");
        for d in &module.page.declarations {
            let at = anchor(&format!("{} {}", d.word, d.name));
            let said = cell(&linked(&first_sentence(&d.text), &params(d), home, names));
            text.push_str(&format!("| {} [`{}`](#{at}) | {said} |\n", d.word, d.name));
        }
    }
    for d in &module.page.declarations {
        declaration(&mut text, d, home, names, with_diagrams);
    }
    if !module.page.tests.is_empty() {
        text.push_str("\n## Tests\n\n");
        module.page.tests.iter().for_each(|name| text.push_str(&format!("- {name}\n")));
    }
    text
}

/// The page that leads to the others.
pub fn index(modules: &[Module]) -> String {
    let mut text =
        "# Modules\n\nMade by `albacore doc` from the scripts themselves.\n\n| module | what it is |\n|---|---|\n"
            .to_string();
    for module in modules {
        let said = cell(&first_sentence(&module.page.text));
        text.push_str(&format!("| [`{}`]({}.md) | {said} |\n", module.name, url(&module.name)));
    }
    text
}

fn declaration(text: &mut String, d: &Declaration, home: usize, names: &Names, with_diagrams: bool) {
    text.push_str(&format!("\n## {} {}\n", d.word, d.name));
    let hidden = params(d);
    let link = |told: &str| linked(told, &hidden, home, names);
    paragraph(text, &link(&d.text));
    code(text, "alb", &d.written);
    if !d.params.is_empty() {
        parameters(text, &d.params, home, names, &hidden);
    }
    if let Some(result) = &d.result {
        let what = match d.word {
            "fn" => "Gives",
            "clause" => "Is a value of type",
            _ => "Finishes with",
        };
        paragraph(text, &format!("{what} {}.", ty(result, home, names)));
    }
    if let Some(terms) = &d.terms {
        code(text, "alb", terms);
    }
    let base = base(d);
    if let Some(base) = base {
        paragraph(
            text,
            &format!(
                "Parameters, signals, memories and behaviors that are not named here are those of {}.",
                ty(base, home, names)
            ),
        );
    }
    if d.behaviors.iter().all(|behavior| behavior.text.is_empty()) {
        let listed: Vec<String> = d.behaviors.iter().map(|behavior| format!("`{}`", behavior.name)).collect();
        if !listed.is_empty() {
            let own = if base.is_some() { "own " } else { "" };
            paragraph(text, &format!("Its {own}behaviors are {}.", listed.join(", ")));
        }
    } else {
        text.push_str("\n| behavior | what it is |\n|---|---|\n");
        for behavior in &d.behaviors {
            text.push_str(&format!("| `{}` | {} |\n", behavior.name, cell(&link(&behavior.text))));
        }
    }
    if let Some(table) = &d.table {
        if with_diagrams {
            code(text, &format!("{DIAGRAM}{}", d.name), "");
        }
        code(text, "alb", table);
    }
}

/// The strategy that one is derived from: `= cpt_2005 with`.
fn base(d: &Declaration) -> Option<&str> {
    let (_, of) = d.written.rsplit_once("= ").filter(|_| d.word == "strategy")?;
    of.trim_end().strip_suffix(" with")
}

fn parameters(text: &mut String, params: &[Param], home: usize, names: &Names, hidden: &[&str]) {
    // A column in which nothing stands is left out.
    let has_range = params.iter().any(|p| p.range.is_some());
    let has_text = params.iter().any(|p| !p.text.is_empty());
    let row = |cells: [&str; 3], range: &str, said: &str| {
        let mut row = format!("| {} | {} | {} |", cells[0], cells[1], cells[2]);
        [(has_range, range), (has_text, said)].iter().filter(|(has, _)| *has).for_each(|(_, cell)| {
            row.push_str(&format!(" {cell} |"));
        });
        row + "\n"
    };
    text.push('\n');
    text.push_str(&row(["parameter", "type", "else"], "range", "what it is"));
    text.push_str(&row(["---", "---", "---"], "---", "---"));
    for p in params {
        let value = p.default.as_ref().map_or("needed".to_string(), |value| format!("`{}`", cell(value)));
        let range = p.range.as_ref().map_or(String::new(), |range| format!("`{}`", cell(range)));
        let (name, ty) = (format!("`{}`", p.name), ty(&p.ty, home, names));
        text.push_str(&row([&name, &ty, &value], &range, &cell(&linked(&p.text, hidden, home, names))));
    }
}

/// A type, with its link if it is a declaration's.
fn ty(written: &str, home: usize, names: &Names) -> String {
    let bare = written.trim_end_matches('?');
    match names.link(bare, home, Use::Value) {
        Some(link) => format!("[`{written}`]({link})"),
        None => format!("`{}`", cell(written)),
    }
}

fn params(d: &Declaration) -> Vec<&str> {
    d.params.iter().map(|p| p.name.as_str()).chain([d.name.as_str()]).collect()
}

/// A comment in which names in backticks lead to what they name; `hidden` mean something nearer.
fn linked(text: &str, hidden: &[&str], home: usize, names: &Names) -> String {
    // A block of code has backticks of its own.
    if text.contains("``") {
        return text.to_string();
    }
    let parts: Vec<&str> = text.split('`').collect();
    let mut out = String::new();
    for (i, part) in parts.iter().enumerate() {
        let is_code = i % 2 == 1 && i + 1 < parts.len();
        let is_linked_already = out.ends_with('[');
        let link = if is_code && !is_linked_already && !hidden.contains(part) {
            names.link(part, home, Use::Told)
        } else {
            None
        };
        match (is_code, link) {
            (true, Some(link)) => out.push_str(&format!("[`{part}`]({link})")),
            (true, None) => out.push_str(&format!("`{part}`")),
            (false, _) if i % 2 == 1 => out.push_str(&format!("`{part}")),
            (false, _) => out.push_str(part),
        }
    }
    out
}

/// The first sentence of a comment's first paragraph.
fn first_sentence(text: &str) -> String {
    let paragraph = text.split("\n\n").next().unwrap_or("");
    let words: Vec<&str> = paragraph.split_whitespace().collect();
    let ends = |i: usize| {
        let next_begins = words.get(i + 1).is_none_or(|next| next.starts_with(|c: char| c.is_uppercase() || c == '`'));
        words[i].ends_with('.') && next_begins && !ABBREVIATIONS.contains(&words[i])
    };
    let count = (0..words.len()).find(|&i| ends(i)).map_or(words.len(), |i| i + 1);
    words[..count].join(" ")
}

/// Words whose full stop ends no sentence.
const ABBREVIATIONS: [&str; 6] = ["Fig.", "Figs.", "Sec.", "Secs.", "(Sec.", "al."];

fn paragraph(text: &mut String, said: &str) {
    if !said.is_empty() {
        text.push_str(&format!("\n{said}\n"));
    }
}

fn code(text: &mut String, mark: &str, said: &str) {
    let end = if said.is_empty() { "" } else { "\n" };
    text.push_str(&format!("\n```{mark}\n{said}{end}```\n"));
}

/// A text as a cell of a table: on one line, and with no bar that would end it.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}
