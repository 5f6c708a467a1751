//! `with` at the prompt: what is in force for all lines that follow, computed once.

use super::{Drive, Held, Line, Named, Prompt, Read, declared, instant};
use crate::Library;
use crate::check::Module;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::tree;
use albacore_geometry::Geodetic;
use albacore_program::{Axis, Channel};

/// Setpoints and overlays that are to be in force.
pub struct InForce {
    /// The values that they are made of, each under a name that nobody can type.
    pub values: Vec<Drive>,
    /// With those names in place of what was written.
    items: Vec<tree::WithItem>,
    /// The modules that declare the overlays, by the names under which the items call them: what is declared anew later is another.
    modules: Vec<(String, usize)>,
}

/// Whether a name holds a value of a `with`: no name that is written has a blank.
pub fn is_hidden(name: &str) -> bool {
    name.contains(' ')
}

impl Prompt {
    /// Setpoints and overlays for all lines that follow: a channel's new owner replaces the one before. Their values are computed
    /// now, and stay (section 7), and so do the declarations of overlays.
    pub(super) fn with(
        &self,
        library: &dyn Library,
        items: &[tree::WithItem],
        span: Span,
        known: &[Named],
        origin: Option<Geodetic>,
    ) -> Read {
        let with = self.with_also(items.to_vec());
        let checked = self.checked_with(library, with, Vec::new(), span, known);
        let read = checked.and_then(|checked| {
            self.drive(&checked, span.file, known, None, origin)?;
            let mut values = Vec::new();
            let mut items = items.to_vec();
            for written in items.iter_mut().flat_map(values_of).filter(|e| !is_plain(e)) {
                let name = format!("with {} {}", self.lines, values.len());
                let node = tree::Name { node: name.clone(), span: written.span };
                let kind = tree::ClauseKind::Let { name: node, ty: None, value: instant(written.clone()) };
                let line = vec![tree::Clause { kind, span: written.span }];
                let left = Some((name.clone(), Some(name.clone()), Held::Fixed));
                let value = self.checked(library, line, span, known);
                match value.and_then(|line| self.drive(&line, span.file, known, left, origin)) {
                    Ok(value) => {
                        written.kind = tree::ExprKind::Name(name);
                        values.push(value);
                    }
                    Err(findings) if self.can_change(written, known, &findings) => return Err(findings),
                    // Its type is known only where it stands, as that of `vector(…)`, and no line changes it.
                    Err(_) => {}
                }
            }
            let modules = items.iter_mut().filter_map(|item| self.bind(item)).collect();
            Ok((checked.findings, InForce { values, items, modules }))
        });
        match read {
            Ok((findings, in_force)) => Read { line: Some(Line::With(in_force)), findings },
            Err(findings) => Read { line: None, findings },
        }
    }

    /// From here on setpoints and overlays are in force; what they are made of has been kept.
    pub fn put_in_force(&mut self, with: InForce) {
        self.with_modules.extend(with.modules);
        self.with = self.with_also(with.items);
    }

    /// Lets an overlay be called from the module that declares it, by whatever names later lines give; gives the name of that module.
    fn bind(&self, item: &mut tree::WithItem) -> Option<(String, usize)> {
        let tree::WithItem::Overlay(overlay) = item else { return None };
        let callee = callee_mut(overlay);
        let (module, activity) = self.activity(callee)?;
        let name = format!("with {module}");
        let base = tree::Expr { kind: tree::ExprKind::Name(name.clone()), ..callee.clone() };
        let member = tree::Name { node: activity.name.node.clone(), span: callee.span };
        callee.kind = tree::ExprKind::Member(Box::new(base), member);
        Some((name, module))
    }

    /// The channel that a setpoint or an overlay owns.
    fn axis(&self, item: &tree::WithItem) -> Option<Axis> {
        match item {
            tree::WithItem::Setpoint(setpoint) => {
                Channel::named(&setpoint.channel.node).map(|channel| channel.row().axis)
            }
            tree::WithItem::Overlay(overlay) => match &self.activity(callee(overlay))?.1.kind {
                tree::ActivityKind::Overlay { does: Some((_, channel)) } => Axis::named(&channel.node),
                _ => None,
            },
        }
    }

    /// Whether what cannot be kept would be another value, or of another type, when it is computed for a later line: a text, and what a
    /// name is in that a line may give anew.
    fn can_change(&self, written: &tree::Expr, known: &[Named], findings: &[Diagnostic]) -> bool {
        let words = self.sources.text(written.span).split(|c: char| !c.is_alphanumeric() && c != '_');
        let is_text = findings.iter().any(|finding| finding.code == Code::PromptValue);
        let declares = |module: &Module, word: &str| {
            module.tree.items.iter().any(|item| declared(item).iter().any(|name| name == word))
        };
        let is_declared = |word: &str| self.modules.iter().any(|module| !module.prelude && declares(module, word));
        is_text || words.into_iter().any(|word| known.iter().any(|named| named.name == word) || is_declared(word))
    }

    fn with_also(&self, items: Vec<tree::WithItem>) -> Vec<tree::WithItem> {
        let mut with = self.with.clone();
        with.retain(|old| self.axis(old).is_none_or(|axis| !items.iter().any(|new| self.axis(new) == Some(axis))));
        with.extend(items);
        with
    }
}

/// What an overlay is called by.
fn callee(overlay: &tree::Expr) -> &tree::Expr {
    if let tree::ExprKind::Call(callee, _) = &overlay.kind { callee } else { overlay }
}

fn callee_mut(overlay: &mut tree::Expr) -> &mut tree::Expr {
    match overlay {
        tree::Expr { kind: tree::ExprKind::Call(callee, _), .. } => callee,
        other => other,
    }
}

/// What a setpoint or an overlay is made of.
fn values_of(item: &mut tree::WithItem) -> Vec<&mut tree::Expr> {
    match item {
        tree::WithItem::Setpoint(setpoint) => vec![&mut setpoint.value],
        tree::WithItem::Overlay(overlay) => match &mut overlay.kind {
            tree::ExprKind::Call(_, args) => args.iter_mut().map(|arg| &mut arg.value).collect(),
            _ => Vec::new(),
        },
    }
}

/// Whether a value is the same whenever it is computed, as it is written.
fn is_plain(e: &tree::Expr) -> bool {
    match &e.kind {
        tree::ExprKind::Number { .. } | tree::ExprKind::Bool(_) | tree::ExprKind::None => true,
        tree::ExprKind::Text(parts) => parts.iter().all(|part| matches!(part, tree::TextPart::Literal(_))),
        _ => false,
    }
}
