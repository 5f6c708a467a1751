//! What a condition is made of: code that only those execute who ask why it held or did not.

use super::Lowering;
use crate::hir::{Builtin, Expr, ExprKind};
use albacore_program::{Addr, Code, Compute, Op, Slot, Terms};

/// The word of a term that was not asked.
const UNASKED: f64 = -1.0;

impl Lowering<'_> {
    /// The terms of a condition; none where it is one itself.
    pub(super) fn terms(&mut self, condition: &Expr) -> Option<Terms> {
        let mut texts = Vec::new();
        self.texts_of(condition, false, &mut texts);
        if texts.len() < 2 {
            return None;
        }
        let value = self.lasting(texts.len() as u32);
        let entry = self.here();
        for (word, _) in (value..).zip(&texts) {
            self.emit(Compute::Const { to: word, value: UNASKED });
        }
        let fails = self.ask_terms(condition, &mut value.clone());
        self.land_all(fails);
        self.emit(Op::Return);
        Some(Terms { code: Code { entry, value }, texts })
    }

    /// The terms between `and` and `or` in their order, and behind one that is held over time those of what it holds.
    fn texts_of(&self, condition: &Expr, inside: bool, out: &mut Vec<(String, bool)>) {
        match &condition.kind {
            ExprKind::Do(Builtin::And | Builtin::Or, operands) if operands.len() == 2 => {
                operands.iter().for_each(|operand| self.texts_of(operand, inside, out));
            }
            kind => {
                out.push((self.sources.text(condition.span).to_string(), inside));
                if let ExprKind::HeldFor(held, _) | ExprKind::Becomes(held) = kind {
                    self.texts_of(held, true, out);
                }
            }
        }
    }

    /// Code that goes on behind itself where a condition holds, and leaves a word for each of its terms, in the order of
    /// [`Self::texts_of`]; gives the jumps that are taken where it does not. A term is asked only where those before it have left it
    /// open: what they have shown it may rely on.
    fn ask_terms(&mut self, condition: &Expr, word: &mut Slot) -> Vec<Addr> {
        match &condition.kind {
            ExprKind::Do(op @ (Builtin::And | Builtin::Or), operands) if operands.len() == 2 => {
                let mut fails = self.ask_terms(&operands[0], word);
                if *op == Builtin::And {
                    fails.extend(self.ask_terms(&operands[1], word));
                    return fails;
                }
                let holds = self.emit(Compute::jump(0));
                self.land_all(fails);
                let fails = self.ask_terms(&operands[1], word);
                self.land(holds);
                fails
            }
            kind => {
                let to = *word;
                *word += 1;
                if let ExprKind::HeldFor(held, _) | ExprKind::Becomes(held) = kind {
                    let fails = self.ask_terms(held, word);
                    self.land_all(fails);
                }
                let fails = self.jumps_unless(condition);
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
