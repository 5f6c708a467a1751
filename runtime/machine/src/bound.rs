//! Code bound to its frame. Most code runs in one frame all its life: when it is first run there, the words of its operands are found
//! once and for all. Code that runs in another frame too finds them anew each time, as the program has them.

use crate::compute::place;
use albacore_program::{Addr, Compute, Op, Program, Slot};

/// The base of no frame: nothing has been run there.
const UNBOUND: Slot = Slot::MAX;
/// ... or it leads to code that is bound to another frame.
const SHARED: Slot = Slot::MAX - 1;

/// A program's instructions, as far as they have been run. It is no part of a run's state: nothing depends on it but time.
#[derive(Debug, Default)]
pub(crate) struct Bound {
    /// The program's, each at its own address; operands of the bound ones on words are counted from the first word of the run.
    ops: Vec<Op>,
    /// For each the base of the frame that it is bound to.
    bases: Vec<Slot>,
}

/// A copy of a run binds its code anew: the prompt keeps many, and runs few of them on.
impl Clone for Bound {
    fn clone(&self) -> Self {
        Bound::default()
    }
}

impl Bound {
    /// The instructions.
    pub fn ops(&self) -> &[Op] {
        &self.ops
    }

    /// Whether those from an address on are bound to the frame at a base.
    #[inline]
    pub fn holds(&self, entry: usize, base: Slot) -> bool {
        self.bases.get(entry).is_some_and(|bound| *bound == base)
    }

    /// Binds what can be reached from an address on without leaving its piece of code, unless some of it is bound to another frame.
    #[cold]
    pub fn bind(&mut self, p: &Program, entry: Addr, base: Slot) -> bool {
        if self.bases.get(entry as usize).is_some_and(|bound| *bound != UNBOUND) {
            return false;
        }
        if self.ops.is_empty() {
            self.ops.clone_from(&p.ops);
            self.bases = vec![UNBOUND; p.ops.len()];
        }
        let mut reached = Vec::new();
        let mut next = vec![entry];
        while let Some(at) = next.pop() {
            let (Some(op), Some(bound)) = (p.ops.get(at as usize), self.bases.get_mut(at as usize)) else { continue };
            if *bound == base {
                continue;
            }
            if *bound != UNBOUND {
                reached.into_iter().for_each(|at: Addr| self.bases[at as usize] = UNBOUND);
                self.bases[entry as usize] = SHARED;
                return false;
            }
            *bound = base;
            reached.push(at);
            next.extend(op.jump());
            if !op.ends() {
                next.push(at + 1);
            }
        }
        for at in reached {
            if let Op::Compute(op) = p.ops[at as usize] {
                self.ops[at as usize] = Compute::with_slots(op, |slot| place(slot, base)).into();
            }
        }
        true
    }
}
