//! Behaviors that are given to others.

use super::{Generator, Ty};

/// Forms in which a behavior is asked for: what it is called with, and the result that is read.
const FORMS: [(&[Ty], Option<Ty>); 4] = [
    (&[Ty::Length], None),
    (&[Ty::Point, Ty::Length], Some(Ty::Length)),
    (&[], Some(Ty::Point)),
    (&[Ty::Ratio], Some(Ty::MaybePoint)),
];

/// A behavior that can be given in a form.
#[derive(Clone, Debug)]
pub struct Givable {
    name: String,
    form: usize,
    has_result: bool,
}

/// A behavior that takes others in some forms, and a length.
#[derive(Clone, Debug)]
pub struct Taker {
    name: String,
    forms: Vec<usize>,
    result: Option<Ty>,
}

fn written(form: usize) -> String {
    let (takes, result) = FORMS[form];
    let takes: Vec<&str> = takes.iter().map(|ty| ty.name()).collect();
    let result = result.map_or(String::new(), |ty| format!(" -> {}", ty.name()));
    format!("behavior({}){result}", takes.join(", "))
}

impl Generator {
    pub(super) fn givables_and_takers(&mut self) {
        for form in 0..FORMS.len() {
            for _ in 0..1 + self.random.below(2) {
                self.givable(form);
            }
        }
        for _ in 0..1 + self.random.below(3) {
            self.taker();
        }
    }

    /// It may take more than it is given, which has defaults then, and a result that nobody reads.
    fn givable(&mut self, form: usize) {
        self.budget = 6;
        let (takes, mut result) = FORMS[form];
        if result.is_none() && self.random.percent(50) {
            result = Some(Ty::Length);
        }
        let name = self.fresh("given");
        let before = self.names.clone();
        let mut params: Vec<String> = Vec::new();
        for ty in takes {
            let param = self.fresh("p");
            params.push(format!("{param}: {}", ty.name()));
            self.declare(&param, *ty, false);
        }
        if self.random.percent(40) {
            let param = self.fresh("p");
            params.push(format!("{param}: Int = 3"));
            self.declare(&param, Ty::Int, false);
        }
        let arrow = result.map_or(String::new(), |ty| format!(" -> {}", ty.name()));
        self.braces(&format!("behavior {name}({}){arrow}", params.join(", ")), |g| {
            g.finish = Some(result);
            g.declarations(2);
            g.reactions("reaction of a behavior", 1);
            g.statements(2);
            if result.is_some() {
                let finish = g.finish_statement();
                g.line(&finish);
            }
            g.finish = None;
        });
        self.names = before;
        self.givables.push(Givable { name, form, has_result: result.is_some() });
    }

    fn taker(&mut self) {
        self.budget = 10;
        let name = self.fresh("taker");
        let before = self.names.clone();
        let forms: Vec<usize> = (0..1 + self.random.below(2)).map(|_| self.random.below(FORMS.len())).collect();
        let given: Vec<String> = forms.iter().map(|_| self.fresh("act")).collect();
        let far = self.fresh("p");
        let params = given.iter().zip(&forms).map(|(name, form)| format!("{name}: {}", written(*form)));
        let params: Vec<String> = params.chain([format!("{far}: Length = 5 m")]).collect();
        self.declare(&far, Ty::Length, false);
        let result = self.random.percent(40).then_some(Ty::Length);
        let arrow = result.map_or(String::new(), |ty| format!(" -> {}", ty.name()));
        self.braces(&format!("behavior {name}({}){arrow}", params.join(", ")), |g| {
            g.finish = Some(result);
            g.declarations(2);
            for (act, form) in given.iter().zip(&forms) {
                g.call_of_given(act, *form);
                g.statements(1);
            }
            g.hand_on(&given, &forms);
            let (act, form) = (given[0].clone(), forms[0]);
            g.braces("for _ in 1..2".replace('_', &format!("_n{}", g.next)).as_str(), |g| g.call_of_given(&act, form));
            if result.is_some() {
                let finish = g.finish_statement();
                g.line(&finish);
            }
            g.finish = None;
        });
        self.names = before;
        self.takers.push(Taker { name, forms, result });
    }

    /// A behavior that was given is called.
    fn call_of_given(&mut self, act: &str, form: usize) {
        let (takes, result) = FORMS[form];
        let args: Vec<String> = takes.iter().map(|ty| self.expr(*ty, 1)).collect();
        self.ended(&format!("{act}({})", args.join(", ")), result, "call of a given behavior");
    }

    /// A call that ends by itself, or otherwise, and whose outcome may be named.
    fn ended(&mut self, call: &str, result: Option<Ty>, feature: &'static str) {
        self.count(feature);
        let cut = self.random.below(4);
        let time = self.time();
        let call = match cut {
            0 => format!("{call} within {time}"),
            1 => format!("{call} for {time}"),
            2 => format!("{call} until after {time}"),
            _ => call.to_string(),
        };
        if self.random.percent(30) && cut != 0 {
            return self.line(&call);
        }
        let name = self.fresh("got");
        self.line(&format!("let {name} = {call}"));
        let ty = match result {
            Some(ty) if cut < 3 => ty.maybe(),
            Some(ty) => ty,
            None => Ty::Bool,
        };
        self.declare(&name, ty, false);
    }

    /// What a taker was given it gives to another that was declared before it.
    fn hand_on(&mut self, given: &[String], forms: &[usize]) {
        let Some(taker) = self.takers.last().cloned().filter(|_| self.random.percent(60)) else { return };
        let mut args = Vec::new();
        for form in &taker.forms {
            let own = forms.iter().position(|own| own == form).map(|at| given[at].clone());
            args.push(own.unwrap_or_else(|| self.guest_of(*form)));
        }
        self.ended(&format!("{}({})", taker.name, args.join(", ")), taker.result, "given behavior handed on");
    }

    fn guest_of(&mut self, form: usize) -> String {
        let known: Vec<Givable> = self.givables.iter().filter(|given| given.form == form).cloned().collect();
        let given = known[self.random.below(known.len())].clone();
        if given.has_result && FORMS[form].1.is_none() {
            self.count("result of a given behavior unread");
        }
        given.name
    }

    pub(super) fn call_of_taker(&mut self) {
        let taker = self.takers[self.random.below(self.takers.len())].clone();
        let mut args: Vec<String> = taker.forms.iter().map(|form| self.guest_of(*form)).collect();
        if self.random.percent(50) {
            args.push(self.expr(Ty::Length, 1));
        }
        self.ended(&format!("{}({})", taker.name, args.join(", ")), taker.result, "call with given behaviors");
    }
}
