//! What the places and lengths of a mission are where they are made of constants: the values of `let`, of lists that are gone
//! through, of parameters by the calls. A name that a condition asks about has none here, for what is known of it there is not
//! known here.

use super::places;
use crate::hir::{Activity, Builtin, Expr, ExprKind, Hir, StmtKind, VarId, VarKind, children};
use crate::source::Span;
use crate::types::Type;
use albacore_geometry::{Area, Geodetic, Heading, Line, Point, TangentFrame, Vector, farthest_corner, row};
use std::collections::{BTreeMap, BTreeSet};

/// A name stands for so many values at most; further ones are not looked at.
const VALUES_MAX: usize = 64;

/// A name: its number, and the activity whose variables it is one of.
type Name = (usize, VarId);

/// What an expression is made of constants to.
#[derive(Clone, Debug)]
enum Value {
    Number(f64),
    /// A point or a vector.
    Pair(Point),
    Line(Point, Point),
    Area(Area),
}

/// A value, and where it is written.
type Written = (Span, Value);

/// What a name is set to, by the statement that sets it.
#[derive(Clone, Copy, Debug)]
enum Source<'h> {
    Value(&'h Expr),
    /// Each edge of an area.
    Edges(&'h Expr),
    /// Each row of an area, so far apart at most.
    Rows(&'h Expr, &'h Expr),
}

/// The constants of a mission with all that it calls.
pub(super) struct Fixed<'h> {
    hir: &'h Hir,
    frame: Option<TangentFrame>,
    /// What each name is set to, with the activity in which that is written.
    set: BTreeMap<Name, Vec<(usize, Source<'h>)>>,
    /// The names that conditions ask about.
    tested: BTreeSet<Name>,
    known: BTreeMap<Name, Vec<Written>>,
}

impl<'h> Fixed<'h> {
    /// Those of a mission, in the frame of its area.
    pub(super) fn of(hir: &'h Hir, mission: usize, frame: Option<TangentFrame>) -> Self {
        let (set, tested, known) = (BTreeMap::new(), BTreeSet::new(), BTreeMap::new());
        let mut fixed = Fixed { hir, frame, set, tested, known };
        let defaults = hir.activities[mission].defaults.iter().enumerate();
        for (param, default) in defaults.filter_map(|(param, default)| Some((param, default.as_ref()?))) {
            fixed.sets((mission, param), mission, Source::Value(default));
        }
        for id in hir.called_from(mission) {
            fixed.look_through(id);
        }
        fixed
    }

    /// The activity whose variables an activity has.
    pub(super) fn unit(&self, id: usize) -> usize {
        self.hir.activities[id].owner.unwrap_or(id)
    }

    fn sets(&mut self, name: Name, unit: usize, source: Source<'h>) {
        self.set.entry(name).or_default().push((unit, source));
    }

    fn look_through(&mut self, id: usize) {
        let (hir, unit) = (self.hir, self.unit(id));
        let activity: &'h Activity = &hir.activities[id];
        for decl in &activity.decls {
            if let crate::hir::Decl::Area(var, e) = decl {
                self.sets((unit, *var), unit, Source::Value(e));
            }
        }
        for (called, args) in activity.calls_with_args() {
            if hir.activities[called].owner.is_none() {
                args.iter().enumerate().for_each(|(param, e)| self.sets((called, param), unit, Source::Value(e)));
            }
        }
        for block in activity.blocks() {
            block.each(&mut |stmt| match &stmt.kind {
                StmtKind::Set(var, e) if hir.activities[unit].vars[*var].kind == VarKind::Let => {
                    self.sets((unit, *var), unit, Source::Value(e));
                }
                StmtKind::ForEdges { var, area, .. } => self.sets((unit, *var), unit, Source::Edges(area)),
                StmtKind::ForRows { var, area, step, .. } => self.sets((unit, *var), unit, Source::Rows(area, step)),
                StmtKind::ForList { var, list: Expr { kind: ExprKind::List(elements), .. }, .. } => {
                    elements.iter().for_each(|e| self.sets((unit, *var), unit, Source::Value(e)));
                }
                StmtKind::If(e, ..) | StmtKind::Match(e, ..) | StmtKind::While { condition: e, .. } => {
                    self.tests(unit, e);
                }
                _ => {}
            });
        }
    }

    fn tests(&mut self, unit: usize, e: &Expr) {
        if let ExprKind::Var(var) = e.kind
            && e.ty != Type::Area
        {
            self.tested.insert((unit, var));
        }
        children(e, &mut |child| self.tests(unit, child));
    }

    /// The places that guidance is given, each with where it is written: points, and both ends of lines.
    pub(super) fn places(&mut self, unit: usize, goal: &Expr) -> Vec<(Span, Point)> {
        let places = |(span, value)| match value {
            Value::Pair(p) => vec![(span, p)],
            Value::Line(start, end) => vec![(span, start), (span, end)],
            Value::Number(_) | Value::Area(_) => Vec::new(),
        };
        if let ExprKind::Do(Builtin::Line, ends) = &goal.kind {
            return ends.iter().flat_map(|end| self.places(unit, end)).collect();
        }
        self.values(unit, goal).into_iter().flat_map(places).collect()
    }

    fn values(&mut self, unit: usize, e: &Expr) -> Vec<Written> {
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
            ExprKind::Do(Builtin::Rectangle | Builtin::Polygon, _) => {
                places::area(e, self.frame).map(|area| (e.span, Value::Area(area))).into_iter().collect()
            }
            ExprKind::Part(whole, at) => {
                let values = self.values(unit, whole).into_iter();
                values.filter_map(|(span, value)| Some((span, part(value, *at, &e.ty)?))).collect()
            }
            ExprKind::Do(op, operands) => {
                let operands = operands.iter().map(|operand| self.values(unit, operand)).collect();
                together(e.span, operands, |values| result(*op, values))
            }
            _ => Vec::new(),
        }
    }

    fn values_of(&mut self, unit: usize, source: Source<'h>) -> Vec<Written> {
        let lines = |written: Vec<Written>, of: &dyn Fn(&Area) -> Vec<Line>| {
            let lines = written.into_iter().flat_map(|(span, value)| {
                let lines = if let Value::Area(area) = value { of(&area) } else { Vec::new() };
                lines.into_iter().map(move |line| (span, Value::Line(line.start, line.end)))
            });
            lines.collect()
        };
        match source {
            Source::Value(e) => self.values(unit, e),
            Source::Edges(area) => lines(self.values(unit, area), &|area| area.edges().map(|edge| edge.line).collect()),
            Source::Rows(area, step) => {
                let [(_, Value::Number(step))] = self.values(unit, step)[..] else { return Vec::new() };
                // Where they begin changes their order and their direction alone.
                let edges = |area: &Area| area.edges().collect::<Vec<_>>();
                let nth = |area: &Area, n: u32| row(edges(area).into_iter(), step, area.center(), n);
                let rows = |area: &Area| (0..VALUES_MAX as u32).map_while(|n| nth(area, n)).collect();
                lines(self.values(unit, area), &rows)
            }
        }
    }

    fn named(&mut self, name: Name) -> Vec<Written> {
        if self.tested.contains(&name) {
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
        (Builtin::AddVector, [Pair(a), Pair(b)]) => pair(vector(a) + vector(b)),
        (Builtin::SubVector, [Pair(a), Pair(b)]) => pair(vector(a) - vector(b)),
        (Builtin::Scale, [Pair(v), Number(by)]) => pair(*by * vector(v)),
        (Builtin::Toward, [Number(length), Number(heading)]) => pair(*length * Heading::from_radians(*heading).unit()),
        (Builtin::Line, [Pair(start), Pair(end)]) => Value::Line(*start, *end),
        (Builtin::Center, [Area(area)]) => Pair(area.center()),
        (Builtin::Corner, [Area(area), Number(heading), near @ ..]) => {
            let near = match near {
                [Pair(near)] => *near,
                _ => area.center(),
            };
            Pair(farthest_corner(area.corners(), Heading::from_radians(*heading), near))
        }
        _ => return None,
    })
}

/// A part of a value, by the place of its words.
fn part(whole: Value, at: u32, ty: &Type) -> Option<Value> {
    Some(match (whole, at, ty) {
        // The line of an edge.
        (line @ Value::Line(..), 0, Type::Line) => line,
        (Value::Line(start, _), 0, Type::Point) => Value::Pair(start),
        (Value::Line(_, end), 2, Type::Point) => Value::Pair(end),
        (Value::Pair(p), 0, Type::Quantity(_)) => Value::Number(p.north),
        (Value::Pair(p), 1, Type::Quantity(_)) => Value::Number(p.east),
        _ => return None,
    })
}
