//! What a condition is made of: code that only those execute who ask why it held or did not.

use super::Lowering;
use crate::hir::{Builtin, Decl, Expr, ExprKind, VarId};
use albacore_program::{Addr, Code, Compute, Op, Slot, Terms};
use std::collections::BTreeMap;

/// The word of a term that was not asked.
const UNASKED: f64 = -1.0;

/// A condition has so many terms at most; more are left out.
const TERMS_MAX: usize = 64;

/// A condition, or a part of one.
enum Part<'e> {
    And(Box<Part<'e>>, Box<Part<'e>>),
    Or(Box<Part<'e>>, Box<Part<'e>>),
    /// What decides by itself; its text, and what it is made of, which is asked for its own sake.
    Term(&'e Expr, Option<Box<Part<'e>>>),
}

/// Finds the parts of a condition.
struct Finder<'e> {
    /// The signals that have not been met yet: each is taken apart once.
    signals: BTreeMap<VarId, &'e Expr>,
    terms: usize,
}

impl<'a> Lowering<'a> {
    /// The terms of a condition of an activity; none where it is one itself.
    pub(super) fn terms(&mut self, activity: usize, condition: &Expr) -> Option<Terms> {
        let signal = |decl: &'a Decl| match decl {
            Decl::Signal(var, e) => Some((*var, e)),
            _ => None,
        };
        let signals = self.hir.activities[self.owner_of(activity)].decls.iter().filter_map(signal).collect();
        let part = Finder { signals, terms: 0 }.part(condition);
        let mut texts = Vec::new();
        self.texts_of(&part, 0, &mut texts);
        if texts.len() < 2 {
            return None;
        }
        // What no run executes is none of its instructions.
        let emitted = self.emitted;
        let value = self.lasting(texts.len() as u32);
        let entry = self.here();
        for (word, _) in (value..).zip(&texts) {
            self.emit(Compute::Const { to: word, value: UNASKED });
        }
        let fails = self.ask_terms(&part, &mut value.clone());
        self.land_all(fails);
        self.emit(Op::Return);
        self.emitted = emitted;
        Some(Terms { code: Code { entry, value }, texts })
    }

    fn texts_of(&self, part: &Part, depth: u32, out: &mut Vec<(String, u32)>) {
        match part {
            Part::And(a, b) | Part::Or(a, b) => {
                self.texts_of(a, depth, out);
                self.texts_of(b, depth, out);
            }
            Part::Term(term, made_of) => {
                out.push((self.sources.text(term.span).to_string(), depth));
                made_of.iter().for_each(|part| self.texts_of(part, depth + 1, out));
            }
        }
    }

    /// Code that goes on behind itself where a condition holds, and leaves a word for each of its terms, in the order of
    /// [`Self::texts_of`]; gives the jumps that are taken where it does not. A term is asked only where those before it have left it
    /// open: what they have shown it may rely on.
    fn ask_terms(&mut self, part: &Part, word: &mut Slot) -> Vec<Addr> {
        match part {
            Part::And(a, b) => {
                let mut fails = self.ask_terms(a, word);
                fails.extend(self.ask_terms(b, word));
                fails
            }
            Part::Or(a, b) => {
                let fails = self.ask_terms(a, word);
                let holds = self.emit(Compute::jump(0));
                self.land_all(fails);
                let fails = self.ask_terms(b, word);
                self.land(holds);
                fails
            }
            Part::Term(term, made_of) => {
                let to = *word;
                *word += 1;
                if let Some(part) = made_of {
                    let fails = self.ask_terms(part, word);
                    self.land_all(fails);
                }
                let fails = self.jumps_unless(term);
                self.emit(Compute::Const { to, value: 1.0 });
                let holds = self.emit(Compute::jump(0));
                self.land_all(fails);
                self.emit(Compute::Const { to, value: 0.0 });
                let fails = self.emit(Compute::jump(0));
                self.land(holds);
                vec![fails]
            }
        }
    }
}

impl<'e> Finder<'e> {
    /// The parts between `and` and `or`; of one that is held over time what it holds, and of a signal what that is made of.
    fn part(&mut self, condition: &'e Expr) -> Part<'e> {
        let mut two = |a: &'e Expr, b: &'e Expr| (Box::new(self.part(a)), Box::new(self.part(b)));
        match &condition.kind {
            ExprKind::Do(Builtin::And, operands) if operands.len() == 2 => {
                let (a, b) = two(&operands[0], &operands[1]);
                Part::And(a, b)
            }
            ExprKind::Do(Builtin::Or, operands) if operands.len() == 2 => {
                let (a, b) = two(&operands[0], &operands[1]);
                Part::Or(a, b)
            }
            _ => {
                self.terms += 1;
                let made_of = self.made_of(condition).filter(|_| self.terms < TERMS_MAX);
                Part::Term(condition, made_of.map(|inner| Box::new(self.part(inner))))
            }
        }
    }

    fn made_of(&mut self, term: &'e Expr) -> Option<&'e Expr> {
        match &term.kind {
            ExprKind::HeldFor(held, _) | ExprKind::Becomes(held) => Some(held),
            ExprKind::Do(Builtin::Not, operands) => self.signal(operands.first()?),
            _ => self.signal(term),
        }
    }

    fn signal(&mut self, term: &Expr) -> Option<&'e Expr> {
        let ExprKind::Var(var) = term.kind else { return None };
        self.signals.remove(&var)
    }
}
