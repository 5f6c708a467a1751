//! One script on both: the machine drives, the evaluator sees the same samples, and every tick is compared to the bit.

use crate::evaluator::{Evaluator, Request, override_block, recovery};
use crate::events::lines;
use albacore_machine::{ControlRequest, Machine};
use albacore_session::Script;
use albacore_vehicle::{Command, Snapshot, Vehicle, Vertical};
use std::sync::Arc;

/// What both sides said of a run, or where they first differed.
pub struct Run {
    pub ticks: u64,
    pub events: Vec<String>,
    pub difference: Option<String>,
}

pub fn compare(script: &Script, mission: &str, vehicle: &mut dyn Vehicle, ticks_max: u64) -> Run {
    let program = script.mission(mission).expect("the mission").expect("a program");
    let checked = script.checked(mission).expect("the mission");
    let most = script.cost(mission).expect("the mission").expect("a cost").steps;
    let (recovery, block) = (recovery(checked.0, checked.2), override_block(checked.0, checked.2));
    let sensors = vehicle.measurements().to_vec();
    let mut machine = Machine::new(Arc::new(program), &sensors).expect("a vehicle that delivers");
    let mut evaluator = Evaluator::new(checked, &script.sources, (&recovery, &block), &sensors).expect("a mission");
    let mut run = Run { ticks: 0, events: Vec::new(), difference: None };
    let mut snapshot = Snapshot::default();
    let mut asked = false;
    let mut before = follow(&machine, &mut asked);
    assert_eq!(before, evaluator.requests(), "before the first tick");
    while run.ticks < ticks_max && machine.outcome().is_none() {
        vehicle.sense(&mut snapshot).expect("samples");
        before.drain(..).for_each(|request| fulfil(request, vehicle));
        let command = machine.step(&snapshot);
        let events = lines(machine.program(), machine.events());
        let requests = follow(&machine, &mut asked);
        let naive = evaluator.step(&snapshot);
        let wanted = evaluator.requests();
        if words(command) != words(naive) || events != evaluator.w.events || requests != wanted {
            let side = |command: Option<Command>, events: &[String], requests: &[Request]| {
                format!("{command:?} {requests:?}\n  {}", events.join("\n  "))
            };
            run.difference = Some(format!(
                "tick {}\nmachine: {}\nevaluator: {}\nbefore:\n  {}",
                run.ticks,
                side(command, &events, &requests),
                side(naive, &evaluator.w.events, &wanted),
                run.events[run.events.len().saturating_sub(12)..].join("\n  ")
            ));
            return run;
        }
        let steps = evaluator.w.steps;
        if steps > most {
            run.difference = Some(format!("tick {}: {steps} steps, and at most {most} were foretold", run.ticks));
            return run;
        }
        for (id, action) in machine.requests() {
            vehicle.ask(id, action).expect("a question taken");
        }
        run.events.extend(events);
        if let Some(command) = command {
            vehicle.command(&command).expect("a command taken");
        }
        requests.into_iter().for_each(|request| fulfil(request, vehicle));
        run.ticks += 1;
    }
    if machine.outcome().is_some() != evaluator.is_over() {
        run.difference = Some("one is over, the other is not".to_string());
    }
    run
}

/// What the machine asks of the vehicle itself, by what it wishes: who drives it asks for control and gives it back so.
fn follow(machine: &Machine, asked: &mut bool) -> Vec<Request> {
    if machine.outcome().is_some() {
        return vec![Request::Release];
    }
    let mut requests = Vec::new();
    if *asked && machine.asks_anew() {
        *asked = false;
        requests.push(Request::GiveBack);
    }
    let wants = machine.wish() != ControlRequest::Listen;
    if wants != std::mem::replace(asked, wants) {
        requests.push(if wants { Request::TakeOver } else { Request::GiveBack });
    }
    requests
}

fn fulfil(request: Request, vehicle: &mut dyn Vehicle) {
    match request {
        Request::TakeOver => vehicle.take_over(),
        Request::GiveBack => vehicle.give_back(),
        Request::Release => vehicle.release(),
    }
    .expect("a vehicle that hears");
}

/// A command to the bit; one zero is as good as the other.
fn words(command: Option<Command>) -> Option<[u64; 4]> {
    command.map(|command| {
        let (kind, metres) = match command.vertical {
            Vertical::Depth(metres) => (0, metres),
            Vertical::Altitude(metres) => (1, metres),
        };
        let bits = |x: f64| (x + 0.0).to_bits();
        [bits(command.heading.radians()), bits(command.speed), kind, bits(metres)]
    })
}
