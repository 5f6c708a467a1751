//! Strategies that are derived from others.

use super::{Callable, Generator, Name, Ty};

/// A strategy as it stands: the names that it had before its declarations and behind them, and its behaviors, with whether each ends.
#[derive(Clone, Debug)]
pub struct Base {
    pub name: String,
    pub outside: Vec<Name>,
    pub inside: Vec<Name>,
    pub behaviors: Vec<(String, bool)>,
}

impl Generator {
    pub(super) fn derived_strategies(&mut self) {
        for _ in 0..self.random.below(3) {
            self.budget = 20;
            let base = self.bases[self.random.below(self.bases.len())].clone();
            self.derived(base);
        }
    }

    fn derived(&mut self, base: Base) {
        self.count("derived strategy");
        let name = self.fresh("plan");
        let of_base = self.behaviors.iter().find(|callable| callable.name == base.name);
        let Some(Callable { mut params, needed, result, .. }) = of_base.cloned() else { return };
        let before = self.names.clone();
        let own = self.fresh("p");
        let more = self.random.percent(60);
        let written = if more { format!("({own}: Length = 4 m)") } else { String::new() };
        let own = Name { text: own, ty: Ty::Length, is_memory: false };
        let (mut outside, mut inside) = (base.outside.clone(), base.inside.clone());
        if more {
            params.push(Ty::Length);
            outside.push(own.clone());
            inside.push(own);
        }
        let mut behaviors = base.behaviors.clone();
        self.braces(&format!("strategy {name}{written} = {} with", base.name), |g| {
            g.records();
            g.declarations_in_place(&base, &outside);
            g.names = inside.clone();
            g.reactions("reaction of a strategy", 1);
            if g.random.percent(25) {
                let with = g.with();
                g.line(&with);
            }
            let is_whole = g.random.percent(40);
            // A table that is written whole may leave one out.
            if is_whole && behaviors.len() > 2 && g.random.percent(50) {
                behaviors.remove(1);
            }
            for (behavior, ends) in behaviors.clone() {
                if g.random.percent(40) {
                    g.count("behavior in the place of the base's");
                    g.behavior_of_table(&behavior, ends);
                }
            }
            if is_whole {
                g.count("table in the place of the base's");
                let (names, ends): (Vec<String>, Vec<bool>) = behaviors.iter().cloned().unzip();
                g.line(&format!("start {}", names[0]));
                g.rules(&names, &ends, result);
            }
        });
        self.names = before;
        self.bases.push(Base { name: name.clone(), outside, inside, behaviors });
        self.behaviors.push(Callable { name, params, needed, result });
    }

    /// A new memory, and others in the place of those of the base: each knows what stood before that.
    fn declarations_in_place(&mut self, base: &Base, outside: &[Name]) {
        self.names = outside.to_vec();
        for (at, declared) in base.inside.iter().enumerate().skip(base.outside.len()) {
            let known = base.inside[base.outside.len()..at].iter();
            if matches!(declared.ty, Ty::Ints | Ty::Points | Ty::Cells | Ty::Shares | Ty::Marks)
                || self.random.percent(50)
            {
                continue;
            }
            self.names = outside.iter().chain(known).cloned().collect();
            if declared.is_memory {
                self.count("memory in the place of the base's");
                let value = self.given(declared.ty, 2);
                self.line(&format!("memory {}: {} = {value}", declared.text, declared.ty.name()));
            } else if declared.ty == Ty::Bool {
                self.count("signal in the place of the base's");
                let value = self.expr(Ty::Bool, 2);
                self.line(&format!("signal {} = {value}", declared.text));
            }
        }
    }
}
