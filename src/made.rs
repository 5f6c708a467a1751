//! What the program makes of scripts: a text that ends with a mark, in which a digest of all before it stands. Such a file
//! may be made again in its place while it is as it was made; one that somebody else wrote, or edited, has no mark that fits.

use albacore_session::Digest;

/// How a text holds what is no part of it.
#[derive(Clone, Copy)]
pub enum Comment {
    /// SVG, HTML and Markdown.
    Markup,
    /// Graphviz.
    Slashes,
    /// Mermaid.
    Percents,
}

/// A text with its mark.
pub struct Made(String);

impl Made {
    /// Marks a text, which may stand in a file from then on.
    pub fn new(mut text: String, comment: Comment) -> Self {
        if !text.ends_with('\n') {
            text.push('\n');
        }
        let mark = comment.mark(text.as_bytes());
        Made(text + &mark)
    }

    /// What a file holds of it.
    pub fn text(&self) -> &str {
        &self.0
    }
}

/// Whether these bytes are as they were made.
pub fn is_as_made(bytes: &[u8]) -> bool {
    let marked = |comment: &Comment| {
        let length = bytes.len().checked_sub(comment.mark(&[]).len());
        length
            .and_then(|length| bytes.split_at_checked(length))
            .is_some_and(|(text, mark)| comment.mark(text).as_bytes() == mark)
    };
    Comment::ALL.iter().any(marked)
}

impl Comment {
    const ALL: [Comment; 3] = [Comment::Markup, Comment::Slashes, Comment::Percents];

    /// The mark of a text: always of the same length.
    fn mark(self, text: &[u8]) -> String {
        let mut digest = Digest::new();
        digest.bytes(text);
        let (before, after) = match self {
            Comment::Markup => ("<!-- ", " -->"),
            Comment::Slashes => ("// ", ""),
            Comment::Percents => ("%% ", ""),
        };
        format!("{before}Made by Albacore: {digest}{after}\n")
    }
}

/// Where the sum of a record in JSON stands, without it: it is the last of its fields.
const SUM: &str = "\"sum\": \"";

/// A record in JSON, whose last field is `sum`, with the digest of all before it.
pub fn summed(json: &str) -> String {
    let before = json.rsplit_once(SUM).map_or(json, |(before, _)| before);
    let mut digest = Digest::new();
    digest.bytes(before.as_bytes());
    format!("{before}{SUM}{digest}\"\n}}\n")
}

/// Whether a record in JSON is as it was made.
pub fn is_as_summed(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| text.contains(SUM) && summed(text) == text)
}

#[cfg(test)]
mod tests {
    use super::{Comment, Made, is_as_made};

    #[test]
    fn every_edit_is_noticed() {
        for comment in Comment::ALL {
            for text in ["", "one\ntwo\n", "no end"] {
                let made = Made::new(text.to_string(), comment).text().as_bytes().to_vec();
                assert!(is_as_made(&made));
                for bit in 0..8 * made.len() {
                    let mut edited = made.clone();
                    edited[bit / 8] ^= 1 << (bit % 8);
                    assert!(!is_as_made(&edited), "bit {bit}");
                }
                for at in 0..made.len() {
                    assert!(
                        !is_as_made(&made[..at]) && !is_as_made(&[&made[..at], b"\n", &made[at..]].concat()),
                        "{at}"
                    );
                }
                assert!(!is_as_made(&[b"mine\n", &made[..]].concat()) && !is_as_made(&[&made[..], b"mine\n"].concat()));
            }
        }
    }
}
