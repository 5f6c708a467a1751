//! Long texts on several lines.

/// A text on lines of so many letters at most, as far as its words allow: a word is broken only when it is longer than a
/// line. There is always one line.
pub fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut used = 0;
    for word in text.split_whitespace() {
        let word: Vec<char> = word.chars().collect();
        for (i, piece) in word.chunks(letters.max(1)).enumerate() {
            let starts_line = used == 0;
            if !starts_line && (i > 0 || used + 1 + piece.len() > letters) {
                lines.push(String::new());
                used = 0;
            } else if !starts_line {
                push(&mut lines, &[' ']);
                used += 1;
            }
            push(&mut lines, piece);
            used += piece.len();
        }
    }
    lines
}

fn push(lines: &mut [String], piece: &[char]) {
    if let Some(line) = lines.last_mut() {
        line.extend(piece);
    }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn words_stay_whole_and_only_what_fits_nowhere_is_broken() {
        assert_eq!(wrapped("(detection or done) and source", 20), ["(detection or done)", "and source"]);
        assert_eq!(wrapped("", 20), [""]);
        assert_eq!(wrapped("a bcdefghi j", 4), ["a", "bcde", "fghi", "j"]);
        assert_eq!(wrapped("°°°° °", 4), ["°°°°", "°"]);
    }
}
