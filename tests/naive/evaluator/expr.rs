//! Expressions, read off the checked tree. Nothing here takes time, and no arithmetic fails.

use super::body;
use super::value::Value;
use super::watch::Watch;
use super::world::World;
use albacore_geometry::{Area, Edge, Grid, Heading, Point, Vector, math, run, wrap_angle};
use albacore_lang::hir::{Block, Builtin, Expr, ExprKind, InputPart, TextPart, Var};
use albacore_lang::types::Type;
use albacore_program::{Shape, Text, number};
use std::cell::RefCell;
use std::rc::Rc;

/// The variables of a function or activity; behaviors of a table share those of their strategy.
#[derive(Clone)]
pub struct Frame<'p> {
    pub declared: &'p [Var],
    pub vars: Rc<RefCell<Vec<Value>>>,
}

impl<'p> Frame<'p> {
    pub fn new(w: &World<'p>, declared: &'p [Var], params: Vec<Value>) -> Self {
        let mut vars: Vec<Value> = declared.iter().map(|var| Value::nothing(&w.shape(&var.ty))).collect();
        for (var, param) in vars.iter_mut().zip(params) {
            *var = param;
        }
        Frame { declared, vars: Rc::new(RefCell::new(vars)) }
    }

    pub fn get(&self, id: usize) -> Value {
        self.vars.borrow()[id].clone()
    }

    pub fn set(&self, id: usize, value: Value) {
        self.vars.borrow_mut()[id] = value;
    }
}

/// Where an expression is read: its names, the conditions over time that it may hold, and whether a body is done (rule 8).
#[derive(Clone, Copy)]
pub struct Scope<'a, 'p> {
    pub frame: &'a Frame<'p>,
    pub watch: Option<&'a Watch<'p>>,
    pub done: bool,
}

impl<'a, 'p> Scope<'a, 'p> {
    pub fn of(frame: &'a Frame<'p>) -> Self {
        Scope { frame, watch: None, done: false }
    }
}

pub fn number(w: &mut World<'_>, s: Scope<'_, '_>, e: &Expr) -> f64 {
    value(w, s, e).number()
}

pub fn holds(w: &mut World<'_>, s: Scope<'_, '_>, e: &Expr) -> bool {
    value(w, s, e).holds()
}

pub fn values(w: &mut World<'_>, s: Scope<'_, '_>, list: &[Expr]) -> Vec<Value> {
    list.iter().map(|e| value(w, s, e)).collect()
}

/// The value of an expression, which lies in the range that the checker has claimed of it.
pub fn value(w: &mut World<'_>, s: Scope<'_, '_>, e: &Expr) -> Value {
    let value = computed(w, s, e);
    let number = match &value {
        Value::Maybe(inside) => inside.as_deref(),
        value => Some(value),
    };
    if let Some(Value::Number(x)) = number {
        assert!(e.range.holds(*x), "{x:e} is not in {:?}, which is claimed of {:?}", e.range, e.kind);
    }
    value
}

fn computed(w: &mut World<'_>, s: Scope<'_, '_>, e: &Expr) -> Value {
    w.steps += 1;
    match &e.kind {
        ExprKind::Number(x) => Value::Number(*x),
        ExprKind::Geodetic { latitude_deg, longitude_deg } => {
            let position = albacore_geometry::Geodetic::from_degrees(*latitude_deg, *longitude_deg);
            Value::of_point(w.frame.map_or(Point::ORIGIN, |frame| frame.to_point(position)))
        }
        ExprKind::Text(parts) => {
            let text = text(w, s, parts);
            Value::Text(w.met(text))
        }
        ExprKind::None => Value::nothing(&w.shape(&e.ty)),
        ExprKind::Done => Value::truth(s.done),
        ExprKind::Var(id) => s.frame.get(*id),
        ExprKind::Input(id, part) => {
            let limit = if let InputPart::Hits(limit, _) = part { number(w, s, limit) } else { 0.0 };
            w.input(*id, part, limit, &e.ty)
        }
        ExprKind::Present(inner) => value(w, s, inner).present(),
        ExprKind::Unwrap(inner) => match value(w, s, inner) {
            Value::Maybe(Some(value)) => *value,
            // The checker has shown that it is present, unless its operand is read only where it is.
            Value::Maybe(None) => Value::nothing(&w.shape(&e.ty)),
            other => other,
        },
        ExprKind::IsPresent(inner) => Value::truth(value(w, s, inner).holds()),
        ExprKind::Else(a, b) => match value(w, s, a) {
            Value::Maybe(Some(value)) if e.ty.is_optional() => value.present(),
            Value::Maybe(Some(value)) => *value,
            _ => value(w, s, b),
        },
        // The right side is read only where the left has not decided: it may know what the left has shown.
        ExprKind::Do(op @ (Builtin::And | Builtin::Or), operands) => {
            let decided = *op == Builtin::Or;
            Value::truth(if holds(w, s, &operands[0]) == decided { decided } else { holds(w, s, &operands[1]) })
        }
        ExprKind::Do(Builtin::Map, operands) => map(&values(w, s, operands), &e.ty),
        ExprKind::Do(op, operands) => {
            let operands = values(w, s, operands);
            builtin(*op, &operands)
        }
        ExprKind::Call(id, args) => {
            let function = &w.hir.fns[*id];
            let args = values(w, s, args);
            let frame = Frame::new(w, &function.vars, args);
            block(w, Scope::of(&frame), &function.body)
        }
        ExprKind::Record(fields) => Value::Parts(values(w, s, fields)),
        ExprKind::Changed(whole, fields) => changed(w, s, whole, fields),
        ExprKind::List(elements) => Value::List(values(w, s, elements)),
        ExprKind::Part(inner, at) => match value(w, s, inner) {
            Value::List(elements) => Value::Number(elements.len() as f64),
            whole => {
                let words = whole.words(&w.shape(&inner.ty));
                Value::read(&w.shape(&e.ty), &words[*at as usize..])
            }
        },
        ExprKind::If(condition, then, otherwise) => {
            let chosen = if holds(w, s, condition) { then } else { otherwise };
            block(w, s, chosen)
        }
        ExprKind::Match(on, arms, otherwise) => {
            let variant = number(w, s, on) as usize;
            let arm = arms.iter().find(|(variants, _)| variants.contains(&variant)).map(|(_, block)| block);
            match arm.or(otherwise.as_ref()) {
                Some(chosen) => block(w, s, chosen),
                None => Value::nothing(&w.shape(&e.ty)),
            }
        }
        // Rule 14: updated on every tick by whoever watches, and only looked at here.
        ExprKind::HeldFor(..) | ExprKind::Becomes(_) | ExprKind::After(_) | ExprKind::Every(_) => {
            Value::truth(s.watch.is_some_and(|watch| watch.says(e)))
        }
    }
}

/// A record with other values in some parts.
fn changed(w: &mut World<'_>, s: Scope<'_, '_>, whole: &Expr, fields: &[(u32, Expr)]) -> Value {
    let shape = w.shape(&whole.ty);
    let mut words = value(w, s, whole).words(&shape);
    for (at, field) in fields {
        let (at, changed) = (*at as usize, value(w, s, field).words(&w.shape(&field.ty)));
        words[at..at + changed.len()].copy_from_slice(&changed);
    }
    Value::read(&shape, &words)
}

/// Instantaneous statements, and the value after them.
pub fn block(w: &mut World<'_>, s: Scope<'_, '_>, block: &Block) -> Value {
    body::at_once(w, s.frame, block);
    block.value.as_ref().map_or(Value::Number(0.0), |e| value(w, s, e))
}

/// A text with its holes filled.
pub fn text(w: &mut World<'_>, s: Scope<'_, '_>, parts: &[TextPart]) -> String {
    let part = |part: &TextPart| match part {
        TextPart::Literal(literal) => literal.clone(),
        TextPart::Hole(e) => {
            let shape = w.shape(&e.ty);
            let words = value(w, s, e).words(&shape);
            number::within_text(&w.texts, &shape, &words)
        }
    };
    parts.iter().map(part).collect()
}

/// Puts a list that is kept in order in the order of its key as of now; of equals the older comes first.
pub fn sorted(w: &mut World<'_>, frame: &Frame<'_>, id: usize, list: Vec<Value>) -> Vec<Value> {
    let Some(order) = &frame.declared[id].order else { return list };
    let keyed = list.into_iter().map(|element| {
        frame.set(order.it, element.clone());
        (number(w, Scope::of(frame), &order.key), element)
    });
    let mut keyed: Vec<(f64, Value)> = keyed.collect();
    let compare = |a: f64, b: f64| a.partial_cmp(&b).unwrap_or(std::cmp::Ordering::Equal);
    keyed.sort_by(|(a, _), (b, _)| if order.most { compare(*b, *a) } else { compare(*a, *b) });
    keyed.into_iter().map(|(_, element)| element).collect()
}

/// Adds to a list; when it is full the oldest goes, or the last in order.
pub fn insert(w: &mut World<'_>, frame: &Frame<'_>, id: usize, element: Value) {
    let Type::List(_, capacity) = &frame.declared[id].ty else { return };
    let capacity = *capacity as usize;
    let mut list = frame.get(id).list().to_vec();
    list.push(element);
    let ordered = frame.declared[id].order.is_some();
    let mut list = sorted(w, frame, id, list);
    if list.len() > capacity {
        list.remove(if ordered { capacity } else { 0 });
    }
    frame.set(id, Value::List(list));
}

/// What would be too large for a number is the largest that is kept.
fn fits(x: f64) -> f64 {
    const LARGEST: f64 = 1e150;
    if x.is_nan() { 0.0 } else { x.clamp(-LARGEST, LARGEST) }
}

/// Whole numbers end where they can be counted.
fn whole(x: f64) -> f64 {
    const MOST: f64 = (1_u64 << 53) as f64;
    x.clamp(-MOST, MOST)
}

fn fitting(v: Vector) -> Value {
    Value::pair(fits(v.north), fits(v.east))
}

/// What gives an area, or a place on one.
fn of_area(op: Builtin, operands: &[Value]) -> Option<Value> {
    use Builtin as B;
    let n = |i: usize| operands[i].number();
    let at = |i: usize| &operands[i];
    Some(match op {
        B::Rectangle => {
            let area = Area::rectangle(at(0).point(), at(1).heading(), n(2), n(3));
            Value::Area(area.edges().collect())
        }
        B::Polygon => {
            let corners: Vec<Point> = at(0).list().iter().map(Value::point).collect();
            let area = Area::polygon(&corners).ok();
            Value::Maybe(area.map(|area| Box::new(Value::Area(area.edges().collect()))))
        }
        B::Hull => Value::Area(hull(at(0).edges())),
        B::Center => Value::of_point(center(at(0).edges())),
        B::Corner => {
            let near = operands.get(2).map_or_else(|| center(at(0).edges()), Value::point);
            Value::of_point(corner(at(0).edges(), at(1).heading(), near))
        }
        B::Scattered => {
            let seed = operands.get(2).map_or(0.0, |_| n(2));
            Value::of_point(albacore_geometry::scattered(at(0).edges().iter().copied(), n(1), seed))
        }
        B::NearestEdge => Value::of_edge(nearest_edge(at(0).edges(), at(1).point())),
        B::EdgeGap => Value::Number(fits(at(0).edge().gap(at(1).point()))),
        B::EdgeDistance => Value::Number(fits(at(0).edge().distance(at(1).point()))),
        B::Exit => Value::of_point(exit(at(0).edges(), at(1).point(), at(2).heading())),
        B::Run => fitting(exit(at(0).edges(), at(1).point(), at(2).heading()) - at(1).point()),
        _ => return None,
    })
}

fn builtin(op: Builtin, operands: &[Value]) -> Value {
    use Builtin as B;
    if let Some(value) = of_area(op, operands) {
        return value;
    }
    let n = |i: usize| operands[i].number();
    let at = |i: usize| &operands[i];
    let number = match op {
        B::Add if operands.len() == 1 => n(0),
        B::Add => fits(n(0) + n(1)),
        B::Sub => fits(n(0) - n(1)),
        B::Mul => fits(n(0) * n(1)),
        B::AddInt => whole(n(0) + n(1)),
        B::SubInt => whole(n(0) - n(1)),
        B::MulInt => whole(n(0) * n(1)),
        B::Div => where_defined(n(1) != 0.0, fits(n(0) / n(1))),
        B::Quotient | B::VectorQuotient if n(1) == 0.0 => return Value::Maybe(None),
        B::Quotient => return Value::Number(fits(n(0) / n(1))).present(),
        B::VectorQuotient => return fitting(fits(1.0 / n(1)) * at(0).vector()).present(),
        B::Pow => fits(math::pow(n(0), n(1))),
        B::Neg => math::canonical_zero(-n(0)),
        B::Abs => n(0).abs(),
        B::Min => n(0).min(n(1)),
        B::Max => n(0).max(n(1)),
        B::Sqrt => where_defined(n(0) >= 0.0, n(0).sqrt()),
        B::Exp => fits(math::exp(n(0))),
        B::Ln => where_defined(n(0) > 0.0, math::ln(n(0))),
        B::Atan2 => math::atan2(n(0) + 0.0, n(1) + 0.0),
        B::Floor => whole(n(0).floor()),
        B::Ceil => whole(n(0).ceil() + 0.0),
        B::Round => whole(n(0).round() + 0.0),
        B::Sin => math::sin(n(0)),
        B::Cos => math::cos(n(0)),
        B::Heading => Heading::from_radians(n(0)).radians(),
        B::Angle => wrap_angle(n(0)),
        B::Lt => return Value::truth(n(0) < n(1)),
        B::Le => return Value::truth(n(0) <= n(1)),
        B::Eq => return Value::truth(operands[0] == operands[1]),
        B::Not => return Value::truth(!at(0).holds()),
        B::And => return Value::truth(at(0).holds() && at(1).holds()),
        B::Or => return Value::truth(at(0).holds() || at(1).holds()),
        B::AddVector => return fitting(at(0).vector() + at(1).vector()),
        B::SubVector => return fitting(at(0).vector() - at(1).vector()),
        B::Scale => return fitting(n(1) * at(0).vector()),
        B::Toward => return fitting(n(0) * at(1).heading().unit()),
        B::Direction => at(0).vector().toward().radians(),
        B::Length => fits(at(0).vector().length()),
        B::Dot => fits(at(0).vector().dot(at(1).vector())),
        B::Along => fits(at(0).vector().along(at(1).heading())),
        B::Pair | B::Line => return Value::Parts(operands.to_vec()),
        B::Rectangle | B::Polygon | B::Hull | B::Center | B::Corner | B::Scattered | B::NearestEdge => {
            unreachable!("`of_area` has it")
        }
        B::EdgeGap | B::EdgeDistance | B::Exit | B::Run => unreachable!("`of_area` has it"),
        B::LineVector => {
            let line = at(0).line();
            return fitting(line.end - line.start);
        }
        B::EdgeTangent => at(0).edge().tangent(at(1).heading()).radians(),
        B::Gap => fits(gap(at(0).edges(), at(1).point())),
        B::Top => {
            let list = at(0).list();
            return Value::List(list[..n(1).clamp(0.0, list.len() as f64) as usize].to_vec());
        }
        B::Map => unreachable!("it is made where its type is known"),
        B::Cell => {
            let (grid, cells) = at(0).map();
            return element(cells, grid.index_of(at(1).point()).map_or(-1.0, f64::from));
        }
        B::At => {
            return element(at(0).list(), n(1));
        }
        B::Spread => {
            let along: Vec<f64> = at(0).list().iter().map(|p| p.point().along(at(1).heading())).collect();
            let (low, high) = along.iter().fold((f64::MAX, f64::MIN), |(low, high), &x| (low.min(x), high.max(x)));
            if along.is_empty() { 0.0 } else { fits(high - low) }
        }
    };
    Value::Number(number)
}

/// What not every number has, of one that has it: no divisor is zero, no root of what is negative, no logarithm of what is not positive.
fn where_defined(is_defined: bool, result: f64) -> f64 {
    assert!(is_defined, "the checker has shown that there is a result");
    result
}

/// An element, or none; an optional of an optional is one.
fn element(list: &[Value], index: f64) -> Value {
    let found = if index >= 0.0 { list.get(index as usize) } else { None };
    match found {
        Some(Value::Maybe(inner)) => Value::Maybe(inner.clone()),
        found => Value::Maybe(found.cloned().map(Box::new)),
    }
}

/// A map over an area with the same in each cell.
fn map(operands: &[Value], ty: &Type) -> Value {
    let Type::Map(_, cells) = ty else { panic!("no map: {ty:?}") };
    let edges = operands[0].edges().iter().map(|edge| edge.line);
    let grid = Grid::over(edges, *cells).expect("an area has corners");
    Value::Map(grid, vec![operands[1].clone(); (grid.rows * grid.columns) as usize])
}

fn center(edges: &[Edge]) -> Point {
    let sum = edges.iter().fold(Vector::ZERO, |sum, edge| sum + (edge.line.start - Point::ORIGIN));
    Point::ORIGIN + (1.0 / edges.len().max(1) as f64) * sum
}

/// How often edges go round a point, seen from there.
fn turns(edges: &[Edge], p: Point) -> f64 {
    let seen = |to: Point| (to - p).toward().radians();
    let turned: f64 = edges.iter().map(|edge| wrap_angle(seen(edge.line.end) - seen(edge.line.start))).sum();
    (turned / math::TAU).round()
}

fn gap(edges: &[Edge], p: Point) -> f64 {
    let distance = edges.iter().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min);
    match distance {
        _ if distance < 1e-6 => 0.0,
        _ if turns(edges, p) == 0.0 => -distance,
        _ => distance,
    }
}

fn nearest_edge(edges: &[Edge], p: Point) -> Edge {
    let least = edges.iter().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min);
    let nearest = edges.iter().filter(|edge| edge.distance(p) == least);
    let farther_off = |best: Edge, edge: &Edge| if edge.gap(p).abs() > best.gap(p).abs() { *edge } else { best };
    nearest.fold(None, |best, edge| Some(best.map_or(*edge, |best| farther_off(best, edge)))).unwrap_or(edges[0])
}

/// An area without dents is its own hull.
fn hull(edges: &[Edge]) -> Vec<Edge> {
    let corners: Vec<Point> = edges.iter().map(|edge| edge.line.start).collect();
    if edges.iter().all(|edge| corners.iter().all(|corner| edge.gap(*corner) >= 0.0)) {
        return edges.to_vec();
    }
    Area::around(&corners).edges().collect()
}

/// The corner farthest along a heading; of those equally far, to 1 m, the one nearest to a point.
fn corner(edges: &[Edge], heading: Heading, near: Point) -> Point {
    let corners = edges.iter().map(|edge| edge.line.start);
    let far = corners.clone().map(|c| c.along(heading)).fold(f64::NEG_INFINITY, f64::max);
    let mut farthest = corners.filter(|c| c.along(heading) > far - 1.0);
    let first = farthest.next().unwrap_or(near);
    farthest.fold(first, |best, c| if c.distance(near) < best.distance(near) { c } else { best })
}

/// Where a ray leaves an area; the point itself when it is outside.
fn exit(edges: &[Edge], from: Point, heading: Heading) -> Point {
    let ray = heading.unit();
    // From outside it goes nowhere: by 0, which takes the sign from a zero.
    let run = if gap(edges, from) < 0.0 { 0.0 } else { run(edges.iter().copied(), from, ray) };
    from + run * ray
}

/// Named values as the trace has them, exactly; what holds texts as it is told, for their places mean nothing.
pub fn exactly(texts: &[Text], name: &str, shape: &Shape, words: &[f64]) -> String {
    match shape.has_text() {
        true => format!("{name} = {}", number::value_with(texts, shape, words)),
        false => format!("{name} = {:?}", Value::read(shape, words)),
    }
}
