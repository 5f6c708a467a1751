//! What the checker takes variables to be, word for word, for whoever computes the ranges of the code anew.

use super::Lowering;
use crate::hir::{ELAPSED, Interval, Var, VarKind};
use crate::types::{Type, is_number};
use albacore_arithmetic::counted;
use albacore_program::{ABSOLUTE, Addr, Claim, GRID_WORDS, Input, Slot, Unit, senses};

impl<'a> Lowering<'a> {
    /// What is claimed of the variables of a function or an activity whose code begins there and has just been made.
    pub(super) fn claim_unit(&mut self, begin: Addr, words: u64, vars: &[Var], slots: &[Slot]) {
        let mut unit = Unit { code: begin..self.here(), words: super::slot(words), ..Unit::default() };
        for (var, &slot) in vars.iter().zip(slots) {
            let first = unit.claims.len();
            self.claims_of(&var.ty, slot, None, &mut unit.claims);
            let number = if var.ty.is_optional() { slot + 1 } else { slot };
            if var.range != Interval::ANY && is_number(var.ty.present()) {
                match unit.claims[first..].iter_mut().find(|claim| claim.slot == number) {
                    Some(claim) => claim.range = var.range,
                    None => unit.claims.push(Claim {
                        slot: number,
                        range: var.range,
                        is_whole: false,
                        present: var.ty.is_optional().then_some(slot),
                        is_param: false,
                    }),
                }
            }
            unit.claims[first..].iter_mut().for_each(|claim| claim.is_param = var.kind == VarKind::Param);
            match var.ty {
                Type::List(..) => unit.lists.push((slot, self.words(&var.ty))),
                Type::Map(..) => unit.lists.push((slot.saturating_add(GRID_WORDS), self.words(&var.ty) - GRID_WORDS)),
                _ => {}
            }
            if matches!(var.kind, VarKind::Param | VarKind::Signal | VarKind::Let | VarKind::Loop) {
                unit.standing.push((slot, self.words(&var.ty)));
            }
        }
        self.claims.units.push(unit);
    }

    /// What is claimed of the words of inputs: their types.
    pub(super) fn claim_inputs(&mut self) {
        let mut claims = Vec::new();
        for (input, placed) in self.hir.inputs.iter().zip(&self.program.inputs) {
            let mut at = ABSOLUTE | placed.at.saturating_add(Input::VALUE);
            for ty in std::iter::once(&input.ty).chain(input.fields.iter().map(|(_, ty)| ty)) {
                self.claims_of(ty, at, None, &mut claims);
                at = at.saturating_add(self.words(ty));
            }
        }
        let elapsed = self.hir.inputs.iter().position(|input| input.name == senses::ELAPSED);
        claims.extend(elapsed.and_then(|id| self.program.inputs.get(id)).map(|placed| Claim {
            slot: ABSOLUTE | placed.at.saturating_add(Input::VALUE),
            range: ELAPSED,
            is_whole: false,
            present: None,
            is_param: false,
        }));
        // No sample is held to the two values of a sign.
        claims.iter_mut().filter(|claim| claim.range == Interval::SIGN).for_each(|claim| claim.range = Interval::INT);
        self.claims.inputs = claims;
    }

    /// What the instruction just made leaves, where its type says more than can be computed.
    pub(super) fn typed(&mut self, slot: Slot, ty: &Type) {
        let mut claims = Vec::new();
        self.claims_of(ty, slot, None, &mut claims);
        let at = self.here().saturating_sub(1);
        self.claims.typed.extend(claims.into_iter().map(|claim| (at, claim)));
    }

    /// What a type says of the words of a value: a number that counts is whole, a sign is 1 or -1.
    fn claims_of(&self, ty: &Type, slot: Slot, present: Option<Slot>, out: &mut Vec<Claim>) {
        let whole = |range| Claim { slot, range, is_whole: true, present, is_param: false };
        match ty {
            Type::Int => out.push(whole(Interval::INT)),
            Type::Sign => out.push(whole(Interval::SIGN)),
            Type::List(_, capacity) => out.push(whole(counted(*capacity))),
            Type::Map(_, cells) => out.push(Claim { slot: slot.saturating_add(GRID_WORDS), ..whole(counted(*cells)) }),
            Type::Optional(inner) if present.is_none() => self.claims_of(inner, slot + 1, Some(slot), out),
            Type::Record(id) => {
                let mut at = slot;
                for (_, field) in &self.types.records[*id].fields {
                    self.claims_of(field, at, present, out);
                    at = at.saturating_add(self.words(field));
                }
            }
            _ => {}
        }
    }
}
