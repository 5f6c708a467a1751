//! What a dialect is: a name, where it is spoken, how its messages are told apart, and what each end of a link makes of them.

use crate::controller::ControllerSide;
use crate::dialects::ALL;
use crate::error::LinkError;
use crate::server::ServerSide;
use std::fmt;

/// A row of the table of dialects.
pub struct Dialect {
    /// Its name in URLs (`?dialect=…`) and in scripts (`dialect(…)`, a clause that gives a `protocol`).
    pub name: &'static str,
    /// The kinds of links that it is spoken on, as URLs begin with.
    pub schemes: &'static [&'static str],
    /// Bits a second of a serial line, unless the URL says otherwise.
    pub baud: u32,
    /// The UDP port that its vehicles mostly listen at.
    pub udp_port: u16,
    /// What else a URL may set for it by name.
    pub settings: &'static [&'static str],
    /// What people call the message without which nothing is known of a vehicle: its state, with a time stamp.
    pub state: &'static str,
    /// A vehicle that hears nothing of its controller for so many ticks drives itself again.
    pub timeout_ticks: u64,
    /// How its messages are told apart.
    pub framing: Framing,
    /// What a controller makes of it; an error says which setting cannot be.
    pub controller: fn(&Settings) -> Result<Box<dyn ControllerSide>, LinkError>,
    /// What a served vehicle makes of it.
    pub server: fn(&Settings) -> Result<Box<dyn ServerSide>, LinkError>,
}

/// How messages are told apart in a stream of bytes: transports send and lose whole ones.
pub struct Framing {
    /// The longest message, and the longest datagram, in bytes.
    pub longest: usize,
    /// How many bytes the first message of a stream is; none while its end has not come.
    pub first: fn(&[u8]) -> Option<usize>,
    /// What ends a message in a datagram that has left it out, so that it takes nothing of the next one.
    pub end: &'static [u8],
    /// Whether a datagram holds a message that is whole and makes sense.
    pub is_message: fn(&[u8]) -> bool,
}

impl Framing {
    /// Cuts bytes into messages; the last one may lack its end.
    pub(crate) fn messages<'a>(&self, bytes: &'a [u8]) -> impl Iterator<Item = &'a [u8]> {
        let (first, mut rest) = (self.first, bytes);
        std::iter::from_fn(move || {
            let length = first(rest).unwrap_or(rest.len()).clamp(1.min(rest.len()), rest.len());
            let (message, after) = rest.split_at(length);
            rest = after;
            (!message.is_empty()).then_some(message)
        })
    }
}

impl Dialect {
    /// The dialect of a name.
    pub fn named(name: &str) -> Result<&'static Dialect, LinkError> {
        let named = ALL.iter().find(|dialect| dialect.name == name).copied();
        named.ok_or_else(|| LinkError::unknown("dialect", name, &Dialect::names()))
    }

    /// The one that stands in examples.
    pub fn example() -> &'static Dialect {
        ALL[0]
    }

    /// The names of all.
    pub fn names() -> Vec<&'static str> {
        ALL.iter().map(|dialect| dialect.name).collect()
    }
}

impl PartialEq for Dialect {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Dialect {}

impl fmt::Debug for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// What a URL sets for its dialect: names of [`Dialect::settings`], and texts that the dialect reads.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Settings(Vec<(String, String)>);

impl Settings {
    pub(crate) fn new(set: Vec<(String, String)>) -> Self {
        Settings(set)
    }

    /// What is set by a name.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.0.iter().find(|(set, _)| set == name).map(|(_, value)| value.as_str())
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two bytes are a message.
    const PAIRS: Framing = Framing {
        longest: 2,
        first: |bytes| (bytes.len() >= 2).then_some(2),
        end: &[],
        is_message: |bytes| bytes.len() == 2,
    };

    #[test]
    fn bytes_are_cut_into_messages_and_nothing_is_left_out() {
        assert_eq!(PAIRS.messages(b"aabbc").collect::<Vec<_>>(), [&b"aa"[..], b"bb", b"c"]);
        assert_eq!(PAIRS.messages(b"").count(), 0);
        let nothing = Framing { first: |_| Some(0), ..PAIRS };
        assert_eq!(nothing.messages(b"abc").count(), 3, "a message of no bytes would never end");
    }

    #[test]
    fn names_are_told_apart() {
        let mut names = Dialect::names();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ALL.len());
        assert!(ALL.iter().all(|dialect| Dialect::named(dialect.name) == Ok(dialect)));
    }
}
