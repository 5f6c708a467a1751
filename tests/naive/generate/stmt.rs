//! Statements: those that take time, and those that do not.

use super::{Generator, Ty};

impl Generator {
    /// Some statements of a body.
    pub(super) fn statements(&mut self, most: usize) {
        let count = 1 + self.random.below(most);
        for _ in 0..count {
            self.statement();
        }
    }

    fn statement(&mut self) {
        self.budget = self.budget.saturating_sub(1);
        if self.budget == 0 || self.nested > 6 {
            return self.line("wait for 200 ms");
        }
        match self.random.below(20) {
            0..8 => self.timed(),
            8..11 => self.simple(),
            11 | 12 => self.branch(Self::statements_within),
            13 | 14 => self.repeat(),
            15 if self.random.percent(50) => self.ask(),
            15 => self.with_block(),
            16 | 17 if !self.behaviors.is_empty() => self.call(),
            18 if self.random.percent(40) && self.finish.is_some() => {
                self.count("finish");
                let condition = self.expr(Ty::Bool, 1);
                let finish = self.finish_statement();
                self.braces(&format!("if {condition}"), |g| g.line(&finish));
            }
            19 if self.random.percent(20) && self.may_abort => {
                self.count("abort");
                let condition = self.filled("$L > 35 m", 0);
                let text = self.expr(Ty::Length, 1);
                self.braces(&format!("if {condition}"), |g| g.line(&format!("abort \"gave up at {{{text}}}\"")));
            }
            _ => self.timed(),
        }
    }

    pub(super) fn finish_statement(&mut self) -> String {
        match self.finish.flatten() {
            Some(ty) => format!("finish {}", self.given(ty, 2)),
            None => "finish".to_string(),
        }
    }

    fn statements_within(&mut self) {
        self.statements(2);
    }

    /// Guidance, with whatever ends it.
    fn timed(&mut self) {
        let (feature, ends, text) = self.guidance();
        self.count(feature);
        let mut text = text;
        let mut is_named = false;
        match self.random.below(if ends { 4 } else { 3 }) {
            0 => {
                self.count("until");
                text += &format!(" until {}", self.until());
            }
            1 | 2 => {
                self.count("for T");
                text += &format!(" for {}", self.time());
            }
            _ => {}
        }
        if self.random.percent(25) {
            self.count("within");
            text += &format!(" within {}", self.time());
            is_named = self.random.percent(70);
        }
        if self.random.percent(20) && !matches!(feature, "keep" | "wait") {
            self.count("at");
            if self.vertical_is_taken {
                text += " at speed 1.4 m/s";
                return self.finish_timed(&text, is_named);
            }
            text += &self.setpoint();
        }
        self.finish_timed(&text, is_named);
    }

    fn finish_timed(&mut self, text: &str, is_named: bool) {
        if is_named {
            let name = self.fresh("ok");
            self.line(&format!("let {name} = {text}"));
            self.declare(&name, Ty::Bool, false);
        } else {
            self.line(text);
        }
    }

    /// A condition that comes true sooner or later, one hopes.
    fn until(&mut self) -> String {
        let condition = self.condition();
        if self.random.percent(50) { condition } else { format!("after {}", self.time()) }
    }

    fn setpoint(&mut self) -> String {
        self.filled(
            self.random.clone().of(&[
                " at depth max($D, 1 m)",
                " at speed 1.5 m/s",
                " at altitude 4 m, speed 1 m/s",
                " at depth 7 m",
            ]),
            1,
        )
    }

    /// What it is, whether it ends by itself, and its text.
    pub(super) fn guidance(&mut self) -> (&'static str, bool, String) {
        let (feature, ends, pattern) = match self.random.below(11) {
            0 | 1 => ("steer", false, "steer $H"),
            2 => ("steer heading", false, "steer heading: $H"),
            3 => ("goto", true, "goto $P, radius: 9 m"),
            4 => ("follow", true, "follow line($P, $P)"),
            5 => ("dubins", true, "dubins $P, $H, radius: 8 m"),
            6 => ("loiter", true, "loiter $P, radius: 7 m, turns: 0.5, clockwise: $B"),
            7 if !self.vertical_is_taken => ("keep", false, "keep depth max($D, 1 m)"),
            7 | 8 => ("keep", false, "keep speed 1.2 m/s"),
            9 => ("hold", false, "hold"),
            _ => ("wait", false, "wait"),
        };
        (feature, ends, self.filled(pattern, 2))
    }

    /// A payload is asked, and what it says is read or not.
    pub(super) fn ask(&mut self) {
        self.count("ask");
        let action = self.random.clone().of(&["start", "stop"]);
        let text = format!("ask camera.{action}() within {}", self.time());
        if self.random.percent(30) {
            return self.line(&text);
        }
        let (name, ok) = (self.fresh("answer"), self.fresh("said"));
        self.line(&format!("let {name} = {text}"));
        let value = ["NAME.value", "NAME.end == refused", "NAME.end == no_answer"][self.random.below(3)];
        self.line(&format!("let {ok} = {}", value.replace("NAME", &name)));
        self.declare(&ok, Ty::Bool, false);
    }

    pub(super) fn call(&mut self) {
        if !self.takers.is_empty() && self.random.percent(35) {
            return self.call_of_taker();
        }
        let callee = self.behaviors[self.random.below(self.behaviors.len())].clone();
        let args = self.arguments(&callee.params, callee.needed);
        let mut text = format!("{}({args})", callee.name);
        let cut = self.random.below(4);
        match cut {
            0 => text += &format!(" within {}", self.time()),
            1 => text += &format!(" for {}", self.time()),
            2 => text += &format!(" until {}", self.until()),
            _ => {}
        }
        self.count(["call within", "call for", "call until", "call"][cut]);
        match callee.result {
            Some(ty) if self.random.percent(70) => {
                self.count("call with a result");
                let name = self.fresh("got");
                self.line(&format!("let {name} = {text}"));
                self.declare(&name, if cut < 3 { ty.maybe() } else { ty }, false);
            }
            None if cut < 3 => {
                let name = self.fresh("done");
                self.line(&format!("let {name} = {text}"));
                self.declare(&name, Ty::Bool, false);
            }
            _ => self.line(&text),
        }
    }

    /// Arguments: all that are needed, and some that have a default.
    pub(super) fn arguments(&mut self, params: &[Ty], needed: usize) -> String {
        let given = needed + self.random.below(params.len() - needed + 1);
        let args: Vec<String> = params[..given].iter().map(|ty| self.given(*ty, 1)).collect();
        args.join(", ")
    }

    /// `if` and `match`, with something inside.
    pub(super) fn branch(&mut self, inside: fn(&mut Self)) {
        match self.random.below(4) {
            0 => {
                if let Some(name) = self.named(|name| name.ty.inside().is_some()) {
                    self.count("if let");
                    let inner = self.fresh("there");
                    self.braces(&format!("if let {inner} = {}", name.text), |g| {
                        g.declare(&inner, name.ty.inside().unwrap_or(Ty::Bool), false);
                        inside(g);
                    });
                    return;
                }
                self.if_else(inside);
            }
            1 => {
                self.count("match");
                let mode = self.expr(Ty::Mode, 1);
                self.braces(&format!("match {mode}"), |g| {
                    g.braces("calm", inside);
                    g.braces("eager, wild", inside);
                });
            }
            2 => {
                let narrowed = self.named(|name| name.ty.inside().is_some() && !name.is_memory);
                let Some(name) = narrowed else { return self.if_else(inside) };
                self.count("narrowing");
                self.braces(&format!("if {}", name.text), |g| {
                    g.names.retain(|other| other.text != name.text);
                    g.declare(&name.text, name.ty.inside().unwrap_or(Ty::Bool), false);
                    inside(g);
                });
            }
            _ => self.if_else(inside),
        }
    }

    fn if_else(&mut self, inside: fn(&mut Self)) {
        self.count("if");
        let condition = self.expr(Ty::Bool, 2);
        self.braces(&format!("if {condition}"), inside);
        if self.random.percent(50) {
            self.out.truncate(self.out.trim_end().len());
            self.out.push_str(" else {\n");
            self.until_brace(inside);
        }
    }

    /// Loops whose every round takes time or that are short.
    fn repeat(&mut self) {
        match self.random.below(7) {
            0 | 1 => self.rounds(Self::statements_within),
            2 => {
                self.count("while");
                let condition = self.filled("$B and $L < 20 m", 1);
                self.braces(&format!("while {condition}"), |g| {
                    g.statements(2);
                    g.timed();
                });
            }
            3 => {
                let Some(list) = self.named(|name| name.ty == Ty::Points && name.is_memory) else {
                    return self.rounds(Self::statements_within);
                };
                self.count("while let");
                let name = self.fresh("next");
                self.braces(&format!("while let {name} = {}.first", list.text), |g| {
                    g.declare(&name, Ty::Point, false);
                    g.timed();
                    g.line(&format!("{}.remove({name})", list.text));
                });
            }
            4 if self.finish.is_some() && self.nested < 4 => {
                self.count("loop");
                let condition = self.expr(Ty::Bool, 2);
                let finish = self.finish_statement();
                self.braces("if $".replace('$', &condition).as_str(), |g| {
                    g.braces("loop", |g| {
                        g.timed();
                        let condition = g.expr(Ty::Bool, 2);
                        g.braces(&format!("if {condition}"), |g| g.line(&finish));
                        g.statements(2);
                    });
                });
            }
            5 => {
                self.count("for rows");
                let name = self.fresh("row");
                let area = self.area();
                let near = self.perhaps(", near: ", Ty::Point);
                let along = self.perhaps(", along: ", Ty::Heading);
                self.braces(&format!("for {name} in {area}.rows(40 m{near}{along})"), |g| {
                    let time = g.time();
                    g.line(&format!("follow {name} for {time}"));
                    g.line(&format!("log \"{{{name}}}\""));
                });
            }
            _ if self.random.percent(70) => {
                self.count("for edges");
                let name = self.fresh("edge");
                let area = self.area();
                self.braces(&format!("for {name} in {area}.edges"), |g| {
                    let (time, heading) = (g.time(), g.expr(Ty::Heading, 1));
                    g.line(&format!("steer {name}.tangent(nearest: {heading}) for {time}"));
                });
            }
            _ => self.rounds(Self::statements_within),
        }
    }

    /// `for` over a range or a list.
    pub(super) fn rounds(&mut self, inside: fn(&mut Self)) {
        let list = self.named(|name| matches!(name.ty, Ty::Ints | Ty::Points | Ty::Cells | Ty::Shares | Ty::Marks));
        match (self.random.below(3), list) {
            (0, Some(map)) if map.ty.cell().is_some() => {
                self.count("for map");
                let (name, place) = (self.fresh("each"), self.fresh("place"));
                self.braces(&format!("for {name} at {place} in {}", map.text), |g| {
                    g.declare(&name, map.ty.cell().unwrap_or(Ty::Int), false);
                    g.declare(&place, Ty::Point, false);
                    inside(g);
                });
            }
            (0, Some(list)) => {
                self.count("for list");
                let name = self.fresh("each");
                self.braces(&format!("for {name} in {}", list.text), |g| {
                    g.declare(&name, if list.ty == Ty::Ints { Ty::Int } else { Ty::Point }, false);
                    inside(g);
                });
            }
            (1, _) => {
                self.count("for written list");
                let name = self.fresh("turn");
                let list = self.filled("[$A, -20 deg, $A]", 1);
                self.braces(&format!("for {name} in {list}"), |g| {
                    g.declare(&name, Ty::Angle, false);
                    inside(g);
                });
            }
            _ => {
                self.count("for range");
                let name = self.fresh("n");
                let range = self.random.clone().of(&["0..<3", "1..2", "-1..1", "1..clamp($i.count, 0, 2)"]);
                let range = self.filled(range, 1);
                self.braces(&format!("for {name} in {range}"), |g| {
                    g.declare(&name, Ty::Int, false);
                    inside(g);
                });
            }
        }
    }

    /// `with` to the end of a block.
    fn with_block(&mut self) {
        if !self.vertical_is_taken && self.random.percent(25) {
            return self.vertical_block();
        }
        self.braces("if true", |g| {
            let with = g.with();
            g.line(&with);
            g.statements(3);
        });
    }

    /// An overlay that owns the vertical channel for a while.
    fn vertical_block(&mut self) {
        self.count("overlay on vertical in a block");
        self.braces("if true", |g| {
            let worn = g.worn_vertical();
            g.line(&format!("with {worn}"));
            g.vertical_is_taken = true;
            g.timed();
            let time = g.time();
            g.line(&format!("wait for {time}"));
            g.vertical_is_taken = false;
        });
        self.count("wait");
        let time = self.time();
        self.line(&format!("wait for {time}"));
    }

    pub(super) fn worn_vertical(&mut self) -> String {
        let saw = self.verticals[self.random.below(self.verticals.len())].clone();
        let args = self.arguments(&saw.params, saw.needed);
        format!("{}({args})", saw.name)
    }

    pub(super) fn with(&mut self) -> String {
        self.count("with");
        let mut items = Vec::new();
        if self.random.percent(50) {
            let setpoints =
                ["speed 0.2 m/s - flow.length", "speed max($S, 0.2 m/s)", "altitude 5 m", "depth max($D, 1 m)"];
            let setpoint = setpoints[self.random.below(if self.vertical_is_taken { 2 } else { 4 })];
            items.push(self.filled(setpoint, 1));
        }
        for _ in 0..self.random.below(3) {
            let bend = self.bends[self.random.below(self.bends.len())].clone();
            self.count("overlay on course");
            let args = self.arguments(&bend.params, bend.needed);
            items.push(format!("{}({args})", bend.name));
        }
        if items.is_empty() {
            items.push("speed 1.3 m/s".to_string());
        }
        format!("with {}", items.join(", "))
    }

    /// A statement that takes no time.
    pub(super) fn simple(&mut self) {
        let ty = self.any_type();
        match self.random.below(8) {
            0 | 1 => {
                self.count("let");
                let (name, value) = (self.fresh("x"), self.expr(ty, 2));
                self.line(&format!("let {name}: {} = {value}", ty.name()));
                self.declare(&name, ty, false);
            }
            2 => {
                self.count("report");
                let ty = ty.inside().unwrap_or(ty);
                let (what, more) = (self.expr(ty, 1), self.expr(Ty::Point, 1));
                self.line(&format!("report \"seen\": {what}, at: {more}"));
            }
            3 | 4 => self.log(),
            _ => self.assign(),
        }
    }

    pub(super) fn log(&mut self) {
        self.count("log");
        let (a, b) = (self.any_type(), self.any_type());
        let (a, b) = (self.expr(a, 1), self.expr(b, 1));
        self.line(&format!("log \"now {{{a}}}, and {{{b}}}\""));
    }

    fn assign(&mut self) {
        let Some(memory) = self.named(|name| name.is_memory) else { return self.log() };
        let text = &memory.text;
        match memory.ty {
            Ty::Ints | Ty::Points => {
                let of = if memory.ty == Ty::Ints { Ty::Int } else { Ty::Point };
                let element = self.expr(of, 2);
                match self.random.below(7) {
                    0 => {
                        self.count("clear");
                        self.line(&format!("{text}.clear()"));
                    }
                    1 => {
                        self.count("remove");
                        self.line(&format!("{text}.remove({element})"));
                    }
                    2 => {
                        self.count("replace");
                        let index = self.expr(Ty::Int, 1);
                        self.line(&format!("{text}[clamp({index}, 0, 2)] = {element}"));
                    }
                    _ => {
                        self.count("insert");
                        self.line(&format!("{text}.insert({element})"));
                    }
                }
            }
            Ty::Cells => {
                self.count("cell set");
                let (place, value) = (self.expr(Ty::Point, 2), self.expr(Ty::Int, 2));
                self.line(&format!("{text}[{place}] = {value}"));
            }
            Ty::Shares | Ty::Marks if self.random.percent(60) => {
                self.count("share set");
                let of = if memory.ty == Ty::Shares { Ty::Ratio } else { Ty::Found };
                let (place, value) = (self.expr(Ty::Point, 2), self.expr(of, 2));
                self.line(&format!("{text}[{place}] = {value}"));
            }
            ty => {
                self.count("assignment");
                let value = self.expr(ty, 3);
                self.line(&format!("{text} = {value}"));
            }
        }
    }

    /// Statements of a reaction or a `do`.
    pub(super) fn instantly(&mut self) {
        for _ in 0..1 + self.random.below(3) {
            match self.random.below(10) {
                0 if self.nested < 4 => self.branch(Self::instantly),
                1 if self.nested < 4 => self.rounds(Self::instantly),
                2 => {
                    self.count("var");
                    // Of a variable nobody knows that it is never negative.
                    let (name, ty) = (self.fresh("v"), self.any_type().or_length());
                    let value = self.expr(ty, 1);
                    self.line(&format!("var {name}: {} = {value}", ty.name()));
                    self.declare(&name, ty, true);
                    self.assign();
                }
                3 => self.simple(),
                4 => self.log(),
                _ => self.assign(),
            }
        }
    }
}
