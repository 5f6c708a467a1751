//! Statements that take time tell when they begin: what they are told as, and how far the loops around them are.

use super::Lowering;
use crate::hir::{Action, Block, Timed};
use crate::source::Span;
use albacore_program::{Compute, Loop, Op, Rounds, Slot, Statement, StatementPart};

/// The most characters of a statement that are told.
const TOLD_MAX: usize = 40;
/// How it is done, and how long it may take, are not told: what stands behind these words.
const MANNER: [&str; 2] = ["at", "within"];
/// When it ends is told: what stands behind these.
const END: [&str; 2] = ["for", "until"];
/// What a round is called of a loop that walks nothing with a name.
const ROUND: &str = "round";

/// A loop around what is being lowered, and the variable that walks it.
#[derive(Clone)]
pub(super) struct Around {
    told: Loop,
    var: Option<String>,
}

impl<'a> Lowering<'a> {
    /// The body of a loop that walks something.
    pub(super) fn walking(&mut self, var: usize, rounds: Rounds, body: &Block) {
        let var = self.vars.get(var).map(|var| var.name.clone());
        let name = match (rounds, &var) {
            (Rounds::Behind(..), Some(var)) => var,
            _ => ROUND,
        };
        let told = Loop { name: name.to_string(), rounds };
        self.around(Around { told, var }, body);
    }

    /// The body of a loop whose rounds nothing else counts; only what takes time needs their count.
    pub(super) fn going_round(&mut self, begun: Option<Slot>, body: &Block) {
        let Some(begun) = begun else { return self.body(body) };
        self.count_up(begun);
        let told = Loop { name: ROUND.to_string(), rounds: Rounds::Begun(begun) };
        self.around(Around { told, var: None }, body);
    }

    /// Where the rounds of such a loop are counted, from its beginning.
    pub(super) fn rounds_begun(&mut self, body: &Block) -> Option<Slot> {
        let begun = (body.beginnings() > 0 && !self.frame.told_by_name).then(|| self.lasting(1))?;
        self.emit(Compute::Const { to: begun, value: 0.0 });
        Some(begun)
    }

    fn around(&mut self, around: Around, body: &Block) {
        self.frame.loops.push(around);
        self.body(body);
        self.frame.loops.pop();
    }

    /// A statement tells that it begins. What is called, asked or taken over tells that itself: of a call in a loop the rounds are told.
    pub(super) fn tell(&mut self, timed: &Timed, span: Span) {
        let is_call = matches!(timed.action, Action::Call(..));
        let tells_itself = matches!(timed.action, Action::Ask(..) | Action::Override(_));
        if tells_itself || self.frame.told_by_name || is_call && self.frame.loops.is_empty() {
            return;
        }
        let text = if is_call { String::new() } else { shortened(self.sources.text(span), timed.result.is_some()) };
        let (place, loops) = (self.sources.place(span), self.frame.loops.iter().map(|l| l.told.clone()).collect());
        self.program.statements.push(Statement { parts: parts(&text, &self.frame.loops), place, loops, is_call });
        let statement = self.program.statements.len() as u32 - 1;
        self.emit(Op::Tell { statement });
    }
}

/// A statement on one line, without comments and without the name that its outcome gets; what is too long is cut between two words.
fn shortened(text: &str, is_bound: bool) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut is_told = true;
    let words = lines.flat_map(str::split_whitespace).filter(|word| {
        is_told = !MANNER.contains(word) && (is_told || END.contains(word));
        is_told
    });
    let words: Vec<&str> = words.collect();
    let line = words.join(" ");
    let line = if is_bound { line.split_once("= ").map_or(line.as_str(), |(_, said)| said) } else { &line };
    let Some((most, _)) = line.char_indices().nth(TOLD_MAX) else { return line.to_string() };
    let line = &line[..most];
    format!("{} …", line.rsplit_once(' ').map_or(line, |(whole, _)| whole))
}

/// A statement with the rounds of the loops around it: in the place of a variable behind the verb, `follow row`, else before it.
fn parts(text: &str, loops: &[Around]) -> Vec<StatementPart> {
    let (mut said, mut inside) = (Vec::new(), None);
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let (mut rest, mut before) = (text, String::new());
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c| is_of_name(c) != is_of_name(first)).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        rest = after;
        let is_name_of_part = before.ends_with('.') || after.starts_with(':');
        let is_alone = said.is_empty()
            && before.strip_suffix(' ').is_some_and(|verb| verb.chars().all(is_of_name))
            && !after.trim_start().starts_with(|c: char| !is_of_name(c) && c != ',');
        let walks = |around: &Around| around.var.as_deref() == Some(word) && !is_name_of_part;
        let part = loops.iter().rposition(walks).and_then(|at| match loops[at].told.rounds {
            Rounds::Range { .. } => Some(StatementPart::Count(at as u32)),
            _ => is_alone.then(|| StatementPart::Round(*inside.insert(at) as u32)),
        });
        match part {
            Some(part) => said.extend([StatementPart::Text(std::mem::take(&mut before)), part]),
            None => before.push_str(word),
        }
    }
    said.push(StatementPart::Text(before));
    let mut ahead: Vec<StatementPart> = Vec::new();
    for at in (0..loops.len()).filter(|at| inside != Some(*at)) {
        let comma = if ahead.is_empty() { "" } else { ", " };
        ahead.extend([StatementPart::Text(comma.to_string()), StatementPart::Round(at as u32)]);
    }
    if !ahead.is_empty() && !text.is_empty() {
        ahead.push(StatementPart::Text(": ".to_string()));
    }
    ahead.extend(said);
    ahead.retain(|part| !matches!(part, StatementPart::Text(text) if text.is_empty()));
    ahead
}

#[cfg(test)]
mod tests {
    use super::*;
    use albacore_program::ROUND_WORDS;

    fn told(text: &str, loops: &[(&str, Rounds)], words: &[[f64; ROUND_WORDS]]) -> String {
        let around = |(name, rounds): &(&str, Rounds)| {
            let var = (*name != ROUND).then(|| name.to_string());
            let name = if matches!(rounds, Rounds::Behind(..)) { name } else { ROUND };
            Around { told: Loop { name: name.to_string(), rounds: *rounds }, var }
        };
        let loops: Vec<Around> = loops.iter().map(around).collect();
        let parts = parts(text, &loops);
        let loops = loops.into_iter().map(|around| around.told).collect();
        Statement { parts, place: String::new(), loops, is_call: text.is_empty() }.told(words.as_flattened())
    }

    #[test]
    fn rounds_stand_where_a_person_says_them() {
        let (row, round) = (Rounds::Behind(0, 0), Rounds::Begun(0));
        let range = Rounds::Range { at: 0, first: 0, end: 0, inclusive: false };
        let (seventh, third, second) = ([7.0, 12.0, 0.0], [3.0, 0.0, 0.0], [3.0, 5.0, 2.0]);
        assert_eq!(told("follow row", &[("row", row)], &[seventh]), "follow row 7 of 12");
        assert_eq!(told("steer row + lean", &[("row", row)], &[seventh]), "row 7 of 12: steer row + lean");
        assert_eq!(told("wait for row", &[("row", row)], &[seventh]), "row 7 of 12: wait for row");
        assert_eq!(told("goto row, radius: 5 m", &[("row", row)], &[seventh]), "goto row 7 of 12, radius: 5 m");
        assert_eq!(told("goto row.start", &[("row", row)], &[seventh]), "row 7 of 12: goto row.start");
        assert_eq!(told("wait for 10 s", &[(ROUND, round)], &[third]), "round 3: wait for 10 s");
        assert_eq!(told("goto ways[i].at", &[("i", range)], &[second]), "round 3 of 5: goto ways[2].at");
        assert_eq!(told("goto w.i", &[("i", range)], &[second]), "round 3 of 5: goto w.i");
        assert_eq!(told("", &[(ROUND, round), ("row", row)], &[third, seventh]), "round 3, row 7 of 12");
        assert_eq!(
            told("follow row", &[(ROUND, round), ("row", row)], &[third, seventh]),
            "round 3: follow row 7 of 12"
        );
    }

    #[test]
    fn statements_are_told_on_one_short_line() {
        assert_eq!(shortened("wait // here\n    for 5 min at depth 3 m", false), "wait for 5 min");
        assert_eq!(shortened("let there = goto stop.at\n within 5 min", true), "goto stop.at");
        assert_eq!(shortened("hold at depth 0 m until x < 3 m within 5 min", false), "hold until x < 3 m");
        assert_eq!(
            shortened("goto op.center until salinity > 35 or is_deep", false),
            "goto op.center until salinity > 35 or …"
        );
    }
}
