//! Commands as a person can paste them.

use albacore_session::seen::is_unseen;
use std::ffi::OsStr;
use std::path::Path;

/// A path as a shell takes it, and no program for an option.
pub fn path(path: &Path) -> String {
    let path =
        if path.as_os_str().as_encoded_bytes().starts_with(b"-") { Path::new(".").join(path) } else { path.into() };
    word(path.as_os_str())
}

/// A word as a shell takes it. One that a terminal would not show, or that is no text, is written out in the way of `$'\x1b'`.
pub fn word(word: &OsStr) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./@%+,:=".contains(c);
    match word.to_str() {
        Some(text) if !text.is_empty() && text.chars().all(is_plain) => text.to_string(),
        Some(text) if !text.chars().any(is_unseen) => format!("'{}'", text.replace('\'', "'\\''")),
        _ => {
            let seen = |b: u8| match b {
                b'\'' | b'\\' => format!("\\{}", b as char),
                b' '..=b'~' => (b as char).to_string(),
                _ => format!("\\x{b:02x}"),
            };
            format!("$'{}'", word.as_encoded_bytes().iter().copied().map(seen).collect::<String>())
        }
    }
}
