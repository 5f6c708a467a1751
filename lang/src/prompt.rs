//! Lines typed at a prompt: checked and lowered as scripts are, against a script that stays loaded.
//!
//! A line of declarations becomes a module of its own, which knows the names of all lines before it. Statements, and an
//! expression, become the body of a mission that is driven once: so whatever a script can say, a line can say, and means the
//! same. The values that earlier lines have named, and those that the running mission knows, are put in place before it begins.

mod complete;
mod in_force;
mod value;

pub use in_force::{InForce, is_hidden};
pub(crate) use value::{Held, Known};
pub use value::{Left, Named};

use crate::check::{self, Module, Override};
use crate::code::Code;
use crate::diagnostic::{self, Diagnostic, Severity, has_error};
use crate::hir::{self, Hir, VarId};
use crate::loader::Loader;
use crate::source::{FileId, Source, Sources, Span};
use crate::syntax::{self, tree};
use crate::types::TypeTable;
use crate::{Library, Script, Wanted, lower, rules};
use albacore_geometry::Geodetic;
use albacore_program::{Program, Slot};
use std::collections::BTreeMap;
use std::sync::Arc;
use value::slots;

/// The mission that a line becomes. No script can declare a mission of this name.
pub(crate) const MISSION: &str = "line at the prompt";
/// What a line's value is called when the line gives it no name.
const VALUE: &str = "value of the line";
/// So many lines declare something at most: each is looked through again with each that follows.
const DECLARING_LINES_MAX: usize = 1000;
/// What is in force before any `with` is typed.
const SETPOINTS_AT_FIRST: &str = "with depth 3 m, speed 1.5 m/s";

/// A script, and the lines typed since it was loaded.
pub struct Prompt {
    sources: Sources,
    modules: Vec<Module>,
    known: BTreeMap<String, usize>,
    overrides: Vec<Override>,
    /// The setpoints and overlays that `with` has put in force.
    with: Vec<tree::WithItem>,
    /// The modules that declare those overlays, by names that nobody can type.
    with_modules: BTreeMap<String, usize>,
    /// For how many corners areas have room: for those of the largest of the script.
    area_room: u32,
    lines: usize,
}

/// What a line asks for.
pub enum Line {
    /// Nothing more: its declarations are known from here on, and these are their names.
    Declared(Vec<String>),
    /// Its setpoints and overlays: drive each of its values as that of an expression, keep them, and [put it in
    /// force](Prompt::put_in_force).
    With(InForce),
    /// An expression: drive it for one tick, without sending the command, and read its value.
    Value(Drive),
    /// Statements: drive them.
    Statements(Drive),
}

/// A line as a mission to be driven.
pub struct Drive {
    /// The mission.
    pub program: Program,
    /// Where the values of the known names go, in their order, before the first tick.
    pub known: Vec<Slot>,
    /// The value that the line leaves at its end.
    pub value: Option<Left>,
    /// The `var`s of the prompt, which the line may assign.
    pub vars: Vec<Left>,
    /// The inputs that the line itself reads, by their indices in the program.
    pub reads: Vec<u32>,
    /// It never ends by itself.
    pub endless: bool,
}

/// What came of a line: what it asks for, unless it cannot be understood; and what is to be said of it.
pub struct Read {
    /// What it asks for.
    pub line: Option<Line>,
    /// Errors and warnings, in the order of the text.
    pub findings: Vec<Diagnostic>,
}

impl Prompt {
    /// Loads a script for a prompt: what was found wrong with it is in the script, and may be nothing that a prompt minds.
    pub fn open(entry: Source, library: &dyn Library, wanted: &Wanted) -> (Prompt, Script) {
        let mut loader = Loader::new(library);
        loader.read_all(entry);
        let script = crate::finish(&mut loader, wanted);
        let Loader { sources, modules, known, .. } = loader;
        let (overrides, with_modules) = (script.overrides.clone(), BTreeMap::new());
        let (with, area_room) = (Vec::new(), script.area_room());
        let mut prompt = Prompt { sources, modules, known, overrides, with, with_modules, area_room, lines: 0 };
        let file = prompt.sources.add(Source { name: "<prompt>".into(), text: SETPOINTS_AT_FIRST.into() });
        for clause in syntax::parse_lines(file, SETPOINTS_AT_FIRST).0.clauses {
            if let tree::ClauseKind::With(items) = clause.kind {
                prompt.with = items;
            }
        }
        (prompt, script)
    }

    /// All that was read, lines included: for messages.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// Reads a line. `known` are the values that it may name, `origin` is where the vehicle's frame touches the globe.
    pub fn read(&mut self, library: &dyn Library, text: &str, known: &[Named], origin: Option<Geodetic>) -> Read {
        if is_item(text) { self.declare(library, text) } else { self.statements(library, text, known, origin) }
    }

    /// What is typed as a source of its own, so that messages can point into it.
    fn source(&mut self, text: &str) -> Source {
        self.lines += 1;
        Source { name: format!("line {}", self.lines).into(), text: text.into() }
    }

    /// A module that knows all that is known so far.
    fn module(&self, tree: tree::File) -> Module {
        let (top, module) = self.top();
        let imports = module.imports.iter().chain(&self.with_modules).map(|(name, leads)| (name.clone(), *leads));
        Module { tree: tree.into(), imports: imports.collect(), extends: Some(top), ..Module::default() }
    }

    /// The module of the latest line that declared something, else the script's.
    fn top(&self) -> (usize, &Module) {
        let latest = self.modules.iter().enumerate().rev().find(|(_, m)| m.extends.is_some());
        latest.unwrap_or((crate::MAIN, &self.modules[crate::MAIN]))
    }

    fn declare(&mut self, library: &dyn Library, text: &str) -> Read {
        let before = self.modules.len();
        let (top, imports) = (self.top().0, self.top().1.imports.clone());
        let source = self.source(text);
        let name = Arc::clone(&source.name);
        let mut loader = Loader::new(library);
        loader.sources = std::mem::take(&mut self.sources);
        loader.modules = std::mem::take(&mut self.modules);
        loader.known = std::mem::take(&mut self.known);
        let read = loader.read(source);
        let file = read.file;
        let module = loader.take(read, String::new(), false, &mut Vec::new());
        let mut findings = std::mem::take(&mut loader.findings);
        (self.sources, self.modules, self.known) = (loader.sources, loader.modules, loader.known);
        if self.modules.iter().filter(|m| m.extends.is_some()).count() >= DECLARING_LINES_MAX {
            let span = Span { file, start: 0, end: text.len() as u32 };
            let message = format!("more than {DECLARING_LINES_MAX} lines of this session declare something");
            let finding = Diagnostic::error(Code::ImportsMany, span, message);
            findings.push(finding.help("write the declarations into a file, and open it: `albacore repl FILE.alb`"));
        }
        let read = &mut self.modules[module];
        read.extends = Some(top);
        for (name, leads) in imports {
            read.imports.entry(name).or_insert(leads);
        }
        if !has_error(&findings) {
            // Earlier lines and the script were checked when they came.
            let of_new = |f: &Diagnostic| self.sources.get(f.span().file).name == name;
            let checked = check::check_with_room(&self.modules, library, self.overrides.clone(), self.area_room);
            findings.extend(checked.findings.into_iter().filter(of_new));
            findings.extend(check::too_large(&checked.types, Span { file, start: 0, end: text.len() as u32 }));
        }
        diagnostic::settle(&mut findings);
        if has_error(&findings) {
            self.modules.truncate(before);
            self.known.retain(|_, module| *module < before);
            return Read { line: None, findings };
        }
        let names = self.modules[module].tree.items.iter().flat_map(declared).collect();
        Read { line: Some(Line::Declared(names)), findings }
    }

    fn statements(&mut self, library: &dyn Library, text: &str, known: &[Named], origin: Option<Geodetic>) -> Read {
        let source = self.source(text);
        let file = self.sources.add(source);
        let (block, mut findings) = syntax::parse_lines(file, text);
        if has_error(&findings) {
            diagnostic::settle(&mut findings);
            return Read { line: None, findings };
        }
        let doubts = findings;
        let span = block.span;
        let mut clauses = block.clauses;
        if let [tree::Clause { kind: tree::ClauseKind::With(items), .. }] = clauses.as_slice() {
            return self.with(library, items, span, known, origin);
        }
        if let Some(place) = clauses.iter().find(|c| needs_a_table(&c.kind)) {
            let finding =
                Diagnostic::error(Code::PromptMisplaced, place.span, "this stands in a strategy or a mission")
                    .help("at the prompt stand expressions, statements, `let`, `with` and declarations");
            return Read { line: None, findings: vec![finding] };
        }
        // An expression alone is asked for its value, which a hidden `let` takes.
        let mut expression = false;
        let mut name = None;
        let mut held = Held::Fixed;
        let is_var = |name: &str| known.iter().any(|n| n.name == name && n.is_var());
        if let [clause] = clauses.as_mut_slice() {
            if let Some(given) = assigned(&clause.kind).filter(|given| is_var(given)) {
                (expression, name, held) = (true, Some(given.to_string()), Held::Var);
            }
            match &mut clause.kind {
                tree::ClauseKind::Timed(timed) if self.is_expression(timed) => {
                    expression = true;
                    let name = tree::Name { node: VALUE.to_string(), span };
                    clause.kind = tree::ClauseKind::Let { name, ty: None, value: timed.clone() };
                }
                tree::ClauseKind::Var { name, ty, value } => {
                    if let Some(tree::TyKind::List { order: Some((_, key)), .. }) = ty.as_ref().map(|ty| &ty.kind) {
                        let finding =
                            Diagnostic::error(Code::PromptValue, key.span, "the prompt keeps no list in order").help(
                                "leave `by` and its key out; a `memory` of a behavior or mission is kept in order",
                            );
                        return Read { line: None, findings: vec![finding] };
                    }
                    held = Held::Var;
                    let value = instant(value.clone());
                    clause.kind = tree::ClauseKind::Let { name: name.clone(), ty: ty.clone(), value };
                }
                _ => {}
            }
            match &mut clause.kind {
                tree::ClauseKind::Let { name: given, value, .. } if given.node != VALUE => {
                    expression = self.is_expression(value);
                    name = Some(given.node.clone());
                    // A name of the prompt may be given anew: its earlier value is still known while the line is read.
                    if known.iter().any(|n| n.name == given.node) {
                        given.node = VALUE.to_string();
                    }
                }
                _ => {}
            }
        }
        let left = name.clone().or_else(|| expression.then(|| VALUE.to_string()));
        let checked = match self.checked(library, clauses, span, known) {
            Ok(checked) => checked,
            Err(findings) => return Read { line: None, findings },
        };
        match self.drive(&checked, file, known, left.map(|left| (left, name, held)), origin) {
            Ok(drive) => {
                // What only a whole mission shows is asked of statements; an expression commands nothing.
                let line = if expression { Line::Value(drive) } else { Line::Statements(drive) };
                Read { line: Some(line), findings: doubts.into_iter().chain(checked.findings).collect() }
            }
            Err(findings) => Read { line: None, findings },
        }
    }

    /// Whether a statement is an expression, not a call that takes time.
    fn is_expression(&self, timed: &tree::Timed) -> bool {
        let tree::Action::Expr(e) = &timed.action else { return false };
        let callee = match &e.kind {
            tree::ExprKind::Call(callee, _) => callee,
            // Of what is chosen some stands for a value, and some is done.
            tree::ExprKind::If { then, otherwise, .. } => {
                return otherwise.as_ref().is_some_and(|o| self.gives_value(then) && self.gives_value(o));
            }
            tree::ExprKind::Match { arms, .. } => return arms.iter().all(|arm| self.gives_value(&arm.block)),
            _ => return !timed.is_modified(),
        };
        if e.list_changed().is_some() {
            return false;
        }
        self.activity(callee).is_none() && !timed.is_modified()
    }

    /// The activity that a name or a path calls here, with the module that declares it.
    fn activity(&self, callee: &tree::Expr) -> Option<(usize, &tree::Activity)> {
        let declared = |module: usize, name: &str| {
            let activities = self.modules[module].tree.items.iter().filter_map(|item| match item {
                tree::Item::Activity(activity) => Some(activity),
                _ => None,
            });
            activities.into_iter().find(|activity| activity.name.node == name).map(|activity| (module, activity))
        };
        let (top, module) = self.top();
        match &callee.kind {
            tree::ExprKind::Name(name) => std::iter::successors(Some(top), |&m| self.modules[m].extends)
                .chain((0..self.modules.len()).filter(|&m| self.modules[m].prelude))
                .find_map(|m| declared(m, name)),
            tree::ExprKind::Member(base, member) => match &base.kind {
                tree::ExprKind::Name(name) => {
                    let module = self.with_modules.get(name).or_else(|| module.imports.get(name))?;
                    declared(*module, &member.node)
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether a block ends in an expression.
    fn gives_value(&self, block: &tree::Block) -> bool {
        let last = block.clauses.last();
        last.is_some_and(|c| matches!(&c.kind, tree::ClauseKind::Timed(timed) if self.is_expression(timed)))
    }

    /// Checks a line as the body of a mission.
    fn checked(
        &self,
        library: &dyn Library,
        clauses: Vec<tree::Clause>,
        span: Span,
        known: &[Named],
    ) -> Result<Checked, Vec<Diagnostic>> {
        self.checked_with(library, self.with.clone(), clauses, span, known)
    }

    /// The same with other setpoints and overlays in force.
    fn checked_with(
        &self,
        library: &dyn Library,
        with: Vec<tree::WithItem>,
        clauses: Vec<tree::Clause>,
        span: Span,
        known: &[Named],
    ) -> Result<Checked, Vec<Diagnostic>> {
        let with = tree::Clause { kind: tree::ClauseKind::With(with), span };
        let body = tree::Block { clauses: std::iter::once(with).chain(clauses).collect(), span };
        let mission = tree::Activity {
            kind: tree::ActivityKind::Mission { scenario: None, within: None },
            name: tree::Name { node: MISSION.to_string(), span },
            params: Vec::new(),
            result: None,
            body,
        };
        let mut module = self.module(tree::File { items: vec![tree::Item::Activity(mission)] });
        module.known = Some(known.iter().map(Named::known).collect());
        let mut modules = self.modules.clone();
        modules.push(module);
        let checked = check::check_with_room(&modules, library, self.overrides.clone(), self.area_room);
        let check::Checked { hir, types, findings, .. } = checked;
        let mission = hir.activities.iter().rposition(|a| a.full_name == MISSION).unwrap_or_default();
        // A line has no area, no limit in time and no recovery: the person at the prompt is there. Other findings are of
        // sources that were looked at before.
        let mut findings: Vec<Diagnostic> =
            findings.into_iter().filter(|f| f.span().file == span.file && f.code.group() != "missions").collect();
        findings.extend(check::too_large(&types, span));
        if !has_error(&findings) {
            // What a line reads and has not come is told when it is driven.
            let meant = |f: &Diagnostic| f.severity == Severity::Error && f.code.group() != "missions";
            findings.extend(rules::check(&hir, &types, mission).into_iter().filter(meant));
        }
        if let Some(place) = hir.first_watch(mission) {
            findings.push(
                Diagnostic::error(Code::TimeControl, place, "at the prompt the vehicle is yours already")
                    .help("`watch` and `override` belong to a mission that is run as a guest of its vehicle"),
            );
        }
        diagnostic::settle(&mut findings);
        if has_error(&findings) {
            return Err(findings);
        }
        let endless = check::never_ends(&hir, mission);
        Ok(Checked { hir, types, mission, findings, endless })
    }

    /// Lowers a line that was checked. What it leaves is the variable of a name, to be held under a name or none.
    fn drive(
        &self,
        checked: &Checked,
        file: FileId,
        known: &[Named],
        left: Option<(String, Option<String>, Held)>,
        origin: Option<Geodetic>,
    ) -> Result<Drive, Vec<Diagnostic>> {
        let Checked { hir, types, mission, .. } = checked;
        let program = lower::line(hir, types, &self.sources, *mission, origin)?;
        let activity = &hir.activities[*mission];
        let base = program.mission.base;
        let slots = slots(types, &activity.vars);
        let slot = |id: VarId| base + slots[id];
        let leaves = |id: VarId, name: Option<String>, held: Held| {
            let hir::Var { ty, range, .. } = activity.vars[id].clone();
            let range = if held == Held::Var { check::range_of_var(&ty, range) } else { range };
            Left { name, slot: slot(id), shape: types.shape(&ty), ty, held, range }
        };
        let value = left.and_then(|(wanted, name, held)| {
            let id = activity.vars.iter().rposition(|v| v.name == wanted || v.name == VALUE)?;
            Some(leaves(id, name, held))
        });
        let vars = known.iter().enumerate().filter(|(_, named)| named.is_var());
        let vars = vars.map(|(id, named)| leaves(id, Some(named.name.clone()), Held::Var)).collect();
        if let Some(left) = &value {
            left.can_be_kept(activity.span)?;
        }
        let reads = rules::inputs_read(hir, *mission)
            .into_iter()
            .filter(|(_, span)| span.file == file)
            .map(|(input, _)| input as u32)
            .collect();
        Ok(Drive { known: (0..known.len()).map(slot).collect(), program, value, vars, reads, endless: checked.endless })
    }
}

/// A line that is sound.
struct Checked {
    hir: Hir,
    types: TypeTable,
    mission: usize,
    findings: Vec<Diagnostic>,
    endless: bool,
}

/// The name whose value a clause changes at once.
fn assigned(kind: &tree::ClauseKind) -> Option<&str> {
    let list = match kind {
        tree::ClauseKind::Assign { name, .. } => return Some(&name.node),
        tree::ClauseKind::Timed(tree::Timed { action: tree::Action::Expr(e), .. }) => e.list_changed()?,
        _ => return None,
    };
    if let tree::ExprKind::Name(name) = &list.kind { Some(name) } else { None }
}

/// A value that takes no time.
fn instant(value: tree::Expr) -> tree::Timed {
    let span = value.span;
    let action = tree::Action::Expr(value);
    tree::Timed { action, duration: None, until: None, within: None, at: Vec::new(), repeated: None, span }
}

/// Whether a text begins as what stands at the left margin of a file.
fn is_item(text: &str) -> bool {
    let word: String = text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    let after = text.trim_start()[word.len()..].trim_start();
    syntax::words::begins_item(&word) && after.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '"')
}

/// Whether a clause means something in a table or among the declarations of a mission only.
fn needs_a_table(kind: &tree::ClauseKind) -> bool {
    use tree::ClauseKind::*;
    matches!(
        kind,
        Start(_)
            | Rule(_)
            | Area { .. }
            | Limits(_)
            | Requires(_)
            | Recovery { .. }
            | Recording { .. }
            | Amend(_)
            | Finish(_)
            | Memory { .. }
            | Signal { .. }
            | Reaction { .. }
            | Behavior(_)
            | Abort { .. }
    )
}

fn declared(item: &tree::Item) -> Vec<String> {
    use tree::Item::*;
    match item {
        Use(paths) => paths.iter().filter_map(|p| p.parts.last()).map(|p| p.node.clone()).collect(),
        Const(c) => vec![c.name.node.clone()],
        Enum { name, .. }
        | Record { name, .. }
        | Unit { name, .. }
        | Input { name, .. }
        | Clause { name, .. }
        | Payload { name, .. } => {
            vec![name.node.clone()]
        }
        Signal { name, .. } | Scenario { name, .. } | Vehicle { name, .. } => vec![name.node.clone()],
        Fn(f) => vec![f.name.node.clone()],
        Activity(a) => vec![a.name.node.clone()],
        Test(test) => vec![format!("test \"{}\"", literal(&test.name))],
    }
}

/// What a text without holes says.
fn literal(text: &tree::Expr) -> String {
    let tree::ExprKind::Text(parts) = &text.kind else { return String::new() };
    let literals = parts.iter().filter_map(|part| match part {
        tree::TextPart::Literal(literal) => Some(literal.as_str()),
        tree::TextPart::Hole(_) => None,
    });
    literals.collect()
}
