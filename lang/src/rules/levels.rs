//! States in which conditions hold for as long as nothing changes: what keeps two rules at work at once.

use super::overlaps::{Side, compared, contrary};
use crate::hir::{Activity, Builtin, Decl, Expr, ExprKind, Interval, VarId, children, same_condition};
use crate::types::Type;
use albacore_arithmetic::{Operation, Ticks};
use std::collections::{BTreeMap, BTreeSet};

/// The most parts of a condition that are looked at, and the most ways in which it can hold: what is larger counts as unknown.
const MOST: usize = 64;
/// Rings of more rules are not looked for: whoever reads of one has to find its rules.
pub const RING_MAX: usize = 8;

/// The signals of a strategy, by their variables.
pub struct Signals<'h>(BTreeMap<VarId, &'h Expr>);

/// What must hold at once for a condition to hold, and goes on to hold until something that it reads changes.
#[derive(Clone, Debug, Default)]
pub struct Level<'h> {
    parts: Vec<Part<'h>>,
    /// How much there is to compare.
    weight: usize,
    /// It holds where this many ticks have gone by since it held last: a rhythm goes on wherever the table is.
    ticks: usize,
}

/// One demand on the state.
#[derive(Clone, Debug)]
enum Part<'h> {
    /// A number lies here.
    Bound(&'h Expr, Interval),
    /// A condition of another form holds, or does not.
    Truth(&'h Expr, bool),
}

/// A condition that holds, or does not.
pub type Way<'h> = (&'h Expr, bool);

/// Two demands at once.
enum Beside<'h> {
    /// They are of different things.
    Other,
    /// They are one.
    Both(Part<'h>),
    /// No state has room for both.
    NoRoom,
}

impl<'h> Signals<'h> {
    /// Those that an activity declares.
    pub fn of(activity: &'h Activity) -> Self {
        let signal = |decl: &'h Decl| match decl {
            Decl::Signal(var, e) => Some((*var, e)),
            _ => None,
        };
        Signals(activity.decls.iter().filter_map(signal).collect())
    }

    /// The levels on which a condition can hold at the entry of a behavior, tick after tick: without those that wait for an
    /// edge, for a time or for the end of a body.
    pub fn levels(&self, condition: &'h Expr) -> Vec<Level<'h>> {
        self.ways(condition).into_iter().filter_map(|way| self.level(way, false)).collect()
    }

    /// What a way in which a condition holds demands of the moment, whatever it waited for. None where that is too much to say.
    pub fn moment(&self, way: Way<'h>) -> Option<Level<'h>> {
        self.level(way, true)
    }

    /// The same of each way in which a condition holds.
    pub fn moments(&self, condition: &'h Expr) -> Option<Vec<Level<'h>>> {
        let ways = self.ways(condition);
        if ways.is_empty() { None } else { ways.into_iter().map(|way| self.moment(way)).collect() }
    }

    /// What `or` joins, also behind the names of signals. None where that is too much.
    pub fn ways(&self, condition: &'h Expr) -> Vec<Way<'h>> {
        let mut ways = Vec::new();
        let mut ahead = vec![(condition, true)];
        for _ in 0..MOST {
            let Some((e, holds)) = ahead.pop() else { return ways };
            let e = self.meant(e);
            match &e.kind {
                ExprKind::Do(Builtin::Or, operands) if holds => ahead.extend(operands.iter().map(|e| (e, true))),
                ExprKind::Do(Builtin::And, operands) if !holds => ahead.extend(operands.iter().map(|e| (e, false))),
                ExprKind::Do(Builtin::Not, operands) => ahead.extend(operands.iter().map(|e| (e, !holds))),
                _ => ways.push((e, holds)),
            }
        }
        Vec::new()
    }

    /// The variables that an expression reads, those that its signals read among them.
    pub fn reads(&self, e: &'h Expr, read: &mut BTreeSet<VarId>) {
        self.walk(e, read, |_| true);
    }

    /// Looks at the parts of an expression, and of what its signals are, each signal once and without going down: they may be made of
    /// one another in a long chain. Ends where it is told to.
    fn walk(&self, e: &'h Expr, seen: &mut BTreeSet<VarId>, mut goes_on: impl FnMut(&'h Expr) -> bool) -> bool {
        let mut ahead = vec![e];
        while let Some(e) = ahead.pop() {
            if !goes_on(e) {
                return false;
            }
            if let ExprKind::Var(id) = &e.kind
                && seen.insert(*id)
            {
                ahead.extend(self.0.get(id));
            }
            children(e, &mut |child| ahead.push(child));
        }
        true
    }

    /// Whether what held when a behavior was suspended may hold when it goes on: no edge is in it, or it is that none comes. One that was
    /// done is done then.
    pub fn outlasts(&self, (e, holds): Way<'h>) -> bool {
        matches!(e.kind, ExprKind::Becomes(_)) && !holds || self.has_no_edge(e)
    }

    fn has_no_edge(&self, e: &'h Expr) -> bool {
        self.walk(e, &mut BTreeSet::new(), |e| match &e.kind {
            ExprKind::Becomes(_) => false,
            ExprKind::Every(time) => is_one_tick(time),
            _ => true,
        })
    }

    /// Whether what holds goes on to hold at the entry of a behavior, where times begin anew.
    fn is_level(&self, e: &'h Expr) -> bool {
        let is_untimed = |e: &Expr| {
            !matches!(e.kind, ExprKind::After(_) | ExprKind::Every(_) | ExprKind::HeldFor(..) | ExprKind::Done)
        };
        self.has_no_edge(e) && self.walk(e, &mut BTreeSet::new(), is_untimed)
    }

    /// What stands behind the name of a signal.
    fn meant(&self, mut e: &'h Expr) -> &'h Expr {
        while let ExprKind::Var(id) = &e.kind
            && let Some(signal) = self.0.get(id)
        {
            e = signal;
        }
        e
    }

    /// What a way demands; `at_once` of the moment in which it holds, or else for as long as nothing changes.
    fn level(&self, way: Way<'h>, at_once: bool) -> Option<Level<'h>> {
        let mut level = Level::default();
        let mut ahead = vec![way];
        let mut left = MOST;
        while let Some((e, holds)) = ahead.pop() {
            left = left.checked_sub(1)?;
            let e = self.meant(e);
            match &e.kind {
                ExprKind::Do(Builtin::And, operands) if holds => ahead.extend(operands.iter().map(|e| (e, true))),
                ExprKind::Do(Builtin::Or, operands) if !holds => ahead.extend(operands.iter().map(|e| (e, false))),
                ExprKind::Do(Builtin::Not, operands) => ahead.extend(operands.iter().map(|e| (e, !holds))),
                ExprKind::Number(truth) if (*truth != 0.0) == holds => {}
                ExprKind::Number(_) => return None,
                ExprKind::HeldFor(inner, _) | ExprKind::Becomes(inner) if at_once && holds => ahead.push((inner, true)),
                // One tick has passed since the entry whenever a rule is tried.
                ExprKind::After(time) | ExprKind::Every(time) if is_one_tick(time) && holds => {}
                ExprKind::Every(time) if holds && !at_once && ticks(time) <= RING_MAX as f64 => {
                    level.ticks = level.ticks.max(ticks(time) as usize);
                }
                ExprKind::After(time) if is_one_tick(time) => return None,
                ExprKind::HeldFor(inner, time) if is_one_tick(time) && holds => ahead.push((inner, true)),
                ExprKind::After(_)
                | ExprKind::Every(_)
                | ExprKind::Done
                | ExprKind::HeldFor(..)
                | ExprKind::Becomes(_)
                    if at_once => {}
                _ if !self.is_level(e) => return None,
                _ => level = level.with(&Part::of(e, holds))?,
            }
        }
        level.weight = level.parts.iter().map(|part| part.subject().parts()).sum();
        Some(level)
    }
}

impl<'h> Level<'h> {
    /// Both at once; `None` when no state has room for both.
    pub fn and(&self, other: &Level<'h>) -> Option<Self> {
        let both = other.parts.iter().try_fold(self.clone(), |level, part| level.with(part))?;
        Some(Level { weight: self.weight + other.weight, ticks: self.ticks.max(other.ticks), ..both })
    }

    /// Whether it holds again after so many ticks.
    pub fn holds_after(&self, ticks: usize) -> bool {
        self.ticks <= ticks
    }

    /// How much work it is at most to hold this beside another.
    pub fn work(&self, other: &Level<'h>) -> usize {
        1 + self.parts.len() * other.weight + other.parts.len() * self.weight
    }

    /// Whether this speaks of all that the other speaks of.
    pub fn covers(&self, other: &Level<'h>) -> bool {
        let speaks_of = |own: &Part, part: &Part| match (own, part) {
            (Part::Truth(a, true), Part::Truth(b, true)) if compares_the_same(a, b) => true,
            _ => same(own.subject(), part.subject()),
        };
        other.parts.iter().all(|part| self.parts.iter().any(|own| speaks_of(own, part)))
    }

    /// Whether the other holds whenever this does.
    pub fn implies(&self, other: &Level<'h>) -> bool {
        other.ticks == 0
            && other.parts.iter().all(|part| match part {
                Part::Bound(x, range) => {
                    let own = self.parts.iter().find_map(|own| match own {
                        Part::Bound(y, own) if same(x, y) => Some(*own),
                        _ => None,
                    });
                    range.covers(own.unwrap_or(x.range))
                }
                Part::Truth(x, holds) => self.parts.iter().any(|own| match own {
                    Part::Truth(y, true) if *holds && is_weaker(x, y) => true,
                    Part::Truth(y, other) => same(x, y) && holds == other,
                    Part::Bound(..) => false,
                }),
            })
    }

    /// With one more demand, if there is room for it.
    fn with(mut self, part: &Part<'h>) -> Option<Self> {
        for own in &mut self.parts {
            match own.beside(part) {
                Beside::NoRoom => return None,
                Beside::Both(both) => {
                    *own = both;
                    return Some(self);
                }
                Beside::Other => {}
            }
        }
        if let Part::Bound(x, range) = part {
            room(&x.ty, x.range, *range)?;
        }
        self.parts.push(part.clone());
        Some(self)
    }
}

impl<'h> Part<'h> {
    fn of(e: &'h Expr, holds: bool) -> Self {
        if let Some((x, side)) = compared(e) {
            let strict = matches!(e.kind, ExprKind::Do(Builtin::Lt, _));
            return Part::Bound(x, numbers(x, side, holds, strict));
        }
        match equated(e) {
            Some((x, value)) if x.ty == Type::Bool => Part::Truth(x, (value != 0.0) == holds),
            Some((x, value)) if holds => Part::Bound(x, Interval::exactly(value)),
            _ => Part::Truth(e, holds),
        }
    }

    fn beside(&self, other: &Part<'h>) -> Beside<'h> {
        match (self, other) {
            (Part::Bound(x, a), Part::Bound(y, b)) if same(x, y) => match room(&x.ty, *a, *b) {
                Some(both) => Beside::Both(Part::Bound(x, both)),
                None => Beside::NoRoom,
            },
            (Part::Truth(x, a), Part::Truth(y, b)) if same(x, y) && a == b => Beside::Both(self.clone()),
            (Part::Truth(x, _), Part::Truth(y, _)) if same(x, y) => Beside::NoRoom,
            (Part::Truth(x, true), Part::Truth(y, true)) if contrary(x, y) || contrary(y, x) || meet(x, y) => {
                Beside::NoRoom
            }
            // `mode == m` beside `mode != m`.
            (Part::Truth(e, false), Part::Bound(x, at)) | (Part::Bound(x, at), Part::Truth(e, false))
                if equated(e).is_some_and(|(y, value)| same(x, y) && at.constant() == Some(value)) =>
            {
                Beside::NoRoom
            }
            _ => Beside::Other,
        }
    }

    fn subject(&self) -> &'h Expr {
        match self {
            Part::Bound(x, _) => x,
            Part::Truth(e, _) => equated(e).map_or(e, |(x, _)| x),
        }
    }
}

/// The numbers that a comparison leaves where it holds, or where it does not.
fn numbers(x: &Expr, side: Side, holds: bool, strict: bool) -> Interval {
    let (Side::Below(end) | Side::Above(end)) = side;
    let is_most = matches!(side, Side::Below(_)) == holds;
    // The last whole number on this side of the end.
    let end = match (x.ty == Type::Int, is_most, strict == holds) {
        (false, _, _) => end,
        (true, true, false) => end.floor(),
        (true, true, true) => end.ceil() - 1.0,
        (true, false, false) => end.ceil(),
        (true, false, true) => end.floor() + 1.0,
    };
    if is_most { Interval::at_most(end) } else { Interval::at_least(end) }
}

/// What two ranges share, if that is more than an end at which they touch. Whole numbers and what is asked to be one value stay there.
fn room(ty: &Type, a: Interval, b: Interval) -> Option<Interval> {
    let (low, high) = (a.low.max(b.low), a.high.min(b.high));
    let stays = *ty == Type::Int || a.constant().is_some() || b.constant().is_some();
    (low < high || low == high && stays).then(|| Interval::new(low, high))
}

/// What is asked to be one value, and that value.
fn equated(e: &Expr) -> Option<(&Expr, f64)> {
    let ExprKind::Do(Builtin::Eq, operands) = &e.kind else { return None };
    let (a, b) = (&operands[0], &operands[1]);
    // A variant of an enum is a number without a range.
    let constant = |e: &Expr| match e.kind {
        ExprKind::Number(value) => Some(value),
        _ => e.range.constant(),
    };
    match (constant(a), constant(b)) {
        (None, Some(value)) => Some((a, value)),
        (Some(value), None) => Some((b, value)),
        _ => None,
    }
}

/// The sides of a comparison, and whether they may be equal.
fn sides(e: &Expr) -> Option<(&[Expr], bool)> {
    match &e.kind {
        ExprKind::Do(Builtin::Lt, sides) => Some((sides, false)),
        ExprKind::Do(Builtin::Le, sides) => Some((sides, true)),
        _ => None,
    }
}

/// Whether two comparisons are of the same two values, whichever way.
fn compares_the_same(a: &Expr, b: &Expr) -> bool {
    let (Some((xs, _)), Some((ys, _))) = (sides(a), sides(b)) else { return false };
    same(&xs[0], &ys[0]) && same(&xs[1], &ys[1]) || same(&xs[0], &ys[1]) && same(&xs[1], &ys[0])
}

/// Whether the first is `x <= y` where the second is `x < y`.
fn is_weaker(a: &Expr, b: &Expr) -> bool {
    match (sides(a), sides(b)) {
        (Some((xs, true)), Some((ys, false))) => same(&xs[0], &ys[0]) && same(&xs[1], &ys[1]),
        _ => false,
    }
}

/// Whether two comparisons leave a number that is not whole the one value at which both sides are equal.
fn meet(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Do(Builtin::Le, xs), ExprKind::Do(Builtin::Le, ys)) => {
            xs[0].ty != Type::Int && same(&xs[0], &ys[1]) && same(&xs[1], &ys[0])
        }
        _ => false,
    }
}

/// Whether a time is over after a tick.
fn is_one_tick(time: &Expr) -> bool {
    ticks(time) <= 1.0
}

/// After how many ticks a time is surely over.
fn ticks(time: &Expr) -> f64 {
    Ticks::rule([time.range]).high
}

fn same(a: &Expr, b: &Expr) -> bool {
    same_condition(a, b) && same_condition(b, a)
}
