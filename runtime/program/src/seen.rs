//! What a person sees of a text that others wrote: scripts, vehicles, names of files, URLs. A terminal obeys control characters,
//! and marks that nobody sees turn words about; so whatever is shown goes through here, at the rim where it is shown.

/// Whether a character is one that nobody sees as it is: a control code, a mark without width, a turn of the direction of
/// writing, a letter without a shape.
pub fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{180e}' | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{3164}' | '\u{feff}' | '\u{ffa0}'
            | '\u{fff9}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}' | '\u{e0000}'..='\u{e007f}')
}

/// A text as it is shown: what is unseen is written as a Rust literal has it, `\u{1b}`. Line ends and tabs stay.
pub fn shown(text: &str) -> String {
    escaped(text, |c| matches!(c, '\n' | '\t').then_some(c))
}

/// A text as it is shown on one line: its line ends and tabs are blanks.
pub fn one_line(text: &str) -> String {
    escaped(text, |c| matches!(c, '\n' | '\r' | '\t').then_some(' '))
}

/// No name of a file is longer, in bytes; a longer word is nobody's to read.
const WORD_MAX: usize = 255;
/// No path of a file is longer, in bytes, with something said of it.
const TEXT_MAX: usize = 5_000;

/// A text of a message in which words that are too long to be read are shortened, and which ends where none is read to its end.
pub fn shortened(text: &str) -> String {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut out = String::with_capacity(text.len().min(TEXT_MAX));
    let mut rest = text;
    while !rest.is_empty() && out.len() < TEXT_MAX {
        let end = rest.find(|c| !is_of_word(c)).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        match word.len() {
            0..=WORD_MAX => out.push_str(word),
            _ => {
                out.extend(word.chars().take(40));
                out.push('…');
            }
        }
        let sign = after.chars().next();
        out.extend(sign);
        rest = &after[sign.map_or(0, char::len_utf8)..];
    }
    if !rest.is_empty() {
        out.push('…');
    }
    out
}

/// The same text with something to be seen for all that is not, each as many bytes long as what it stands for: places in the
/// text stay where they are.
pub fn masked(text: &str) -> String {
    let mask = |c: char| match c.len_utf8() {
        1 => "?",
        2 => "¿",
        3 => "\u{fffd}",
        _ => "?\u{fffd}",
    };
    let mut out = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        // A line may end as on other systems.
        let ends_line = c == '\r' && rest.peek() == Some(&'\n');
        if is_unseen(c) && !matches!(c, '\n' | '\t') && !ends_line {
            out.push_str(mask(c));
        } else {
            out.push(c);
        }
    }
    out
}

fn escaped(text: &str, stays: impl Fn(char) -> Option<char>) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match stays(c) {
            Some(c) => out.push(c),
            None if is_unseen(c) => out.extend(c.escape_unicode()),
            None => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        let evil = "a\u{1b}[2Jb\u{9b}31m\u{202e}c\u{7f}\r\n\td\u{e0041}";
        assert_eq!(shown(evil), "a\\u{1b}[2Jb\\u{9b}31m\\u{202e}c\\u{7f}\\u{d}\n\td\\u{e0041}");
        assert_eq!(one_line(evil), "a\\u{1b}[2Jb\\u{9b}31m\\u{202e}c\\u{7f}  \u{20}d\\u{e0041}");
        assert_eq!(shown("36°10.8'N é µ … → 水"), "36°10.8'N é µ … → 水");
    }

    #[test]
    fn what_is_too_long_to_be_read_is_shortened() {
        let name = "é_1".repeat(40_000);
        assert_eq!(shortened(&format!("no `{name}` here: {name}")), format!("no `{0}…` here: {0}…", &name[..54]));
        let path = format!("`{}`", "/ab c".repeat(800));
        assert_eq!(shortened(&path), path);
        assert!(shortened(&"/ab c".repeat(10_000)).len() < 5_010);
        assert_eq!(shortened(""), "");
    }

    #[test]
    fn a_masked_text_has_its_places() {
        for c in (0..0x11_0000).filter_map(char::from_u32) {
            let text = format!("a{c}b");
            let masked = masked(&text);
            assert_eq!(masked.len(), text.len());
            assert!(masked.ends_with('b') && !masked.chars().any(|c| is_unseen(c) && !matches!(c, '\n' | '\t')));
        }
        assert_eq!(masked("a\r\nb\rc"), "a\r\nb?c");
    }
}
