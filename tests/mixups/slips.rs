//! Mix-ups of what takes more than one word: each reads some words, and says what somebody might have written in their place.
//!
//! In the words that are read `$n` and `$m` are numbers, `$t` and `$u` texts, `$d` and `$e` dates, and `$` with any other letter is a name.

use super::mutate::{Edit, Kind, Text};

/// What is read, and what stands there then.
type Slip = (&'static str, &'static str);

const SLIPS: [(Kind, &[Slip]); 14] = [
    (
        Kind::OtherBehavior,
        &[
            ("worth : smell", "worth: settle"),
            ("worth : smell", "worth: rest"),
            ("at_each : look_round", "at_each: smell"),
            ("at_each : look_round", "at_each: waited"),
            ("at_each : look_round", "at_each: look_round(stations)"),
            ("bottle , smell", "smell, bottle"),
            ("worth ( stop . at , 10 s )", "worth(10 s, stop.at)"),
            ("at_each ( stop )", "at_each(stop.at)"),
            ("at_each ( stop )", "at_each(stop, 10 s)"),
        ],
    ),
    (
        Kind::PayloadAction,
        &[
            ("ask $a . start ( )", "ask $a.begin()"),
            ("ask $a . fill ( )", "ask $a.filled()"),
            ("ask $a . stop ( )", "ask $a.stop(row)"),
            ("ask $a . $b ( )", "ask $ax.$b()"),
            ("ask $a . $b ( ) within $n s", "ask $a.$b()"),
            ("ask $a . $b ( ) within $n s", "ask $a.$b() for $n s"),
            ("ask $a . $b ( ) within $n s", "$a.$b() within $n s"),
            ("finish films . value", "finish films"),
            ("if $a . value", "if $a"),
            ("filled . end != completed", "filled.end != done"),
            ("filled . end != completed", "filled != completed"),
            ("$a ( ) -> Bool }", "$a() -> Int }"),
            ("times_asked ( \"camera.start\" )", "times_asked(\"camera.begin\")"),
        ],
    ),
    (
        Kind::Recorded,
        &[
            ("record temperature", "record temprature"),
            ("record battery , altitude", "record battery, reef"),
            ("record altitude , flow", "record altitude, flow.length"),
            ("record $a , $b at $n Hz", "record $a, $b at 50 Hz"),
            ("record $a , $b at $n Hz", "record $a, $b at $n s"),
            ("record $a , $b at $n Hz", "record $a, $b every 5 s"),
            ("record $a , $b at $n Hz", "record $a, $b"),
            ("times_recorded ( \"temperature\" )", "times_recorded(\"depth\")"),
        ],
    ),
    (
        Kind::MapCell,
        &[
            ("each : $n )", "each: $n m)"),
            ("map ( over : reef", "map(over: rim"),
            ("smelt [ position ] = max ( chemical", "smelt[position] = max(depth"),
            ("next [ source ] =", "next[share] ="),
            ("smelt [ position ] else 0", "smelt[heading] else 0"),
            ("smelt [ position ] else 0", "smelt[position]"),
            ("maps . peak ( smelt )", "maps.peak(position)"),
            ("maps . total ( smelt )", "maps.decayed(smelt, 3 m, 1 h)"),
            ("maps . shares ( next )", "maps.share(next)"),
            ("Map [ Ratio ; $n ] =", "Map[Ratio; 90000] ="),
            ("Map [ Ratio ; $n ] =", "Map[Ratio] ="),
            ("Map [ Ratio ; $n ] =", "Map[Length; $n] ="),
        ],
    ),
    (
        Kind::Corners,
        &[
            ("polygon ( [ point ( 60 m , -", "polygon([north, point(60 m, -"),
            (", point ( - 50 m , 60 m ) ] )", "])"),
            (", point ( - 50 m , 60 m ) ] )", ", 60 m])"),
            ("polygon ( rim )", "rim"),
            ("polygon ( rim )", "polygon(stations)"),
            ("polygon ( outline )", "outline"),
            ("Area ? = polygon", "Area = polygon"),
            ("point ( - 60 m , - 40 m ) ]", "vector(-60 m, -40 m)]"),
        ],
    ),
    (
        Kind::DateForDuration,
        &[
            ("utc > $d", "elapsed > $d"),
            ("elapsed > $n min", "utc > $n min"),
            ("after 9 min", "after 2026-08-14T06:00Z"),
            ("since : utc", "since: elapsed"),
            ("since : $d", "since: 6 h"),
            ("flood : $d", "flood: 7.5 h"),
            ("date ( $d", "date(6 h"),
            ("utc + trip", "elapsed + trip"),
            ("moment - tide . flood", "tide.flood + moment"),
            ("now - station . since", "now"),
            ("utc fresh $n s", "utc fresh 2026-08-14T06:00Z"),
            ("\"at\" ) > $d", "\"at\") > 10 min"),
        ],
    ),
    (
        Kind::Rhythm,
        &[
            ("every $n min then", "every $n m then"),
            ("every $n min then", "every smelt then"),
            ("every $n min then", "$n min then"),
            ("every $n s {", "every $n {"),
            ("every $n s {", "every 2 Hz {"),
            ("every $n s {", "becomes every $n s {"),
            ("every one_tick", "every north"),
            ("after 9 min", "every 9 min for 3 s"),
        ],
    ),
    (
        Kind::Derived,
        &[
            ("= watch_over with", "= watch_ovr with"),
            ("= watch_over with", "= tour with"),
            ("roam -> fix on every 20", "roam -> fixx on every 20"),
            ("roam -> fix on every 20", "rom -> fix on every 20"),
            ("memory best : Point ? = position", "memory best: Depth? = depth"),
            ("= still_water with", "= stil_water with"),
            ("= reef_in_spring with", "= watch_over with"),
            ("usbl ( rate : 1 Hz , noise", "usbl(rate: 1 Hz, noises"),
            ("0 cm / s .. 20 cm / s ) = reef_in_spring", "0 cm/s..50 cm/s) = reef_in_spring"),
            ("0 cm/s .. 20 cm/s ) = reef_in_spring", "0 cm/s..50 cm/s) = reef_in_spring"),
            ("sounder ( noise : 5 cm", "sounder(noise: 5 deg"),
        ],
    ),
    (
        Kind::WithField,
        &[
            ("with ( visits : region . visits + 1", "with (visit: region.visits + 1"),
            ("with ( visits : region . visits + 1", "with (visits: region.area"),
            ("with ( best : chemical . peak", "with (best: position"),
            ("with ( at : position , since", "with (place: position, since"),
            ("with ( at : position , since", "with (at: heading, since"),
            ("with ( at : position , since : utc )", "with (position, utc)"),
            ("latest with (", "smelt with ("),
        ],
    ),
    (
        Kind::Reported,
        &[
            ("sum : sum , bottles", "sum: sum, sum"),
            ("number : n , best", "number: n, number"),
            ("reported ( \"bottle\" , \"level\" ) < $n m", "reported(\"bottle\", \"level\") < $n s"),
            ("reported ( \"bottle\" , \"level\" )", "reported(\"bottle\", \"depth\")"),
            ("reported ( \"sample\" , \"depth\" )", "reported(\"sampel\", \"depth\")"),
            ("distance ( reported ( \"bottle\" ) , point ( 30 m , 40 m ) )", "reported(\"bottle\")"),
            ("contains ( last_reported ( \"map\" , \"most\" ) )", "contains(last_reported(\"map\"))"),
            ("reported_at ( \"tour\" )", "reported(\"tour\")"),
            ("\"outcome\" ) == completed", "\"outcome\") == look"),
            ("times_reported ( $t ) == $n and", "times_reported($t) == $n m and"),
            ("truth . nearest_source", "truth.source"),
            ("expect while $a :", "expect while $as:"),
            ("\"visits\" ) <= $n", "\"visits\") <= 5 m"),
        ],
    ),
    (
        Kind::Exchanged,
        &[
            ("flow ( $n $a / $b toward $m deg", "flow($m deg toward $n $a/$b"),
            ("flow ( $n $a toward $m deg", "flow($m deg toward $n $a"),
            ("flow ( speed toward $m deg", "flow(speed, $m deg"),
            ("dubins row . start , row . heading", "dubins row.heading, row.start"),
            ("18 degC , bottom : 9 degC , thermocline : $n m", "8 m, bottom: 9 degC, thermocline: 18 degC"),
            ("source ( $t , at : point", "source(at: $t, point"),
        ],
    ),
    (
        Kind::PeriodForRate,
        &[
            ("rate : $n Hz", "rate: $n s"),
            ("every : $n s", "every: $n Hz"),
            ("gain : Frequency = $n Hz", "gain: Frequency = $n s"),
            ("after : $n s", "after: $n Hz"),
        ],
    ),
    (
        Kind::VariantOfOther,
        &[
            ("task : look , since : 2026-08-14T06:00Z", "task: completed, since: 2026-08-14T06:00Z"),
            ("task : pass", "task: \"pass\""),
            ("task : go_down", "task: go_dwn"),
            ("look_round { loiter", "lok_round { loiter"),
        ],
    ),
    (
        Kind::AbsentForgotten,
        &[
            ("else 100 %", ""),
            ("else op . center", ""),
            ("if next { leg = next } else {", "leg = next; if next { } else {"),
            ("for place in near", "for place in near.first"),
        ],
    ),
];

/// Whether a word of a script is what a word of a slip reads.
fn reads(pattern: &str, word: &str) -> bool {
    let is_date = word.contains('T') && word.ends_with('Z');
    match pattern.strip_prefix('$') {
        None => pattern == word,
        Some("d" | "e") => is_date,
        Some("n" | "m") => word.starts_with(|c: char| c.is_ascii_digit()) && !is_date,
        Some("t" | "u") => word.starts_with('"'),
        Some(_) => word.starts_with(char::is_alphabetic),
    }
}

/// All places of the slips of a kind.
pub fn edits(kind: Kind, number: usize, text: &Text) -> Vec<Edit> {
    let mut edits = Vec::new();
    for &(from, slip) in SLIPS.iter().filter(|(of, _)| *of == kind).flat_map(|(_, slips)| *slips) {
        let pattern: Vec<&str> = from.split(' ').collect();
        for first in 0..text.len() {
            let last = first + pattern.len() - 1;
            let is_here = last < text.len()
                && text.line(first) == text.line(last)
                && pattern.iter().enumerate().all(|(i, word)| reads(word, text.word(first + i)));
            if is_here {
                let read = pattern.iter().enumerate().filter(|(_, word)| word.starts_with('$'));
                let to = read.fold(slip.to_string(), |to, (i, name)| to.replace(name, text.word(first + i)));
                let edit = text.edit(number, first, last, &to);
                edits.push(edit.of(slip));
            }
        }
    }
    edits
}
