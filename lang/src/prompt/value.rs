//! Values at the prompt: those that a line leaves, and those that lines can name.

use crate::Script;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{self, Interval, VarKind};
use crate::source::Span;
use crate::types::{Type, TypeTable};
use albacore_program::{Program, Shape, Slot};

/// What lines may do with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// A `let` of the prompt: it stays as it is until its name is given again.
    Fixed,
    /// A `var` of the prompt: it can be assigned, and keeps its type.
    Var,
    /// A name of the mission that is under way, which alone changes its value.
    Mission,
}

/// What a line needs to know of a value to be checked.
#[derive(Clone, Debug)]
pub(crate) struct Known {
    pub name: String,
    pub ty: Type,
    pub held: Held,
    /// What the value lies in.
    pub range: Interval,
}

impl Known {
    /// As what the name stands in a line. A `var` of the prompt outlasts lines that take time, as a memory does.
    pub fn kind(&self) -> VarKind {
        if self.held == Held::Var { VarKind::Memory } else { VarKind::Let }
    }
}

/// A value with a name, which lines can use.
#[derive(Clone, Debug)]
pub struct Named {
    /// The name.
    pub name: String,
    /// The words of the value.
    pub words: Vec<f64>,
    /// How they are read.
    pub shape: Shape,
    pub(super) ty: Type,
    pub(super) held: Held,
    pub(super) range: Interval,
}

impl Named {
    pub(super) fn known(&self) -> Known {
        Known { name: self.name.clone(), ty: self.ty.clone(), held: self.held, range: self.range }
    }

    /// Whether lines may assign it.
    pub fn is_var(&self) -> bool {
        self.held == Held::Var
    }

    /// Whether this and another are values of one `var`.
    pub fn is_same_var(&self, other: &Named) -> bool {
        self.is_var()
            && (&self.name, &self.ty, self.held, self.range) == (&other.name, &other.ty, other.held, other.range)
    }
}

/// A value that a line leaves.
#[derive(Clone, Debug)]
pub struct Left {
    /// The name it is to have; none for the value of an expression.
    pub name: Option<String>,
    /// Where it is.
    pub slot: Slot,
    /// How its words are read.
    pub shape: Shape,
    pub(super) ty: Type,
    pub(super) held: Held,
    pub(super) range: Interval,
}

impl Left {
    /// No value: what most statements leave.
    pub fn nothing() -> Self {
        let (held, range) = (Held::Fixed, Interval::ANY);
        Left { name: None, slot: 0, shape: Shape::Bool, ty: Type::Unknown, held, range }
    }

    /// Whether the value means the same when it is used again: texts are of the program that they stand in.
    pub(super) fn can_be_kept(&self, span: Span) -> Result<(), Vec<Diagnostic>> {
        let finding =
            |message: &str, help: &str| Err(vec![Diagnostic::error(Code::PromptValue, span, message).help(help)]);
        if self.name.is_some() && self.shape.has_text() {
            return finding("a text cannot be given a name at the prompt", "write it where it is used");
        }
        match &self.ty {
            Type::Unknown | Type::None => finding("the type of this cannot be told", "use it where a type is expected"),
            _ => Ok(()),
        }
    }

    /// Its words, of the words of the run.
    pub fn of<'a>(&self, words: &'a [f64]) -> &'a [f64] {
        let at = self.slot as usize;
        words.get(at..at + self.shape.words() as usize).unwrap_or(&[])
    }

    /// The value, taken from the words of the run.
    pub fn taken(&self, words: &[f64]) -> Named {
        let words = self.of(words).to_vec();
        let name = self.name.clone().unwrap_or_default();
        Named { name, words, shape: self.shape.clone(), ty: self.ty.clone(), held: self.held, range: self.range }
    }

    /// Whether it is a time, as `run` takes one.
    pub fn is_duration(&self) -> bool {
        self.ty == Type::Quantity(crate::dimension::Dimension::TIME)
    }
}

impl Script {
    /// What an activity of a lowered mission calls its parameters, signals, memories and area, with the places of their
    /// values from the base of its frame. `words` are the words from that base on, `outer` is the activity around it.
    pub fn names_of(&self, program: &Program, outer: Option<u32>, activity: u32, words: &[f64]) -> Vec<Named> {
        let lowered = |activity: u32| program.activities.get(activity as usize);
        let is = |a: &hir::Activity, id: u32| {
            lowered(id).is_some_and(|lowered| a.name == lowered.name && self.sources.place(a.span) == lowered.place)
        };
        // A strategy that is derived has behaviors that stand in its base.
        let is_in = |owner: hir::ActivityId| outer.is_some_and(|outer| is(&self.hir.activities[owner], outer));
        let is_it = |a: &&hir::Activity| is(a, activity) && a.owner.is_none_or(is_in);
        let Some(found) = self.hir.activities.iter().find(is_it) else { return Vec::new() };
        // A nested behavior shares the frame of its strategy.
        let vars = &self.hir.activities[found.owner.unwrap_or_else(|| self.index_of(found))].vars;
        let declared = found.decls.iter().filter_map(|decl| match decl {
            hir::Decl::Signal(id, _) | hir::Decl::Memory(id, _) | hir::Decl::Area(id, _) => Some(*id),
            hir::Decl::With(_) => None,
        });
        let (mut names, slots) = (Vec::new(), slots(&self.types, vars));
        for id in (0..found.params).chain(declared) {
            let at = slots[id] as usize;
            let shape = self.types.shape(&vars[id].ty);
            // A text is of the mission's program, and means nothing in that of another line.
            if shape.has_text() {
                continue;
            }
            if let Some(words) = words.get(at..at + shape.words() as usize) {
                names.push(Named {
                    name: vars[id].name.clone(),
                    words: words.to_vec(),
                    shape,
                    ty: vars[id].ty.clone(),
                    held: Held::Mission,
                    range: vars[id].range,
                });
            }
        }
        names
    }

    fn index_of(&self, activity: &hir::Activity) -> usize {
        self.hir.activities.iter().position(|a| std::ptr::eq(a, activity)).unwrap_or_default()
    }
}

/// Where each variable is in the frame of its unit: they lie one after the other, in the order of their declaration.
pub(super) fn slots(types: &TypeTable, vars: &[hir::Var]) -> Vec<Slot> {
    let mut next = 0;
    let slots = vars.iter().map(|var| {
        let slot = next;
        next += types.words(&var.ty);
        slot
    });
    slots.collect()
}
