//! Guests of their vehicle (rule 18): missions, behaviors and strategies that watch, and that drive in their overrides alone.

use super::{Callable, Generator, Ty};

/// What a guest may wait for.
const CONTROL: [&str; 6] = [
    "control == in_control",
    "control == suspended",
    "control == released",
    "control == offered",
    "control == requesting",
    "control == monitoring",
];

impl Generator {
    /// What a guest calls: a behavior, and now and then a strategy.
    pub(super) fn guests(&mut self) {
        let own = std::mem::take(&mut self.behaviors);
        let mut guests = Vec::new();
        for _ in 0..1 + self.random.below(2) {
            self.budget = 14;
            let name = self.fresh("visit");
            let before = self.names.clone();
            let (params, types, needed) = self.params();
            let is_strategy = self.random.percent(40);
            let head = if is_strategy { "strategy" } else { "behavior" };
            self.braces(&format!("{head} {name}{params}"), |g| {
                g.behaviors.clone_from(&own);
                g.may_abort = true;
                g.declarations(2);
                g.reactions("reaction of a guest", 1);
                g.looks_at_control();
                if g.random.percent(20) {
                    let with = g.with();
                    g.line(&with);
                }
                if is_strategy {
                    g.guest_table();
                } else {
                    g.finish = Some(None);
                    g.guest_statements(3);
                    g.finish = None;
                }
            });
            self.names = before;
            guests.push(Callable { name, params: types, needed, result: None });
        }
        self.behaviors = own;
        self.guests = guests;
    }

    /// The body of a mission.
    pub(super) fn guest_body(&mut self) {
        self.count("guest");
        self.looks_at_control();
        if self.random.percent(30) {
            self.guest_table();
        } else {
            self.count("guest sequence");
            self.finish = Some(None);
            self.guest_statements(6);
            self.finish = None;
        }
    }

    /// What hears of the vehicle's changes of mind before an override does.
    fn looks_at_control(&mut self) {
        if self.random.percent(30) {
            self.count("reaction to control");
            let condition = self.control_condition();
            self.braces(&format!("on becomes {condition}"), Self::instantly);
        }
        if self.random.percent(12) {
            self.count("abort on control");
            let condition = self.control_condition();
            self.line(&format!("abort \"it is {{control}}\" on becomes {condition}"));
        }
    }

    fn control_condition(&mut self) -> String {
        let condition = self.random.of(&CONTROL).to_string();
        if self.random.percent(70) { condition } else { format!("({condition} or {})", self.expr(Ty::Bool, 1)) }
    }

    fn guest_statements(&mut self, most: usize) {
        if self.nested == 1 || self.random.percent(30) {
            self.overriding();
        }
        for _ in 0..1 + self.random.below(most) {
            self.guest_statement();
        }
    }

    fn guest_statements_within(&mut self) {
        self.guest_statements(2);
    }

    fn guest_statement(&mut self) {
        self.budget = self.budget.saturating_sub(1);
        if self.budget == 0 || self.nested > 5 {
            return self.line("watch for 200 ms");
        }
        match self.random.below(20) {
            0..8 => self.overriding(),
            8..11 => self.watch(),
            11 => self.simple(),
            12 => self.branch(Self::guest_statements_within),
            13 => self.rounds(Self::guest_statements_within),
            14 => self.braces("if true", |g| {
                let with = g.with();
                g.line(&with);
                g.guest_statements(2);
            }),
            15 => self.ask(),
            16 | 17 if !self.guests.is_empty() => {
                self.count("call of a guest");
                let takers = std::mem::take(&mut self.takers);
                std::mem::swap(&mut self.behaviors, &mut self.guests);
                self.call();
                std::mem::swap(&mut self.behaviors, &mut self.guests);
                self.takers = takers;
            }
            18 if self.finish.is_some() => {
                let condition = self.expr(Ty::Bool, 1);
                self.braces(&format!("if {condition}"), |g| g.line("finish"));
            }
            _ => {
                let time = self.time();
                self.line(&format!("wait for {time}"));
            }
        }
    }

    fn watch(&mut self) {
        let (feature, end) = match self.random.below(3) {
            0 => ("watch for", format!(" for {}", self.time())),
            1 => ("watch until", format!(" until {}", self.condition())),
            _ => ("watch until", format!(" until {}", self.control_condition())),
        };
        self.count(feature);
        if self.random.percent(50) {
            let (name, within) = (self.fresh("seen"), self.time());
            self.line(&format!("let {name} = watch{end} within {within}"));
            return self.declare(&name, Ty::Bool, false);
        }
        self.line(&format!("watch{end}"));
    }

    fn overriding(&mut self) {
        self.count("override");
        let mut head = "override".to_string();
        let is_offered = self.random.percent(20);
        if is_offered {
            self.count("override when offered");
            head += " when offered";
        }
        if self.random.percent(60) {
            self.count("override within");
            head += &format!(" within {}", self.patience(is_offered));
        }
        let is_read = self.random.percent(40);
        let name = self.fresh("end");
        if is_read {
            self.count("let end = override");
            head = format!("let {name} = {head}");
        }
        let mut is_endless = false;
        let finish = self.finish.take();
        self.braces(&head, |g| {
            g.statements(3);
            is_endless = g.random.percent(30);
            if is_endless {
                let text = g.filled("steer $H", 1);
                g.line(&text);
            }
        });
        self.finish = finish;
        let tail = match self.random.below(if is_endless { 3 } else { 6 }) {
            0 => ("override until", format!(" until {}", self.override_until())),
            1 => ("override for", format!(" for {}", self.patience(is_offered))),
            2 => ("override cut", format!(" within {}", self.patience(is_offered))),
            _ => ("override alone", String::new()),
        };
        self.count(tail.0);
        self.out.truncate(self.out.trim_end().len());
        self.out.push_str(&format!("{}\n", tail.1));
        match self.random.below(3) {
            0 if is_read => self.line(&format!("log \"{{{name}}}, {{control}}\"")),
            1 if is_read => self.braces(&format!("if {name} != completed"), |g| {
                g.line(&format!("log \"{{{name}}}\""));
                g.guest_statements(1);
            }),
            _ => {}
        }
    }

    fn override_until(&mut self) -> String {
        if self.random.percent(40) { self.control_condition() } else { self.condition() }
    }

    /// A vehicle takes its time, and more of it where it is not asked.
    fn patience(&mut self, is_offered: bool) -> String {
        let most = if is_offered { 60 } else { 24 };
        format!("{} ms", 50 + 50 * self.random.below(most))
    }

    /// Behaviors that watch and drive, and one that does neither, for which each may wait.
    fn guest_table(&mut self) {
        self.count("guest table");
        let names: Vec<String> = (0..2 + self.random.below(2)).map(|_| self.fresh("g")).collect();
        let pause = self.fresh("pause");
        let ends: Vec<bool> = names.iter().map(|_| self.random.percent(75)).collect();
        for (name, ends) in names.iter().zip(&ends) {
            self.braces(&format!("behavior {name}"), |g| {
                g.may_abort = true;
                g.finish = ends.then_some(None);
                g.declarations(1);
                g.reactions("reaction of a table's behavior", 1);
                g.looks_at_control();
                g.guest_statements(2);
                if !ends {
                    g.count("watch");
                    g.line("watch");
                }
                g.finish = None;
            });
        }
        self.braces(&format!("behavior {pause}"), |g| {
            g.declarations(1);
            g.log();
            let time = g.time();
            g.line(&format!("wait for {time}"));
        });
        self.line(&format!("start {}", names[0]));
        let condition = self.guard();
        match self.random.below(3) {
            0 => self.line(&format!("any -> {pause} on {condition} then back")),
            _ => {
                let from = names[self.random.below(names.len())].clone();
                self.line(&format!("{from} -> {pause} on {condition} then back"));
            }
        }
        for (i, name) in names.iter().enumerate() {
            let onward = names.get(i + 1).map_or("finish", String::as_str);
            if self.random.percent(40) {
                let (to, condition, effect) =
                    (names[self.random.below(names.len())].clone(), self.guard(), self.effect());
                self.line(&format!("{name} -> {to} on {condition}{effect}"));
            }
            if self.random.percent(12) {
                let condition = self.guard();
                self.line(&format!("{name} -> abort \"enough, {{control}}\" on {condition}"));
            }
            let when = if ends[i] { "done".to_string() } else { format!("after {}", self.patience(true)) };
            let effect = self.effect();
            self.line(&format!("{name} -> {onward} on {when}{effect}"));
        }
    }

    fn guard(&mut self) -> String {
        match self.random.below(3) {
            0 => format!("becomes {}", self.control_condition()),
            1 => format!("after {}", self.patience(false)),
            _ => self.over_time(),
        }
    }
}
