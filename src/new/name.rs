//! The name of a project, made a name of the language.

use super::Refusal;
use std::path::Path;

/// Longer names would not fit on a line of a trace.
const NAME_MAX: usize = 40;

/// What is proposed where nothing can be made of what was given.
const EXAMPLE: &str = "coast_survey";

/// The mission's name: the folder's, with `_` for `-`.
pub fn mission(folder: &Path) -> Result<String, Refusal> {
    let given = folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy();
    let name = given.replace('-', "_");
    let refuse = |why: &str| {
        // Blanks and what a terminal would obey are shown as they are written in a text.
        let message = format!("`{}` cannot be the name of a project: {why}", given.escape_debug());
        Err(Refusal::usage(message, format!("try `{}`", mended(&given))))
    };
    if name.chars().any(|c| !c.is_ascii_alphanumeric() && c != '_') {
        return refuse("it may hold letters from a to z, digits, `_` and `-`");
    }
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return refuse("it must begin with a letter");
    }
    if name.len() > NAME_MAX {
        return refuse(&format!("it is longer than {NAME_MAX} letters"));
    }
    if albacore_session::load_or_module(Path::new(&name)).is_ok() {
        let message = format!("`{name}` is a module of the standard library, which the project's script would hide");
        return Err(Refusal::usage(message, format!("try `{name}_survey`")));
    }
    Ok(name)
}

/// A name that is like what was given, and can be one.
fn mended(given: &str) -> String {
    let plain: String = given.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let words: Vec<&str> = plain.split('_').filter(|word| !word.is_empty()).collect();
    let name = match words.join("_") {
        name if name.is_empty() => EXAMPLE.to_string(),
        name if name.starts_with(|c: char| c.is_ascii_digit()) => format!("survey_{name}"),
        name => name,
    };
    name.chars().take(NAME_MAX).collect()
}
