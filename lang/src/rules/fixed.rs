//! What the places and lengths of a mission are where they are made of constants: the values of `let`, of what is set once, of lists
//! that are gone through, of parameters by the calls, of functions by their arguments, of each way of an `if`. A name that a
//! condition asks about has none here, for what is known of it there is not known here.

use crate::hir::{
    Activity, Block, Builtin, Decl, Expr, ExprKind, FnId, Hir, RowPlan, Stmt, StmtKind, VarId, VarKind,
    activity_children, block_children, children,
};
use crate::source::Span;
use crate::types::{Type, TypeTable};
use albacore_geometry::{Area, Geodetic, Heading, Line, Point, Rows, TangentFrame, Vector, farthest_corner};
use std::collections::{BTreeMap, BTreeSet};

/// A name stands for so many values at most; further ones are not looked at.
const VALUES_MAX: usize = 64;

/// Functions are gone into so many times at most: each may call others twice.
const CALLS_MAX: usize = 1_000;

/// What a value is made of is followed so deep at most, through names and functions: any stack holds that.
const DEPTH_MAX: usize = 128;

/// What has variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Unit {
    Activity(usize),
    Function(FnId),
}

/// A name: its number, and what has it.
type Name = (Unit, VarId);

/// What an expression is made of constants to.
#[derive(Clone, Debug)]
enum Value {
    Number(f64),
    /// A point or a vector.
    Pair(Point),
    Line(Point, Point),
    Area(Area),
    /// What is known of a record's fields, by the places of their words.
    Record(Vec<(u32, Written)>),
}

/// A value, and where it is written.
type Written = (Span, Value);

/// What a name is set to, by the statement that sets it.
#[derive(Clone, Copy, Debug)]
enum Source<'h> {
    Value(&'h Expr),
    /// Each element of a list.
    Elements(&'h Expr),
    /// Each number from one to another.
    Numbers(&'h Expr, &'h Expr, bool),
    /// Each edge of an area.
    Edges(&'h Expr),
    /// Each row of an area, so far apart at most.
    Rows(&'h RowPlan),
}

/// The constants of a mission with all that it calls.
pub(super) struct Fixed<'h> {
    hir: &'h Hir,
    types: &'h TypeTable,
    frame: Option<TangentFrame>,
    /// What each name is set to, with what it is written in.
    set: BTreeMap<Name, Vec<(Unit, Source<'h>)>>,
    /// The names that conditions ask about.
    tested: BTreeSet<Name>,
    /// The names that are set to what nobody knows here.
    changed: BTreeSet<Name>,
    known: BTreeMap<Name, Vec<Written>>,
    /// The functions that were looked through.
    looked: BTreeSet<FnId>,
    calls_left: usize,
    depth: usize,
}

impl<'h> Fixed<'h> {
    /// Those of a mission, in the frame of its area.
    pub(super) fn of(hir: &'h Hir, types: &'h TypeTable, mission: usize, frame: Option<TangentFrame>) -> Self {
        let (set, tested, changed) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        let (known, looked, calls_left, depth) = (BTreeMap::new(), BTreeSet::new(), CALLS_MAX, 0);
        let mut fixed = Fixed { hir, types, frame, set, tested, changed, known, looked, calls_left, depth };
        let defaults = hir.activities[mission].defaults.iter().enumerate();
        for (param, default) in defaults.filter_map(|(param, default)| Some((param, default.as_ref()?))) {
            let mission = Unit::Activity(mission);
            fixed.sets((mission, param), mission, Source::Value(default));
        }
        for id in hir.called_from(mission) {
            fixed.look_through(id);
        }
        fixed
    }

    /// The activity whose variables an activity has.
    pub(super) fn unit(&self, id: usize) -> Unit {
        Unit::Activity(self.hir.activities[id].owner.unwrap_or(id))
    }

    fn sets(&mut self, name: Name, unit: Unit, source: Source<'h>) {
        self.set.entry(name).or_default().push((unit, source));
    }

    fn kind(&self, (unit, var): Name) -> VarKind {
        match unit {
            Unit::Activity(id) => self.hir.activities[id].vars[var].kind,
            Unit::Function(id) => self.hir.fns[id].vars[var].kind,
        }
    }

    fn look_through(&mut self, id: usize) {
        let (hir, unit) = (self.hir, self.unit(id));
        let activity: &'h Activity = &hir.activities[id];
        for decl in &activity.decls {
            match decl {
                Decl::Area(var, e) | Decl::Signal(var, e) | Decl::Memory(var, Some(e)) => {
                    self.sets((unit, *var), unit, Source::Value(e));
                }
                Decl::Memory(var, None) => self.changed.extend([(unit, *var)]),
                Decl::With(_) => {}
            }
        }
        for (called, args) in activity.calls_with_args() {
            if hir.activities[called].owner.is_none() {
                let name = |param| (Unit::Activity(called), param);
                args.iter().enumerate().for_each(|(param, e)| self.sets(name(param), unit, Source::Value(e)));
            }
        }
        activity.blocks().into_iter().for_each(|block| block.each(&mut |stmt| self.look_at(unit, stmt)));
        activity_children(activity, &mut |e| self.look_into(unit, e));
    }

    /// The statements and expressions of a block that no activity has for its own.
    fn look_through_block(&mut self, unit: Unit, block: &'h Block) {
        block.each(&mut |stmt| self.look_at(unit, stmt));
        block_children(block, &mut |e| self.look_into(unit, e));
    }

    fn look_at(&mut self, unit: Unit, stmt: &'h Stmt) {
        match &stmt.kind {
            StmtKind::Set(var, e) => self.sets((unit, *var), unit, Source::Value(e)),
            StmtKind::Insert(var, _) | StmtKind::Remove(var, _) | StmtKind::Clear(var) | StmtKind::Replace(var, ..) => {
                self.changed.insert((unit, *var));
            }
            StmtKind::ForEdges { var, area, .. } => self.sets((unit, *var), unit, Source::Edges(area)),
            StmtKind::ForRows { var, rows, .. } => self.sets((unit, *var), unit, Source::Rows(rows)),
            StmtKind::ForRange { var, first, last, inclusive, .. } => {
                self.sets((unit, *var), unit, Source::Numbers(first, last, *inclusive));
            }
            StmtKind::ForList { var, place, list, .. } => {
                self.changed.extend(place.map(|place| (unit, place)));
                self.sets((unit, *var), unit, Source::Elements(list));
            }
            StmtKind::If(e, ..) | StmtKind::Match(e, ..) => self.tests(unit, e),
            StmtKind::While { condition, bind, .. } => {
                self.tests(unit, condition);
                self.changed.extend(bind.map(|var| (unit, var)));
            }
            StmtKind::Timed(timed) => self.changed.extend(timed.result.map(|var| (unit, var))),
            _ => {}
        }
    }

    /// An expression may have blocks and conditions in it.
    fn look_into(&mut self, unit: Unit, e: &'h Expr) {
        match &e.kind {
            ExprKind::If(condition, a, b) => {
                self.tests(unit, condition);
                self.look_into(unit, condition);
                [a, b].into_iter().for_each(|block| self.look_through_block(unit, block));
            }
            ExprKind::Match(on, arms, otherwise) => {
                self.tests(unit, on);
                self.look_into(unit, on);
                let blocks = arms.iter().map(|(_, block)| block).chain(otherwise);
                blocks.for_each(|block| self.look_through_block(unit, block));
            }
            _ => children(e, &mut |child| self.look_into(unit, child)),
        }
    }

    fn tests(&mut self, unit: Unit, e: &Expr) {
        e.visit(&mut |e| {
            if let ExprKind::Var(var) = e.kind
                && e.ty != Type::Area
            {
                self.tested.insert((unit, var));
            }
            true
        });
    }

    /// The places that guidance is given, each with where it is written: points, and both ends of lines.
    pub(super) fn places(&mut self, unit: Unit, goal: &'h Expr) -> Vec<(Span, Point)> {
        let places = |(span, value)| match value {
            Value::Pair(p) => vec![(span, p)],
            Value::Line(start, end) => vec![(span, start), (span, end)],
            Value::Number(_) | Value::Area(_) | Value::Record(_) => Vec::new(),
        };
        if let ExprKind::Do(Builtin::Line, ends) = &goal.kind {
            return ends.iter().flat_map(|end| self.places(unit, end)).collect();
        }
        self.values(unit, goal).into_iter().flat_map(places).collect()
    }

    fn values(&mut self, unit: Unit, e: &'h Expr) -> Vec<Written> {
        if self.depth == DEPTH_MAX {
            return Vec::new();
        }
        self.depth += 1;
        let values = self.values_within(unit, e);
        self.depth -= 1;
        values
    }

    fn values_within(&mut self, unit: Unit, e: &'h Expr) -> Vec<Written> {
        if let Some(x) = e.range.constant() {
            return vec![(e.span, Value::Number(x))];
        }
        match &e.kind {
            ExprKind::Geodetic { latitude_deg, longitude_deg } => {
                let on_globe = Geodetic::from_degrees(*latitude_deg, *longitude_deg);
                self.frame.map(|frame| (e.span, Value::Pair(frame.to_point(on_globe)))).into_iter().collect()
            }
            ExprKind::Var(var) => self.named((unit, *var)),
            ExprKind::Present(inner) | ExprKind::Unwrap(inner) => self.values(unit, inner),
            ExprKind::Else(first, second) => {
                let known = self.values(unit, first);
                if known.is_empty() { self.values(unit, second) } else { known }
            }
            ExprKind::If(_, a, b) => self.either(unit, [a, b].into_iter()),
            ExprKind::Match(_, arms, otherwise) => {
                self.either(unit, arms.iter().map(|(_, block)| block).chain(otherwise))
            }
            ExprKind::Call(function, args) => self.result_of(unit, e.span, *function, args),
            ExprKind::Record(fields) => {
                let (mut known, mut at) = (Vec::new(), 0);
                for field in fields {
                    if let [one] = &self.values(unit, field)[..] {
                        known.push((at, one.clone()));
                    }
                    at = self.types.words(&field.ty).saturating_add(at);
                }
                vec![(e.span, Value::Record(known))]
            }
            ExprKind::Part(whole, at) => {
                let values = self.values(unit, whole).into_iter();
                values.filter_map(|written| part(written, *at, &e.ty)).collect()
            }
            ExprKind::Do(Builtin::At, operands) => {
                let [list, index] = operands.as_slice() else { return Vec::new() };
                let Some(index) = index.range.constant() else { return Vec::new() };
                self.elements(unit, list).get(index as usize).cloned().into_iter().collect()
            }
            // The corners of a polygon are a list of its own.
            ExprKind::Do(Builtin::Polygon, operands) => {
                let [Expr { kind: ExprKind::List(corners), .. }] = &operands[..] else { return Vec::new() };
                let corners = corners.iter().map(|corner| self.values(unit, corner)).collect();
                together(e.span, corners, |values| result(Builtin::Polygon, values))
            }
            ExprKind::Do(op, operands) => {
                let operands = operands.iter().map(|operand| self.values(unit, operand)).collect();
                together(e.span, operands, |values| result(*op, values))
            }
            _ => Vec::new(),
        }
    }

    /// The values of all ways that there are.
    fn either(&mut self, unit: Unit, ways: impl Iterator<Item = &'h Block>) -> Vec<Written> {
        let values = ways.filter_map(|way| way.value.as_deref());
        values.flat_map(|value| self.values(unit, value)).take(VALUES_MAX).collect()
    }

    /// What a function gives for these arguments: of one of them where that is written, of all else where it is called.
    fn result_of(&mut self, unit: Unit, call: Span, id: FnId, args: &'h [Expr]) -> Vec<Written> {
        let Some(left) = self.calls_left.checked_sub(1) else { return Vec::new() };
        self.calls_left = left;
        let args: Vec<_> = args.iter().map(|arg| self.values(unit, arg)).collect();
        let given: BTreeSet<Span> = args.iter().flatten().map(|(span, _)| *span).collect();
        let (of, hir) = (Unit::Function(id), self.hir);
        if self.looked.insert(id) {
            self.look_through_block(of, &hir.fns[id].body);
        }
        // No function calls itself: what was known of its names was for other arguments.
        self.known.retain(|(unit, _), _| *unit != of);
        self.known.extend(args.into_iter().enumerate().map(|(param, values)| ((of, param), values)));
        let values = hir.fns[id].body.value.as_deref().map_or(Vec::new(), |value| self.values(of, value));
        values.into_iter().map(|(span, value)| (if given.contains(&span) { span } else { call }, value)).collect()
    }

    /// The elements of a list.
    fn elements(&mut self, unit: Unit, list: &'h Expr) -> Vec<Written> {
        match &list.kind {
            ExprKind::List(elements) => elements.iter().flat_map(|e| self.values(unit, e)).take(VALUES_MAX).collect(),
            ExprKind::Var(var) if !self.is_open((unit, *var)) => match self.set.get(&(unit, *var)).map(Vec::as_slice) {
                Some(&[(unit, Source::Value(e))]) if !matches!(e.kind, ExprKind::Var(_)) => self.elements(unit, e),
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }

    /// Whether a name may have a value that is written nowhere here, or one after the other.
    fn is_open(&self, name: Name) -> bool {
        let is_set_again = || self.set.get(&name).is_some_and(|sources| sources.len() > 1);
        self.tested.contains(&name)
            || self.changed.contains(&name)
            || matches!(self.kind(name), VarKind::Var | VarKind::Memory) && is_set_again()
    }

    fn values_of(&mut self, unit: Unit, source: Source<'h>) -> Vec<Written> {
        let lines = |written: Vec<Written>, of: &dyn Fn(&Area) -> Vec<Line>| {
            let lines = written.into_iter().flat_map(|(span, value)| {
                let lines = if let Value::Area(area) = value { of(&area) } else { Vec::new() };
                lines.into_iter().map(move |line| (span, Value::Line(line.start, line.end)))
            });
            lines.collect()
        };
        match source {
            Source::Value(e) => self.values(unit, e),
            Source::Elements(list) => self.elements(unit, list),
            Source::Numbers(first, last, inclusive) => {
                let ends = [first, last].map(|end| end.range.constant());
                let [Some(first_number), Some(last_number)] = ends else { return Vec::new() };
                let numbers = (0..VALUES_MAX).map(|n| first_number + n as f64);
                let numbers = numbers.take_while(|x| *x < last_number || inclusive && *x == last_number);
                numbers.map(|x| (first.span.to(last.span), Value::Number(x))).collect()
            }
            Source::Edges(area) => lines(self.values(unit, area), &|area| area.edges().map(|edge| edge.line).collect()),
            Source::Rows(RowPlan { area, step, along, .. }) => {
                let [(_, Value::Number(step))] = self.values(unit, step)[..] else { return Vec::new() };
                let along = match along.as_ref().map(|along| self.values(unit, along)) {
                    None => None,
                    Some(values) => {
                        let [(_, Value::Number(along))] = values[..] else { return Vec::new() };
                        Some(Heading::from_radians(along))
                    }
                };
                // Where they begin changes their order and their direction alone.
                let rows = |area: &Area| {
                    let across = Rows::across(area.edges(), step, along, area.center());
                    across.into_iter().flat_map(|rows| rows.rows(area.edges())).take(VALUES_MAX).collect()
                };
                lines(self.values(unit, area), &rows)
            }
        }
    }

    fn named(&mut self, name: Name) -> Vec<Written> {
        if self.is_open(name) {
            return Vec::new();
        }
        if let Some(known) = self.known.get(&name) {
            return known.clone();
        }
        // Whoever comes here again on the way asks for what is made of itself.
        self.known.insert(name, Vec::new());
        let mut values = Vec::new();
        for (unit, source) in self.set.get(&name).cloned().unwrap_or_default() {
            values.extend(self.values_of(unit, source));
            if values.len() > VALUES_MAX {
                break;
            }
        }
        values.truncate(VALUES_MAX);
        self.known.insert(name, values.clone());
        values
    }
}

/// What an operation gives for operands of which one may have several values: of two that have, nobody knows which go together.
fn together(span: Span, operands: Vec<Vec<Written>>, of: impl Fn(&[Value]) -> Option<Value>) -> Vec<Written> {
    let several: Vec<usize> = (0..operands.len()).filter(|&i| operands[i].len() > 1).collect();
    if several.len() > 1 || operands.iter().any(Vec::is_empty) {
        return Vec::new();
    }
    let varied = several.first().copied();
    let count = varied.map_or(1, |i| operands[i].len());
    let nth = |operand: &Vec<Written>, n: usize| operand[if operand.len() > 1 { n } else { 0 }].1.clone();
    (0..count)
        .filter_map(|n| {
            let values: Vec<Value> = operands.iter().map(|operand| nth(operand, n)).collect();
            Some((varied.map_or(span, |i| operands[i][n].0), of(&values)?))
        })
        .collect()
}

fn result(op: Builtin, operands: &[Value]) -> Option<Value> {
    use Value::{Area, Number, Pair};
    let vector = |p: &Point| Vector::new(p.north, p.east);
    let pair = |v: Vector| Pair(Point::new(v.north, v.east));
    Some(match (op, operands) {
        (Builtin::Pair, [Number(north), Number(east)]) => Pair(Point::new(*north, *east)),
        (Builtin::Heading, [angle @ Number(_)]) => angle.clone(),
        (Builtin::Neg, [Number(x)]) => Number(-x),
        (Builtin::Add | Builtin::AddInt, [Number(a), Number(b)]) => Number(a + b),
        (Builtin::Sub | Builtin::SubInt, [Number(a), Number(b)]) => Number(a - b),
        (Builtin::Mul | Builtin::MulInt, [Number(a), Number(b)]) => Number(a * b),
        (Builtin::AddVector, [Pair(a), Pair(b)]) => pair(vector(a) + vector(b)),
        (Builtin::SubVector, [Pair(a), Pair(b)]) => pair(vector(a) - vector(b)),
        (Builtin::Scale, [Pair(v), Number(by)]) => pair(*by * vector(v)),
        (Builtin::Toward, [Number(length), Number(heading)]) => pair(*length * Heading::from_radians(*heading).unit()),
        (Builtin::Line, [Pair(start), Pair(end)]) => Value::Line(*start, *end),
        (Builtin::Rectangle, [Pair(center), Number(along), Number(length), Number(width)]) => {
            Area(albacore_geometry::Area::rectangle(*center, Heading::from_radians(*along), *length, *width))
        }
        (Builtin::Polygon, corners) => {
            let corner = |value: &Value| if let Pair(p) = value { Some(*p) } else { None };
            Area(albacore_geometry::Area::polygon(&corners.iter().map(corner).collect::<Option<Vec<Point>>>()?).ok()?)
        }
        (Builtin::Center, [Area(area)]) => Pair(area.center()),
        (Builtin::Corner, [Area(area), Number(heading), near @ ..]) => {
            let near = match near {
                [Pair(near)] => *near,
                _ => area.center(),
            };
            Pair(farthest_corner(area.corners(), Heading::from_radians(*heading), near))
        }
        (Builtin::Scattered, [Area(area), Number(index), seed @ ..]) => {
            let seed = if let [Number(seed)] = seed { *seed } else { 0.0 };
            Pair(albacore_geometry::scattered(area.edges(), *index, seed))
        }
        _ => return None,
    })
}

/// A part of a value, by the place of its words.
fn part((span, whole): Written, at: u32, ty: &Type) -> Option<Written> {
    let value = match (whole, at, ty) {
        // A field is written where it is.
        (Value::Record(fields), ..) => {
            return fields.into_iter().find(|(place, _)| *place == at).map(|(_, field)| field);
        }
        // The line of an edge.
        (line @ Value::Line(..), 0, Type::Line) => line,
        (Value::Line(start, _), 0, Type::Point) => Value::Pair(start),
        (Value::Line(_, end), 2, Type::Point) => Value::Pair(end),
        (Value::Pair(p), 0, Type::Quantity(_)) => Value::Number(p.north),
        (Value::Pair(p), 1, Type::Quantity(_)) => Value::Number(p.east),
        _ => return None,
    };
    Some((span, value))
}
