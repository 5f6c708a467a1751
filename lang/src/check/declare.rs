//! The first pass: what every module declares, before any body is looked at.

use super::{Checker, ClauseInfo, Def, Lazy, ParamInfo, Scope, Setting, Signature};
use crate::diagnostic::Diagnostic;
use crate::dimension::{self, Dimension, Unit};
use crate::hir::{self, Interval};
use crate::source::Span;
use crate::suggest;
use crate::syntax::tree::{self, ActivityKind, Item, Ty, TyKind};
use crate::types::{EnumInfo, RecordInfo, Type};

/// A parameter set from outside, as by `--set cpt_2005.beta=30deg`.
#[derive(Clone, Debug)]
pub struct Override {
    /// The declaration, by its own name or with its module, and the parameter.
    pub declaration: String,
    /// The parameter.
    pub param: String,
    /// The value.
    pub value: tree::Expr,
    /// Whether it has found its parameter.
    pub used: bool,
}

/// Lists hold this many elements at most.
const LIST_CAPACITY_MAX: f64 = 1024.0;

impl<'t> Checker<'t> {
    pub(super) fn run(&mut self) {
        let modules = self.modules;
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.declare_item(m, item);
            }
        }
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.declare_types(m, item);
            }
        }
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.declare_signature(m, item);
            }
        }
        for unused in self.overrides.clone().into_iter().filter(|o| !o.used) {
            self.unknown_override(&unused);
        }
        self.make_room();
        for i in 0..self.consts.len() {
            self.constant(i);
        }
        for i in 0..self.signals.len() {
            self.module_signal(i);
        }
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                self.check_item(m, item);
            }
        }
        for (m, module) in modules.iter().enumerate() {
            for item in &module.tree.items {
                if let Item::Test(test) = item {
                    self.check_test(m, test);
                }
            }
        }
        // Whether a behavior can end depends on what it calls: tables come when all bodies are known.
        for activity in self.hir.activities.clone() {
            if let hir::Body::Table { start, behaviors, rules } = &activity.body {
                self.check_table(behaviors, *start, rules);
            }
        }
    }

    /// Every declaration gets its index before any body is checked: bodies refer to one another.
    fn make_room(&mut self) {
        let empty = hir::Block::default;
        for signature in &self.fn_signatures {
            let result = signature.result.clone().unwrap_or(Type::Unknown);
            self.hir.fns.push(hir::Function {
                name: signature.name.clone(),
                vars: Vec::new(),
                params: 0,
                result,
                body: empty(),
            });
        }
        for signature in &self.activity_signatures {
            self.hir.activities.push(hir::Activity::empty(&signature.name, signature.span));
        }
    }

    fn define(&mut self, module: usize, name: &tree::Name, def: Def) {
        if let Some(earlier) = self.names[module].get(&name.node) {
            let finding = Diagnostic::error(
                "names::twice",
                name.span,
                format!("`{}` is declared already, as {}", name.node, earlier.what()),
            )
            .help("choose another name");
            self.report(finding);
            return;
        }
        self.names[module].insert(name.node.clone(), def);
    }

    fn declare_item(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Use(_) | Item::Test(_) => {}
            Item::Const(c) => {
                self.consts.push(Lazy::Unchecked { module: m, name: &c.name, ty: c.ty.as_ref(), value: &c.value });
                self.define(m, &c.name, Def::Const(self.consts.len() - 1));
            }
            Item::Enum { name, variants } => {
                let id = self.types.enums.len();
                let variant_names = variants.iter().map(|v| v.node.clone()).collect();
                self.types.enums.push(EnumInfo { name: name.node.clone(), variants: variant_names });
                self.define(m, name, Def::Enum(id));
                for (i, variant) in variants.iter().enumerate() {
                    self.define(m, variant, Def::Variant(id, i));
                }
            }
            Item::Record { name, .. } => {
                self.types.records.push(RecordInfo { name: name.node.clone(), fields: Vec::new() });
                self.define(m, name, Def::Record(self.types.records.len() - 1));
            }
            Item::Unit { name, value } => {
                if let Some(unit) = self.declared_unit(m, value) {
                    self.define(m, name, Def::Unit(unit));
                }
            }
            Item::Input { name, .. } => {
                self.hir.inputs.push(hir::Input { name: name.node.clone(), ty: Type::Unknown, fields: Vec::new() });
                self.define(m, name, Def::Input(self.hir.inputs.len() - 1));
            }
            Item::Clause { name, result, .. } => {
                let signature =
                    Signature { name: name.node.clone(), span: name.span, params: Vec::new(), result: None };
                let kind = result.as_ref().and_then(|ty| match &ty.kind {
                    TyKind::Named { path, .. } => Some(path.text()),
                    TyKind::List { .. } => None,
                });
                self.clauses.push(ClauseInfo { signature, nested: Vec::new(), kind });
                self.define(m, name, Def::Clause(self.clauses.len() - 1));
            }
            Item::Fn(f) => {
                let signature =
                    Signature { name: f.name.node.clone(), span: f.name.span, params: Vec::new(), result: None };
                self.fn_signatures.push(signature);
                self.define(m, &f.name, Def::Fn(self.fn_signatures.len() - 1));
            }
            Item::Signal { name, ty, value } => {
                self.signals.push(Lazy::Unchecked { module: m, name, ty: ty.as_ref(), value });
                self.define(m, name, Def::Signal(self.signals.len() - 1));
            }
            Item::Activity(a) => {
                let signature =
                    Signature { name: a.name.node.clone(), span: a.name.span, params: Vec::new(), result: None };
                self.activity_signatures.push(signature);
                let id = self.activity_signatures.len() - 1;
                match a.kind {
                    ActivityKind::Overlay { .. } => _ = self.overlay_ids.insert(id),
                    ActivityKind::Mission { .. } => _ = self.mission_ids.insert(id),
                    _ => {}
                }
                self.define(m, &a.name, Def::Activity(id));
            }
            Item::Scenario { name, .. } => {
                self.hir.scenarios.push(hir::Scenario {
                    name: name.node.clone(),
                    vars: Vec::new(),
                    defaults: Vec::new(),
                    clauses: Vec::new(),
                });
                self.define(m, name, Def::Scenario(self.hir.scenarios.len() - 1));
            }
        }
    }

    fn declared_unit(&mut self, m: usize, value: &tree::Expr) -> Option<Unit> {
        let tree::ExprKind::Number { value: number, unit: Some(unit) } = &value.kind else {
            self.report(
                Diagnostic::error("units::declaration", value.span, "a unit is declared by a quantity")
                    .help("for example `unit fathom = 1.8288 m`"),
            );
            return None;
        };
        let base = self.unit(m, unit)?;
        Some(Unit { dimension: base.dimension, scale: base.scale * number })
    }

    /// The unit that a word names in a module.
    pub(super) fn unit(&mut self, module: usize, word: &tree::Name) -> Option<Unit> {
        let own = |name: &str| match self.lookup(module, name) {
            Some(Def::Unit(unit)) => Some(*unit),
            _ => None,
        };
        let found = dimension::unit(&word.node, &own);
        if found.is_none() {
            let known: Vec<&str> = dimension::UNITS.iter().map(|(name, ..)| *name).collect();
            let finding = Diagnostic::error("units::unknown", word.span, format!("`{}` is no unit", word.node))
                .here("unknown unit");
            let finding = if let Some((unit, name)) = word.node.split_once('/')
                && dimension::unit(unit, &own).is_some()
            {
                finding.help(format!("to divide by a variable, write a blank: `{unit} / {name}`"))
            } else if let Some(near) = nearest_unit(&word.node, &known) {
                finding.help(format!("did you mean `{near}`?"))
            } else {
                finding.help("units are m, cm, km, nmi, ft, s, min, h, deg, rad, m/s, kn, Hz, %, kg, g and what they make, such as m2/s")
            };
            self.report(finding);
        }
        found
    }

    fn declare_types(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Record { name, fields } => {
                let fields = fields.iter().map(|f| (f.name.node.clone(), self.written_type(m, &f.ty))).collect();
                if let Some(&Def::Record(id)) = self.names[m].get(&name.node) {
                    self.types.records[id].fields = fields;
                    if self.holds_itself(id, &mut Vec::new()) {
                        self.types.records[id].fields.clear();
                        self.report(Diagnostic::error(
                            "types::recursive",
                            name.span,
                            format!("the record `{}` would hold itself", name.node),
                        ));
                    }
                }
            }
            Item::Input { name, ty, fields } => {
                let ty = self.written_type(m, ty);
                let fields = fields.iter().map(|f| (f.name.node.clone(), self.written_type(m, &f.ty))).collect();
                if let Some(&Def::Input(id)) = self.names[m].get(&name.node) {
                    self.hir.inputs[id].ty = ty;
                    self.hir.inputs[id].fields = fields;
                }
            }
            _ => {}
        }
    }

    fn holds_itself(&self, id: usize, path: &mut Vec<usize>) -> bool {
        if path.contains(&id) {
            return true;
        }
        path.push(id);
        let found = self.types.records[id].fields.iter().any(|(_, ty)| {
            let mut ty = ty;
            while let Type::Optional(inner) | Type::List(inner, _) = ty {
                ty = inner;
            }
            matches!(ty, Type::Record(inner) if self.holds_itself(*inner, path))
        });
        path.pop();
        found
    }

    fn declare_signature(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Fn(f) => {
                if let Some(&Def::Fn(id)) = self.names[m].get(&f.name.node) {
                    let params = self.params(m, &f.params, None);
                    let result = Some(self.written_type(m, &f.result));
                    self.fn_signatures[id].params = params;
                    self.fn_signatures[id].result = result;
                }
            }
            Item::Activity(a) => {
                if let Some(&Def::Activity(id)) = self.names[m].get(&a.name.node) {
                    let params = self.params(m, &a.params, Some(&a.name.node));
                    let result = a.result.as_ref().map(|ty| self.written_type(m, ty));
                    if matches!(a.kind, ActivityKind::Mission { .. }) {
                        self.mission_params(a);
                    }
                    let name = &self.modules[m].name;
                    let full = if name.is_empty() { a.name.node.clone() } else { format!("{name}.{}", a.name.node) };
                    let signature = &mut self.activity_signatures[id];
                    signature.params = params;
                    signature.result = result;
                    signature.name = full;
                }
            }
            Item::Scenario { name, params, .. } => {
                if let Some(&Def::Scenario(id)) = self.names[m].get(&name.node) {
                    let infos = self.params(m, params, Some(&name.node));
                    let scenario = &mut self.hir.scenarios[id];
                    for info in infos {
                        scenario.vars.push(hir::Var {
                            name: info.name,
                            kind: hir::VarKind::Param,
                            ty: info.ty,
                            span: info.span,
                            range: info.range.unwrap_or(Interval::ANY),
                            walks_constants: false,
                            order: None,
                        });
                        scenario.defaults.push(info.default);
                    }
                }
            }
            Item::Clause { name, params, .. } => {
                if let Some(&Def::Clause(id)) = self.names[m].get(&name.node) {
                    self.declare_clause(m, id, params);
                }
            }
            _ => {}
        }
    }

    fn mission_params(&mut self, mission: &tree::Activity) {
        for param in mission.params.iter().filter(|p| p.default.is_none()) {
            self.report(
                Diagnostic::error(
                    "missions::default",
                    param.name.span,
                    format!("the mission's parameter `{}` has no default", param.name.node),
                )
                .help(format!(
                    "write `{}: … = VALUE`; `--set {}=VALUE` then changes it",
                    param.name.node, param.name.node
                )),
            );
        }
    }

    pub(super) fn params(&mut self, m: usize, params: &'t [tree::Param], owner: Option<&str>) -> Vec<ParamInfo> {
        let mut infos: Vec<ParamInfo> = Vec::new();
        for param in params {
            if let Some(earlier) = infos.iter().find(|i| i.name == param.name.node) {
                let finding = Diagnostic::error(
                    "names::twice",
                    param.name.span,
                    format!("there are two parameters `{}`", param.name.node),
                )
                .label(earlier.span, "the first");
                self.report(finding);
            }
            let ty = self.written_type(m, &param.ty);
            let range = param.range.as_ref().and_then(|r| self.constant_range(m, r, &ty));
            let replaced = owner.and_then(|owner| self.take_override(m, owner, &param.name.node));
            let default = replaced.as_ref().or(param.default.as_ref()).map(|written| {
                let scope = Scope::new(m, Setting::Constant);
                let (value, _) = self.within(scope, |c| c.expr_as(written, &ty, "the default"));
                value
            });
            if let (Some(default), Some(range)) = (&default, range) {
                self.in_range(default, range, &param.name.node, param.name.span);
            }
            infos.push(ParamInfo { name: param.name.node.clone(), ty, default, range, span: param.name.span });
        }
        infos
    }

    fn take_override(&mut self, m: usize, owner: &str, param: &str) -> Option<tree::Expr> {
        let full = format!("{}.{owner}", self.modules[m].name);
        let found = self
            .overrides
            .iter_mut()
            .find(|o| o.param == param && (o.declaration == owner || o.declaration == full))?;
        found.used = true;
        Some(found.value.clone())
    }

    fn unknown_override(&mut self, unused: &Override) {
        let mut all: Vec<String> = Vec::new();
        for signature in &self.activity_signatures {
            let short = signature.name.rsplit('.').next().unwrap_or("");
            if unused.declaration == short || unused.declaration == signature.name {
                all.extend(signature.params.iter().map(|p| p.name.clone()));
            }
        }
        for scenario in &self.hir.scenarios {
            if unused.declaration == scenario.name {
                all.extend(scenario.vars.iter().map(|v| v.name.clone()));
            }
        }
        let finding = Diagnostic::error(
            "set::unknown",
            unused.value.span,
            format!("`{}` has no parameter `{}`", unused.declaration, unused.param),
        );
        let finding = match suggest::help(&unused.param, all.iter().map(String::as_str)) {
            Some(help) => finding.help(help),
            None => finding.help(format!("nothing named `{}` takes parameters", unused.declaration)),
        };
        self.report(finding);
    }

    fn constant_range(&mut self, m: usize, range: &tree::Range, ty: &Type) -> Option<Interval> {
        let scope = Scope::new(m, Setting::Constant);
        let ((first, last), _) =
            self.within(scope, |c| (c.expr_as(&range.first, ty, "the range"), c.expr_as(&range.last, ty, "the range")));
        match (first.range.constant(), last.range.constant()) {
            (Some(low), Some(high)) if low <= high => Some(Interval::new(low, high)),
            (Some(_), Some(_)) => {
                self.report(
                    Diagnostic::error(
                        "ranges::empty",
                        range.first.span.to(range.last.span),
                        "this range holds nothing",
                    )
                    .help("the smaller bound comes first"),
                );
                None
            }
            _ => None,
        }
    }

    /// Checks that a value is in a parameter's range, as far as the value is known.
    pub(super) fn in_range(&mut self, value: &hir::Expr, range: Interval, param: &str, declared: Span) {
        if value.ty == Type::Unknown || (value.range.low >= range.low && value.range.high <= range.high) {
            return;
        }
        let show = |x: f64| self.shown_number(x, &value.ty);
        let bounds = format!("{}..{}", show(range.low), show(range.high));
        let finding = match value.range.constant() {
            Some(x) => Diagnostic::error(
                "ranges::outside",
                value.span,
                format!("{} is outside the range of `{param}`", show(x)),
            )
            .help(format!("choose a value in {bounds}")),
            None => Diagnostic::error(
                "ranges::unproved",
                value.span,
                format!("this may be outside the range of `{param}`, {bounds}"),
            )
            .help("give what it is computed from a range of its own, or hold it with `clamp(x, low, high)`"),
        };
        self.report(finding.label(declared, format!("`{param}` is in {bounds}")));
    }

    fn shown_number(&self, x: f64, ty: &Type) -> String {
        let display = match ty {
            Type::Quantity(d) if !d.is_none() => d.display(),
            Type::Heading => Dimension::ANGLE.display(),
            Type::Depth | Type::Altitude => Dimension::LENGTH.display(),
            _ => return format!("{x}"),
        };
        // As a person writes it: rounded where radians come back as degrees.
        let value = (x / display.scale * 1e6).round() / 1e6;
        format!("{value} {}", display.unit)
    }

    /// The type that is written.
    pub(super) fn written_type(&mut self, m: usize, ty: &Ty) -> Type {
        let inner = match &ty.kind {
            TyKind::List { element, capacity, .. } => {
                let element = self.written_type(m, element);
                let scope = Scope::new(m, Setting::Constant);
                let (capacity, _) = self.within(scope, |c| c.expr_as(capacity, &Type::Int, "the capacity"));
                match capacity.range.constant() {
                    Some(n) if (1.0..=LIST_CAPACITY_MAX).contains(&n) => Type::List(Box::new(element), n as u32),
                    _ => {
                        if capacity.ty != Type::Unknown {
                            self.report(
                                Diagnostic::error("types::capacity", capacity.span, "a list's capacity is a constant")
                                    .help(format!("a whole number from 1 to {LIST_CAPACITY_MAX}")),
                            );
                        }
                        Type::Unknown
                    }
                }
            }
            TyKind::Named { path, factors } => self.named_type(m, path, factors),
        };
        if ty.optional { inner.optional() } else { inner }
    }

    fn named_type(&mut self, m: usize, path: &tree::Path, factors: &[(tree::Name, f64)]) -> Type {
        let name = path.text();
        if !factors.is_empty() {
            let mut dimension = self.dimension_of(&path.parts[0]).unwrap_or(Dimension::NONE);
            for (factor, power) in factors {
                let raised = self.dimension_of(factor).and_then(|d| d.power(*power));
                dimension = dimension * raised.unwrap_or(Dimension::NONE);
            }
            return Type::Quantity(dimension);
        }
        let simple = match name.as_str() {
            "Bool" => Some(Type::Bool),
            "Int" => Some(Type::Int),
            "Sign" => Some(Type::Sign),
            "Text" => Some(Type::Text),
            "Heading" => Some(Type::Heading),
            "Depth" => Some(Type::Depth),
            "Altitude" => Some(Type::Altitude),
            "Point" => Some(Type::Point),
            "Vector" => Some(Type::Vector(Dimension::LENGTH)),
            "Velocity" => Some(Type::Vector(Dimension::SPEED)),
            "Direction" => Some(Type::Vector(Dimension::NONE)),
            "Area" => Some(Type::Area),
            "Edge" => Some(Type::Edge),
            "Line" => Some(Type::Line),
            other => Dimension::of_type(other).map(Type::Quantity),
        };
        if let Some(ty) = simple {
            return ty;
        }
        match self.resolve(m, path).cloned() {
            Some(Def::Record(id)) => Type::Record(id),
            Some(Def::Enum(id)) => Type::Enum(id),
            Some(def) => {
                self.report(Diagnostic::error(
                    "types::unknown",
                    path.span,
                    format!("`{name}` is {}, no type", def.what()),
                ));
                Type::Unknown
            }
            None => {
                let mut known: Vec<&str> = dimension::NAMED.iter().map(|(n, _)| *n).collect();
                known.extend(SIMPLE_TYPES);
                let declared = self.names[m].iter().filter(|(_, d)| matches!(d, Def::Record(_) | Def::Enum(_)));
                known.extend(declared.map(|(n, _)| n.as_str()));
                let finding = Diagnostic::error("types::unknown", path.span, format!("there is no type `{name}`"));
                let finding = match suggest::nearest(&name, known) {
                    Some(near) => finding.help(format!("did you mean `{near}`?")),
                    None => finding.help("types are Length, Duration, Speed, Angle, Heading, Depth, Altitude, Point, Vector, Int, Bool, … and the records and enums declared"),
                };
                self.report(finding);
                Type::Unknown
            }
        }
    }

    fn dimension_of(&mut self, name: &tree::Name) -> Option<Dimension> {
        let found = Dimension::of_type(&name.node);
        if found.is_none() {
            self.report(
                Diagnostic::error("types::unknown", name.span, format!("`{}` is no quantity", name.node))
                    .help("only quantities such as Length and Duration can be multiplied and divided"),
            );
        }
        found
    }

    /// The value of a constant, checked when first needed.
    pub(super) fn constant(&mut self, id: usize) -> hir::Expr {
        self.lazy(id, true)
    }

    /// The expression of a module's signal.
    pub(super) fn module_signal(&mut self, id: usize) -> hir::Expr {
        self.lazy(id, false)
    }

    fn lazy(&mut self, id: usize, is_const: bool) -> hir::Expr {
        let table = if is_const { &mut self.consts } else { &mut self.signals };
        match std::mem::replace(&mut table[id], Lazy::InProgress) {
            Lazy::Done(value) => {
                table[id] = Lazy::Done(value.clone());
                value
            }
            Lazy::InProgress => {
                let span = Span { file: crate::source::FileId(0), start: 0, end: 0 };
                hir::Expr { kind: hir::ExprKind::None, ty: Type::Unknown, span, range: Interval::ANY }
            }
            Lazy::Unchecked { module, name, ty, value } => {
                let setting = if is_const { Setting::Constant } else { Setting::Function };
                let mut scope = Scope::new(module, setting);
                scope.setting = if is_const { Setting::Constant } else { Setting::Instant };
                let (checked, _) = self.within(scope, |c| match ty {
                    Some(ty) => {
                        let ty = c.written_type(module, ty);
                        c.expr_as(value, &ty, &format!("`{}`", name.node))
                    }
                    None => c.expr(value, None),
                });
                let table = if is_const { &mut self.consts } else { &mut self.signals };
                table[id] = Lazy::Done(checked.clone());
                checked
            }
        }
    }

    fn check_item(&mut self, m: usize, item: &'t Item) {
        match item {
            Item::Fn(f) => self.check_fn(m, f),
            Item::Activity(a) => {
                if let Some(&Def::Activity(id)) = self.names[m].get(&a.name.node) {
                    self.check_activity(m, id, a);
                }
            }
            Item::Scenario { name, body, .. } => {
                if let Some(&Def::Scenario(id)) = self.names[m].get(&name.node) {
                    self.check_scenario(m, id, body);
                }
            }
            _ => {}
        }
    }
}

const SIMPLE_TYPES: [&str; 14] = [
    "Bool",
    "Int",
    "Sign",
    "Text",
    "Heading",
    "Depth",
    "Altitude",
    "Point",
    "Vector",
    "Velocity",
    "Direction",
    "Area",
    "Edge",
    "Line",
];

/// The unit that a word was probably meant to be: what people write elsewhere, then what is spelt alike.
fn nearest_unit<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let meant = match word {
        "sec" | "secs" | "second" | "seconds" => "s",
        "minute" | "minutes" | "mins" => "min",
        "hour" | "hours" | "hr" | "hrs" => "h",
        "metre" | "metres" | "meter" | "meters" => "m",
        "degree" | "degrees" | "°" => "deg",
        "radian" | "radians" => "rad",
        "kt" | "kts" => "kn",
        "percent" => "%",
        "feet" | "foot" => "ft",
        _ => return suggest::nearest(word, known.iter().copied()),
    };
    known.iter().copied().find(|k| *k == meant)
}
