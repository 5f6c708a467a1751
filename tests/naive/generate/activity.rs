//! Declarations: functions, overlays, behaviors, strategies and the mission.

use super::{Callable, Generator, Name, Ty, derived};

impl Generator {
    pub(super) fn file(&mut self) {
        self.line("enum Mode { calm, eager, wild }");
        self.line("payload camera { start() -> Bool, stop() -> Bool }");
        self.line("const shallow: Depth = 2 m");
        self.line("const middling: Depth = 6 m");
        self.line("const deep: Depth = 11 m");
        self.line("record Found { at: Point, size: Length, mode: Mode }");
        self.functions();
        let vertical_is_taken = self.random.percent(20);
        for _ in 0..2 {
            self.bend();
        }
        self.vertical();
        self.vertical_is_taken = vertical_is_taken;
        for _ in 0..1 + self.random.below(2) {
            self.behavior();
        }
        self.givables_and_takers();
        for _ in 0..1 + self.random.below(2) {
            self.budget = 40;
            self.strategy();
        }
        if self.is_guest {
            self.guests();
        }
        self.derived_strategies();
        self.budget = 60;
        self.mission();
    }

    fn functions(&mut self) {
        self.is_pure = true;
        self.line("fn mode_of(n: Int) -> Mode { if n == 0 { calm } else if n < 3 { eager } else { wild } }");
        self.line("fn many(n: Int, mode: Mode) -> Int {");
        self.line("    var sum = 0");
        self.line("    for i in 1..4 { if i < n { sum = sum + i } }");
        self.line("    match mode { calm { sum }; eager { sum + 1 }; else { -sum } }");
        self.line("}");
        self.line("fn twice(far: Length, n: Int) -> Length { if n > 1 { 2 * far } else { far } }");
        self.line("fn near(p: Point, far: Length) -> Length? { if p.north < far { p.north } else { none } }");
        self.line("fn one_of(some: [Length?; 3], n: Int) -> Length? { some[n] }");
        self.line("fn place_of(some: [Point?; 3], n: Int) -> Point? { if n < 2 { some[n] } else { some.first } }");
        self.line("fn share(part: Length, whole: Length) -> Ratio { part / whole else 0.5 }");
        self.line("fn nearer(a: Quantity, b: Quantity) -> Quantity { if abs(a) < abs(b) or b == 0 { a } else { b } }");
        self.line("fn middle(some: [Quantity; n]) -> Quantity {");
        self.line("    var sum: Quantity = 0");
        self.line("    for each in some { sum = sum + nearer(each, 0) / n }");
        self.line("    sum");
        self.line("}");
        self.functions_of_maps();
        self.line("fn found_if(wanted: Bool, found: Found) -> Found? { if wanted { found } else { none } }");
        self.line("fn turned(h: Heading, mode: Mode) -> Heading {");
        self.line("    var to = h");
        self.line("    var seen: [Angle; 2] by most abs(it) = []");
        self.line("    for lean in [-15 deg, 25 deg, 5 deg] { seen.insert(lean); if mode == wild { to = to + lean } }");
        self.line("    to + (seen.first else 1 deg)");
        self.line("}");
        self.is_pure = false;
    }

    /// Parameters with their types; the later ones have defaults.
    pub(super) fn params(&mut self) -> (String, Vec<Ty>, usize) {
        let types: Vec<Ty> = (0..self.random.below(4)).map(|_| self.any_type()).collect();
        let needed = self.random.below(types.len() + 1);
        let mut written = Vec::new();
        let mut declared = Vec::new();
        for (i, ty) in types.iter().enumerate() {
            let name = self.fresh("p");
            let default = if i < needed {
                String::new()
            } else {
                self.count("default");
                self.is_pure = true;
                let default = format!(" = {}", self.given(*ty, 0));
                self.is_pure = false;
                default
            };
            written.push(format!("{name}: {}{default}", ty.name()));
            declared.push((name, *ty));
        }
        for (name, ty) in declared {
            self.declare(&name, ty, false);
        }
        let written = if written.is_empty() { String::new() } else { format!("({})", written.join(", ")) };
        (written, types, needed)
    }

    /// Memories, signals, reactions.
    pub(super) fn declarations(&mut self, most: usize) {
        for _ in 0..self.random.below(most + 1) {
            match self.random.below(7) {
                6 => self.memory_of_shares(),
                0 => {
                    self.count("signal");
                    let (name, condition) = (self.fresh("s"), self.condition());
                    // An optional in a signal is its value, not whether it is there.
                    if self.names.iter().any(|name| name.text == condition) {
                        continue;
                    }
                    // What holds for one tick at a time holds for no time that is asked for elsewhere.
                    let lasting =
                        if condition.starts_with("becomes") { format!("not ({condition})") } else { condition };
                    self.line(&format!("signal {name} = {lasting}"));
                    self.declare(&name, Ty::Bool, false);
                }
                1 => {
                    self.count("ordered list");
                    let name = self.fresh("best");
                    let key = self.filled(self.random.clone().of(&["most it.along($H)", "least distance(it, $P)"]), 1);
                    let first = self.random.of(&["", " = [$P, $P, $P]"]);
                    let first = self.filled(first, 1);
                    self.line(&format!("memory {name}: [Point; 3] by {key}{first}"));
                    self.declare(&name, Ty::Points, true);
                }
                2 => {
                    self.count("list");
                    let name = self.fresh("kept");
                    let ty = if self.random.percent(50) { Ty::Ints } else { Ty::Points };
                    self.line(&format!("memory {name}: {}", ty.name()));
                    self.declare(&name, ty, true);
                }
                3 => {
                    self.count("map");
                    let name = self.fresh("cells");
                    let area = if self.has_area {
                        "op"
                    } else {
                        "rectangle(center: $P, along: $H, length: 40 m, width: 20 m)"
                    };
                    let map = self.filled(&format!("map(over: {area}, each: $I)"), 1);
                    self.line(&format!("memory {name}: {} = {map}", Ty::Cells.name()));
                    self.declare(&name, Ty::Cells, true);
                }
                _ => {
                    self.count("memory");
                    let ty = self.any_type();
                    let (name, value) = (self.fresh("m"), self.given(ty, 2));
                    self.line(&format!("memory {name}: {} = {value}", ty.name()));
                    self.declare(&name, ty, true);
                }
            }
        }
    }

    pub(super) fn reactions(&mut self, feature: &'static str, most: usize) {
        for _ in 0..self.random.below(most + 1) {
            self.count(feature);
            let optional = self.named(|name| name.ty.inside().is_some()).filter(|_| self.random.percent(20));
            let Some(optional) = optional else {
                let condition = match self.random.below(6) {
                    0 => format!("every {} or {}", self.time(), self.expr(Ty::Bool, 1)),
                    _ => self.condition(),
                };
                self.braces(&format!("on {condition}"), Self::instantly);
                continue;
            };
            self.count("optional as a condition");
            self.braces(&format!("on {}", optional.text), |g| {
                // What is in it knows that it is present: it is read as such, and asked no more.
                g.names.retain(|name| name.text != optional.text);
                if !optional.is_memory {
                    g.declare(&optional.text, optional.ty.inside().unwrap_or(Ty::Bool), false);
                }
                g.instantly();
            });
        }
    }

    pub(super) fn aborts(&mut self, percent: usize) {
        if self.random.percent(percent) {
            self.count("abort on");
            let condition = self.filled("(abs($L) > 30 m) and $B for 900 ms", 1);
            let condition = condition.replacen(" and ", " and (", 1).replace(" for 900 ms", ") for 900 ms");
            let condition = format!("({}) for 900 ms", condition.trim_end_matches(" for 900 ms"));
            self.line(&format!("abort \"enough\" on {condition}"));
        }
    }

    fn result(&mut self) -> Option<Ty> {
        let types = [Ty::Length, Ty::Point, Ty::Found, Ty::MaybePoint];
        self.random.percent(50).then(|| types[self.random.below(types.len())])
    }

    fn behavior(&mut self) {
        self.budget = 14;
        let name = self.fresh("act");
        let before = self.names.clone();
        let (params, types, needed) = self.params();
        let result = self.result();
        let arrow = result.map_or(String::new(), |ty| format!(" -> {}", ty.name()));
        self.braces(&format!("behavior {name}{params}{arrow}"), |g| {
            g.may_abort = true;
            g.finish = Some(result);
            g.records();
            g.declarations(3);
            g.reactions("reaction of a behavior", 2);
            g.aborts(5);
            if g.random.percent(25) {
                let with = g.with();
                g.line(&with);
            }
            g.statements(4);
            if result.is_some() {
                let finish = g.finish_statement();
                g.line(&finish);
            }
            g.finish = None;
        });
        self.names = before;
        self.behaviors.push(Callable { name, params: types, needed, result });
    }

    fn strategy(&mut self) {
        let name = self.fresh("plan");
        let before = self.names.clone();
        let (params, types, needed) = self.params();
        let result = self.result();
        let arrow = result.map_or(String::new(), |ty| format!(" -> {}", ty.name()));
        self.braces(&format!("strategy {name}{params}{arrow}"), |g| {
            g.records();
            let outside = g.names.clone();
            g.declarations(4);
            let inside = g.names.clone();
            g.reactions("reaction of a strategy", 2);
            g.aborts(8);
            if g.random.percent(25) {
                let with = g.with();
                g.line(&with);
            }
            let behaviors = g.table(result);
            g.bases.push(derived::Base { name: name.clone(), outside, inside, behaviors });
        });
        self.names = before;
        self.behaviors.push(Callable { name, params: types, needed, result });
    }

    /// Behaviors and rules. The last behavior is entered `then back` only, unless there is no such rule.
    fn table(&mut self, result: Option<Ty>) -> Vec<(String, bool)> {
        self.count("table");
        let count = 2 + self.random.below(3);
        let names: Vec<String> = (0..count).map(|_| self.fresh("b")).collect();
        let ends: Vec<bool> = (0..count).map(|i| i + 1 == count || self.random.percent(60)).collect();
        for (name, ends) in names.iter().zip(&ends) {
            self.behavior_of_table(name, *ends);
        }
        self.line(&format!("start {}", names[0]));
        self.rules(&names, &ends, result);
        names.into_iter().zip(ends).collect()
    }

    pub(super) fn behavior_of_table(&mut self, name: &str, ends: bool) {
        self.braces(&format!("behavior {name}"), |g| {
            g.may_abort = true;
            g.finish = ends.then_some(None);
            g.declarations(2);
            g.reactions("reaction of a table's behavior", 1);
            if g.random.percent(20) {
                let with = g.with();
                g.line(&with);
            }
            if g.random.percent(10) {
                g.count("body that takes no time");
                let condition = g.filled("$L < 0 m", 0);
                g.line(&format!("while {condition} {{ wait for 100 ms }}"));
            } else {
                g.statements(3);
            }
            if !ends {
                // The last never ends, so that neither does the behavior.
                let (_, text) = loop {
                    let (_, ends, text) = g.guidance();
                    if !ends {
                        break (ends, text);
                    }
                };
                g.line(&text);
            }
            g.finish = None;
        });
    }

    pub(super) fn rules(&mut self, names: &[String], ends: &[bool], result: Option<Ty>) {
        let pause = names.len() - 1;
        let mut rules: Vec<String> = Vec::new();
        // The pause can be entered.
        let condition = self.over_time();
        if self.random.percent(30) {
            self.count("any ->");
            rules.push(format!("any -> {} on {condition} then back", names[pause]));
        } else {
            rules.push(format!("{} -> {} on {condition} then back", names[self.random.below(pause)], names[pause]));
        }
        self.count("then back");
        for (i, name) in names.iter().enumerate() {
            for _ in 0..self.random.below(3) {
                let rule = self.rule(name, names, result);
                rules.push(rule);
            }
            if i + 1 < pause && self.random.percent(15) {
                self.count("several sources");
                let condition = self.over_time();
                let to = names[self.random.below(pause)].clone();
                if to != *name && to != names[i + 1] {
                    rules.push(format!("{name}, {} -> {to} on {condition}", names[i + 1]));
                }
            }
            if i == pause {
                continue;
            }
            // Onward, so that each is reached: when it is done, or after a while.
            let onward = if i + 1 < pause { names[i + 1].clone() } else { self.finish_target(result) };
            if ends[i] {
                if self.random.percent(30) {
                    self.count("done and");
                    let (condition, effect) = (self.expr(Ty::Bool, 1), self.effect());
                    rules.push(format!("{name} -> {onward} on done and {condition}{effect}"));
                } else if self.random.percent(30) {
                    self.count("done or");
                    let condition = self.expr(Ty::Bool, 1);
                    rules.push(format!("{name} -> {onward} on (done or {condition}) and {}", self.expr(Ty::Bool, 1)));
                }
                self.count("done");
                let effect = self.effect();
                let to = if self.random.percent(25) && i > 0 { names[0].clone() } else { onward.clone() };
                if to != onward {
                    rules.push(format!("{name} -> {onward} on after {}", self.time()));
                }
                rules.push(format!("{name} -> {to} on done{effect}"));
            } else {
                self.count("after T");
                let effect = self.effect();
                rules.push(format!("{name} -> {onward} on after {}{effect}", self.time()));
            }
        }
        for rule in rules {
            self.line(&rule);
        }
    }

    fn finish_target(&mut self, result: Option<Ty>) -> String {
        self.count("-> finish");
        match result {
            Some(ty) => format!("finish {}", self.given(ty, 1)),
            None => "finish".to_string(),
        }
    }

    /// A rule that may fire before its behavior is done.
    fn rule(&mut self, from: &str, names: &[String], result: Option<Ty>) -> String {
        let condition = self.over_time();
        match self.random.below(12) {
            0 => {
                self.count("-> abort");
                let text = self.expr(Ty::Length, 1);
                format!("{from} -> abort \"lost at {{{text}}}\" on ({condition}) and ($L > 30 m)")
                    .replace("$L", &self.expr(Ty::Length, 1))
            }
            1 => {
                let target = self.finish_target(result);
                format!("{from} -> {target} on {condition}{}", self.effect())
            }
            other => {
                self.count("rule");
                let to = names[self.random.below(names.len() - usize::from(6 <= other))].clone();
                let back = if other < 6 && to != from {
                    self.count("then back");
                    " then back"
                } else {
                    ""
                };
                // The last is entered `then back` only: nothing says what comes after it.
                let to = if back.is_empty() && to == names[names.len() - 1] { names[0].clone() } else { to };
                format!("{from} -> {to} on {condition}{back}{}", self.effect())
            }
        }
    }

    /// A guard that is not true from the start and for ever.
    pub(super) fn over_time(&mut self) -> String {
        let (x, time) = (self.expr(Ty::Bool, 2), self.time());
        match self.random.below(8) {
            0 => format!("becomes {x}"),
            6 | 7 => {
                self.count("every");
                format!("(becomes {x}) or every {time}")
            }
            1 => format!("{x} for {time}"),
            2 => format!("no {x} for {time}"),
            3 => format!("(becomes {x}) or after {time}"),
            4 => format!("({x} for {time}) and {}", self.expr(Ty::Bool, 1)),
            _ => format!("{x} and after {time}"),
        }
    }

    pub(super) fn effect(&mut self) -> String {
        if self.random.percent(50) {
            return String::new();
        }
        self.count("do");
        let out = std::mem::take(&mut self.out);
        let names: Vec<Name> = self.names.clone();
        self.depth += 1;
        self.nested += 1;
        self.instantly();
        self.nested -= 1;
        self.depth -= 1;
        self.names = names;
        let inside = std::mem::replace(&mut self.out, out);
        format!(" do {{\n{inside}{}}}", "    ".repeat(self.depth))
    }

    fn mission(&mut self) {
        let limit = 2 + self.random.below(14);
        let (params, ..) = if self.random.percent(50) { self.mission_params() } else { Default::default() };
        self.braces(&format!("mission trial{params} within {limit} s"), |g| {
            g.line(
                "area op = rectangle(center: point(north: 0 m, east: 0 m), along: 20 deg, length: 90 m, width: 60 m)",
            );
            g.has_area = true;
            g.declare("op", Ty::Area, false);
            g.region();
            if g.random.percent(50) {
                g.count("limits");
                g.line("limits { altitude >= 2 m, depth <= 11.5 m, speed <= 1.8 m/s }");
            }
            g.requires();
            if g.random.percent(80) {
                g.count("recovery");
                let time = g.time();
                g.braces(&format!("recovery within {time}"), |g| {
                    let names = std::mem::take(&mut g.names);
                    (g.budget, g.may_abort) = (8, false);
                    g.statements(2);
                    g.names = names;
                    g.budget = 40;
                });
            }
            let vertical = if g.vertical_is_taken {
                g.count("overlay on vertical");
                g.worn_vertical()
            } else {
                "depth 3 m".to_string()
            };
            g.line(&format!("with speed 1 m/s, {vertical}"));
            g.records();
            g.declarations(4);
            if g.random.percent(20) {
                let with = g.with();
                g.line(&with);
            }
            g.reactions("reaction of a mission", 2);
            g.aborts(8);
            g.may_abort = true;
            if g.is_guest {
                g.guest_body();
            } else if g.random.percent(40) {
                let _ = g.table(None);
            } else {
                g.count("sequence");
                g.finish = Some(None);
                g.statements(7);
                g.finish = None;
            }
        });
    }

    fn mission_params(&mut self) -> (String, Vec<Ty>, usize) {
        let name = self.fresh("given");
        let value = self.expr(Ty::Angle, 0);
        self.declare(&name, Ty::Angle, false);
        (format!("({name}: Angle = {value})"), vec![Ty::Angle], 0)
    }

    fn requires(&mut self) {
        self.count("requires");
        self.braces("requires", |g| {
            let mut entries = vec!["position, course, heading fresh 1500 ms, else hold for 400 ms then abort"];
            let more = [
                "flow fresh 1 s, at first 12 cm/s toward 140 deg, else hold for 700 ms then abort",
                "chemical fresh 500 ms, at first 2 %, else hold for 2 s then abort",
                "depth fresh 1 s, else abort",
                "battery fresh 1 s, at first 70 %, else hold for 500 ms then abort",
                "speed fresh 1 s, else hold for 300 ms then abort",
                "utc fresh 3 s, at first 2026-08-14T05:00Z, else hold for 500 ms then abort",
                "water_depth fresh 600 ms, else hold for 600 ms then abort",
            ];
            entries.extend(more);
            for entry in entries {
                g.line(entry);
            }
        });
    }
}
