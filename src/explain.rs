//! `albacore explain`: what the code of a finding means, and how such a mistake is mended.

use crate::exit::Exit;
use crate::{message, output};
use albacore_session::{Code, nearest};
use std::collections::BTreeSet;
use std::io::IsTerminal;

/// Explain the code of an error or a warning.
#[derive(clap::Args)]
pub struct Explain {
    /// A code, such as `units::unknown`, or a group of codes, such as `units`; else all are listed.
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

impl Explain {
    /// Prints a page, or a list of codes.
    pub fn run(&self) -> Exit {
        explain(self.code.as_deref())
    }
}

/// Prints the page of a code, or a list of codes.
pub fn explain(code: Option<&str>) -> Exit {
    let Some(name) = code else {
        output::print_raw(&list(Code::ALL));
        return Exit::Well;
    };
    if let Some(code) = Code::named(name) {
        output::print_raw(&page(code));
        return Exit::Well;
    }
    let group: Vec<Code> = Code::ALL.iter().copied().filter(|code| code.group() == name).collect();
    if group.is_empty() {
        message::error(&format!("there is no code `{name}`"), Some(&suggestion(name)));
        return Exit::Usage;
    }
    output::print_raw(&list(&group));
    Exit::Well
}

/// A page as it is read on a terminal: what stands between fences is indented instead.
fn page(code: Code) -> String {
    let mut lines = code.page().lines();
    let title = lines.next().unwrap_or_default().trim_start_matches("# ");
    let mut text = format!("{}: {title}\n", strong(code.name()));
    let mut in_example = false;
    for line in lines {
        if line.starts_with("```") {
            in_example = !in_example;
        } else if in_example && !line.is_empty() {
            text.push_str(&format!("    {line}\n"));
        } else {
            text.push_str(&format!("{line}\n"));
        }
    }
    text
}

/// Codes with their titles, a blank line between groups.
fn list(codes: &[Code]) -> String {
    let width = codes.iter().map(|code| code.name().len()).max().unwrap_or(0);
    let mut text = String::new();
    let mut group = None;
    for &code in codes {
        if group.replace(code.group()).is_some_and(|before| before != code.group()) {
            text.push('\n');
        }
        let blank = " ".repeat(width - code.name().len());
        text.push_str(&format!("{}{blank}  {}\n", strong(code.name()), code.title()));
    }
    text
}

/// What may have been meant: a code or a group that is written nearly so, or the codes that end so.
fn suggestion(name: &str) -> String {
    let groups: BTreeSet<&str> = Code::ALL.iter().map(|code| code.group()).collect();
    let known = Code::ALL.iter().map(|code| code.name()).chain(groups.iter().copied());
    if let Some(near) = nearest(name, known) {
        return format!("did you mean `{near}`?");
    }
    let last = name.rsplit("::").next().unwrap_or(name);
    let ending = |code: &&Code| code.name().strip_suffix(last).is_some_and(|before| before.ends_with("::"));
    let alike: Vec<String> = Code::ALL.iter().filter(ending).map(|code| format!("`{code}`")).collect();
    if alike.is_empty() {
        let groups: Vec<&str> = groups.into_iter().collect();
        format!("`albacore explain` lists all; their groups are {}", groups.join(", "))
    } else {
        format!("there is {}", alike.join(", "))
    }
}

/// Bold where a person looks.
fn strong(text: &str) -> String {
    let plain = !std::io::stdout().is_terminal() || std::env::var_os("NO_COLOR").is_some();
    if plain { text.to_string() } else { format!("\x1b[1m{text}\x1b[0m") }
}
