//! What can stand at a place of a line that is being typed, and what its words are.

use super::Prompt;
use super::command::WORDS;
use albacore_lang::syntax::words;

/// What a word of a line is, for who shows it in colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordKind {
    /// A word of the language, or of the prompt.
    Word,
    /// A number, with the unit behind it.
    Number,
    /// A text in quotes.
    Text,
    /// A comment.
    Comment,
    /// All else.
    Plain,
}

fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

impl Prompt {
    /// What can stand where a line is written up to a byte: the byte at which the word begins, and the words that it can be.
    pub fn complete(&mut self, line: &str, at: usize) -> (usize, Vec<String>) {
        let Some(before) = line.get(..at) else { return (at, Vec::new()) };
        let begin =
            before.rfind(|c| !is_part(c)).map_or(0, |i| i + before[i..].chars().next().map_or(1, char::len_utf8));
        let (head, word) = (&before[..begin], &before[begin..]);
        let mut words = self.words_behind(head);
        words.retain(|known| known.starts_with(word) && known != word && (!word.is_empty() || known.len() > 1));
        words.sort();
        words.dedup();
        (begin, words)
    }

    /// What can stand behind the beginning of a line.
    fn words_behind(&mut self, head: &str) -> Vec<String> {
        let known = self.known();
        if let Some(base) = head.strip_suffix('.') {
            let begin = base.rfind(|c| !is_part(c) && c != '.').map_or(0, |i| i + 1);
            return match base.get(begin..) {
                Some(base) if !base.is_empty() => self.loaded.lines.members(&*self.loaded.files, base, &known),
                _ => Vec::new(),
            };
        }
        let number = head.trim_end();
        if number.ends_with(|c: char| c.is_ascii_digit()) && ends_in_number(number) {
            return self.loaded.lines.units();
        }
        let mut words = Vec::new();
        if head.trim().is_empty() {
            words.extend(WORDS.map(String::from));
        }
        match head.trim() {
            "switch to" | "compare" => return self.forks.keys().cloned().collect(),
            "run until" => words.extend(self.behaviors()),
            "set" => return self.parameters_of_mission(),
            _ => {}
        }
        if let Some(callee) = called(head) {
            words.extend(self.loaded.lines.parameters(callee).into_iter().map(|name| name + ": "));
        }
        words.extend(known.into_iter().map(|named| named.name).filter(|name| !name.contains(' ')));
        words.extend(self.loaded.lines.names());
        words
    }

    fn behaviors(&self) -> Vec<String> {
        let task = self.now.task.as_ref().map(|task| task.machine.program().clone());
        let activities = task.iter().flat_map(|program| program.activities.iter().map(|a| a.name.clone()));
        activities.filter(|name| name.chars().all(is_part)).collect()
    }

    fn parameters_of_mission(&self) -> Vec<String> {
        let mission = self.loaded.mission.as_ref().map_or("", |program| &program.mission.name);
        self.loaded.lines.parameters(mission).into_iter().map(|name| name + " = ").collect()
    }

    /// The words of a line, with what they are: stretches that follow one another.
    pub fn highlighted(line: &str) -> Vec<(&str, WordKind)> {
        let mut out = Vec::new();
        let mut rest = line;
        while let Some(first) = rest.chars().next() {
            let (length, kind) = match first {
                '"' => (text_length(rest), WordKind::Text),
                '/' if rest.starts_with("//") => (rest.find('\n').unwrap_or(rest.len()), WordKind::Comment),
                c if c.is_ascii_digit() => (number_length(rest), WordKind::Number),
                c if is_part(c) => {
                    let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
                    let word = &rest[..length];
                    let begins = out.iter().all(|(text, _): &(&str, WordKind)| text.trim().is_empty());
                    let is_word = words::find(word).is_some() || begins && WORDS.contains(&word);
                    (length, if is_word { WordKind::Word } else { WordKind::Plain })
                }
                c => (c.len_utf8(), WordKind::Plain),
            };
            let (word, after) = rest.split_at(length);
            out.push((word, kind));
            rest = after;
        }
        out
    }
}

/// Whether what ends in a digit is a number, not a name with one.
fn ends_in_number(text: &str) -> bool {
    let begin = text.rfind(|c| !is_part(c)).map_or(0, |i| i + 1);
    text.get(begin..).is_some_and(|word| word.starts_with(|c: char| c.is_ascii_digit()))
}

/// The name or path whose bracket is open at the end of a text.
fn called(text: &str) -> Option<&str> {
    let mut depth = 0_i32;
    for (at, c) in text.char_indices().rev() {
        match c {
            ')' => depth += 1,
            '(' if depth > 0 => depth -= 1,
            '(' => {
                let head = &text[..at];
                let begin = head.rfind(|c| !is_part(c) && c != '.').map_or(0, |i| i + 1);
                return head.get(begin..).filter(|callee| !callee.is_empty());
            }
            _ => {}
        }
    }
    None
}

/// The bytes of a text in quotes, up to its end or that of the line.
fn text_length(rest: &str) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            _ => escaped = c == '\\' && !escaped,
        }
    }
    rest.len()
}

/// The bytes of a number and, behind a blank or none, its unit.
fn number_length(rest: &str) -> usize {
    let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '_')).unwrap_or(rest.len());
    // `1..5` is two numbers.
    let end = rest[..end].find("..").unwrap_or(end);
    let unit = rest[end..].strip_prefix(' ').map_or((end, &rest[end..]), |unit| (end + 1, unit));
    let length = unit.1.find(|c: char| !(is_part(c) || matches!(c, '%' | '/' | '^' | '°'))).unwrap_or(unit.1.len());
    let word = &unit.1[..length];
    let is_unit =
        !word.is_empty() && words::find(word).is_none() && albacore_lang::dimension::unit(word, &|_| None).is_some();
    if is_unit { unit.0 + length } else { end }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_line_are_told_apart() {
        let kinds = |line| {
            let words = Prompt::highlighted(line).into_iter().filter(|(word, _)| !word.trim().is_empty());
            words.map(|(word, kind)| format!("{word}:{kind:?}")).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(
            kinds("goto home within 5 min // there"),
            "goto:Word home:Plain within:Word 5 min:Number // there:Comment"
        );
        assert_eq!(kinds("log \"a \\\" b\" 3"), "log:Word \"a \\\" b\":Text 3:Number");
        assert_eq!(kinds("run until x"), "run:Word until:Word x:Plain");
        let line = "x = 2 m/s * \"é";
        assert_eq!(Prompt::highlighted(line).into_iter().map(|(word, _)| word).collect::<String>(), line);
    }

    #[test]
    fn an_open_bracket_is_of_what_is_called() {
        assert_eq!(called("let f = cpt.trace_plume(op, lambda: max(1 s, 2 s), "), Some("cpt.trace_plume"));
        assert_eq!(called("goto (3"), None);
        assert_eq!(called("max(1, 2) + "), None);
    }
}
