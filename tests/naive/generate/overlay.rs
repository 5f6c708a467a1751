//! Overlays.

use super::{Callable, Generator, Ty};

impl Generator {
    /// One that amends the course, or commands nothing.
    pub(super) fn bend(&mut self) {
        let name = self.fresh("bend");
        let before = self.names.clone();
        let (params, types, needed) = self.params();
        if self.random.percent(30) {
            self.count("overlay beside");
            self.braces(&format!("overlay {name}{params}"), |g| {
                g.declarations(2);
                g.reactions("reaction of an overlay", 2);
                g.aborts(6);
                let (first, condition) = (g.time(), g.condition());
                g.line(&format!("wait for {first}"));
                g.line(&format!("wait until {condition}"));
                g.log();
            });
            self.names = before;
            return self.bends.push(Callable { name, params: types, needed, result: None });
        }
        self.braces(&format!("overlay {name}{params} amends course"), |g| {
            g.declarations(2);
            g.reactions("reaction of an overlay", 1);
            g.aborts(6);
            g.braces("amend", |g| {
                g.declare("asked", Ty::Heading, false);
                let course = g.expr(Ty::Heading, 2);
                let condition = g.expr(Ty::Bool, 2);
                g.line(&format!("if {condition} {{ {course} }} else {{ asked }}"));
            });
        });
        self.names = before;
        self.bends.push(Callable { name, params: types, needed, result: None });
    }

    /// One that owns the vertical channel.
    pub(super) fn vertical(&mut self) {
        let name = self.fresh("saw");
        let before = self.names.clone();
        let (params, types, needed) = self.params();
        self.braces(&format!("overlay {name}{params} sets vertical"), |g| {
            g.declarations(2);
            g.reactions("reaction of an overlay", 1);
            g.braces("loop", |g| {
                let (depth, condition, time) = (g.expr(Ty::Depth, 1), g.condition(), g.time());
                g.line(&format!("keep depth max({depth}, 1 m) until {condition} within {time}"));
                let time = g.time();
                g.line(&format!("keep altitude 6 m for {time}"));
                if g.random.percent(40) {
                    g.line("wait for 300 ms");
                }
            });
        });
        self.names = before;
        self.verticals.push(Callable { name, params: types, needed, result: None });
    }
}
