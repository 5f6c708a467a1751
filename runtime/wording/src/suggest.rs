//! "Did you mean": the nearest of the names that exist.

/// No search is made for what a longer name, in bytes, may have meant: comparing two takes as long as the product of their lengths.
const COMPARED_MAX: usize = 64;

/// The candidate nearest to a misspelt name, when it is near enough to be meant.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > COMPARED_MAX {
        return None;
    }
    let name = name.to_lowercase();
    let allowed = match name.chars().count() {
        0..=5 => 1,
        6..=9 => 2,
        _ => 3,
    };
    let letters = Letters::of(&name);
    candidates
        .into_iter()
        .filter(|candidate| letters.may_be(&Letters::of(candidate), allowed))
        .map(|candidate| (distance(&name, &candidate.to_lowercase()), candidate))
        .filter(|&((distance, _), candidate)| distance <= allowed && distance < candidate.chars().count())
        .min()
        .map(|(_, candidate)| candidate)
}

/// How long a word is, and how often it has which letter: tells most words apart without comparing them.
struct Letters {
    length: usize,
    /// By their codes, the two cases of a letter as one. None where a letter is outside ASCII: its lower case may be longer.
    counts: Option<[u8; 128]>,
}

impl Letters {
    fn of(word: &str) -> Self {
        let counts = word.is_ascii().then(|| {
            let mut counts = [0_u8; 128];
            word.bytes().for_each(|b| {
                let count = &mut counts[usize::from(b.to_ascii_lowercase())];
                *count = count.saturating_add(1);
            });
            counts
        });
        Letters { length: word.chars().count(), counts }
    }

    /// A slip of the fingers changes one letter for another at most.
    fn may_be(&self, other: &Letters, slips: usize) -> bool {
        let (Some(ours), Some(theirs)) = (&self.counts, &other.counts) else { return true };
        let differ = |(a, b): (&u8, &u8)| usize::from(a.abs_diff(*b));
        self.length.abs_diff(other.length) <= slips && ours.iter().zip(theirs).map(differ).sum::<usize>() <= 2 * slips
    }
}

/// How many slips of the fingers lie between two words; the same letters in another order are one, and come first.
fn distance(a: &str, b: &str) -> (usize, bool) {
    if a == b {
        return (0, true);
    }
    let sorted = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    if sorted(a) == sorted(b) { (1, false) } else { (strsim::osa_distance(a, b), true) }
}

/// "did you mean `x`?", or else what there is.
pub fn help<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    // Who knows one of the very name knows it as something else.
    let mut all: Vec<&str> = candidates.into_iter().filter(|candidate| *candidate != name).collect();
    if let Some(near) = nearest(name, all.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    all.sort_unstable();
    all.dedup();
    (!all.is_empty() && all.len() <= LISTED_MAX).then(|| format!("there is {}", listed(&all)))
}

/// So many names a message lists.
const LISTED_MAX: usize = 12;

/// Words of which one is written: `` `depth`, `altitude` or `speed` ``.
pub fn either(words: impl IntoIterator<Item = impl AsRef<str>>) -> String {
    let quoted: Vec<String> = words.into_iter().map(|word| format!("`{}`", word.as_ref())).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// `a`, `b` and `c`; of many the first, and how many more there are.
pub fn listed(names: &[impl AsRef<str>]) -> String {
    let quoted: Vec<String> = names.iter().take(LISTED_MAX).map(|n| format!("`{}`", n.as_ref())).collect();
    match quoted.as_slice() {
        [] => String::new(),
        some if names.len() > LISTED_MAX => format!("{} and {} more", some.join(", "), names.len() - LISTED_MAX),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_are_found_and_far_ones_are_not() {
        assert_eq!(nearest("strer", ["steer", "goto", "follow"]), Some("steer"));
        assert_eq!(nearest("mission", ["steer", "goto"]), None);
        assert_eq!(nearest("x", ["y"]), None);
        assert_eq!(nearest("foo", ["cos", "flow"]), None);
        assert_eq!(nearest("whit", ["wait", "with"]), Some("with"));
    }
}
