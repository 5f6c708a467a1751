//! One table for both front seats: the simulated vehicle's own computer, and the one that serves a vehicle over a link. What
//! is asked for, who drives then, what the vehicle holds, and what is told of its limits.

#![expect(clippy::unwrap_used, reason = "a test whose vehicle cannot be made has failed")]

use Act::{Ask, GiveBack, Listen, TakeOver};
use albacore_front_seat::Handover;
use albacore_geometry::math::{degrees, radians};
use albacore_geometry::{Geodetic, Heading, Point, TangentFrame};
use albacore_guidance::Route;
use albacore_link::recon::{self, FromVehicle, State};
use albacore_link::{Controller, Rows, Server, ServerEvent};
use albacore_sim::{Bottom, Environment, OwnMission, Scenario, Simulator, VehicleSetup};
use albacore_vehicle::Control::{InControl, Monitoring, Refused, Released, Requesting, Suspended};
use albacore_vehicle::Vertical::{Altitude, Depth};
use albacore_vehicle::{Command, Control, Limits, Snapshot, Vehicle, Vertical};

/// The water is so deep everywhere, m.
const WATER_DEPTH: f64 = 30.0;
/// What the vehicle's own mission asks for: north, m/s, m.
const OWN: (f64, f64, f64) = (0.0, 1.5, 4.0);

/// Something that is wanted of the vehicle.
#[derive(Clone, Copy, Debug)]
enum Act {
    Listen,
    TakeOver,
    /// Heading in degrees, speed in m/s, and what to hold.
    Ask(f64, f64, Vertical),
    GiveBack,
}

/// What is done for so many ticks, and how it is then: who drives; the heading (degrees), speed (m/s) and depth (m) that the
/// vehicle holds; a part of what was told meanwhile, `""` where nothing may be told.
type Row = (Act, u32, Control, Option<(f64, f64, f64)>, &'static str);

struct Case {
    name: &'static str,
    limits: Option<Limits>,
    handover: Handover,
    rows: &'static [Row],
}

const SHALLOW: Limits = Limits { depth: Some(20.0), altitude: 3.0, speed: Some(2.0) };
const AT_ONCE: Handover = Handover {
    after: 0.0,
    refuses: false,
    silent: false,
    suspends: None,
    lasting: None,
    takes_back: None,
    offers: None,
};

/// Too deep, too low and too fast is what the scenario says, and no more than that is done.
const CASES: &[Case] = &[
    Case {
        name: "what is within the limits is held",
        limits: Some(SHALLOW),
        handover: AT_ONCE,
        rows: &[
            (Listen, 20, Monitoring, Some(OWN), ""),
            (TakeOver, 5, InControl, None, ""),
            (Ask(90.0, 2.0, Depth(20.0)), 20, InControl, Some((90.0, 2.0, 20.0)), ""),
            (Ask(270.0, 0.0, Depth(0.0)), 20, InControl, Some((270.0, 0.0, 0.0)), ""),
            (Ask(0.0, 1.0, Altitude(12.0)), 20, InControl, Some((0.0, 1.0, 18.0)), ""),
            (GiveBack, 20, Monitoring, None, ""),
        ],
    },
    Case {
        name: "what is beyond them is held at them, and told",
        limits: Some(SHALLOW),
        handover: AT_ONCE,
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(90.0, 1.0, Depth(80.0)), 20, InControl, Some((90.0, 1.0, 20.0)), "deeper than 20.00 m"),
            (Ask(90.0, 2.6, Depth(5.0)), 60, InControl, Some((90.0, 2.0, 5.0)), "faster than 2.00 m/s"),
            (Ask(90.0, 1.0, Altitude(2.0)), 20, InControl, Some((90.0, 1.0, 20.0)), "deeper than 20.00 m"),
            (Ask(90.0, 1.0, Altitude(11.0)), 20, InControl, Some((90.0, 1.0, 19.0)), ""),
        ],
    },
    Case {
        name: "the least altitude rules over the depth",
        limits: Some(Limits { depth: None, altitude: 5.0, speed: None }),
        handover: AT_ONCE,
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(0.0, 1.0, Depth(28.0)), 20, InControl, Some((0.0, 1.0, 25.0)), "nearer to the bottom than 5.00 m"),
        ],
    },
    Case {
        name: "and over the altitude",
        limits: Some(Limits { depth: None, altitude: 5.0, speed: None }),
        handover: AT_ONCE,
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(0.0, 1.0, Altitude(1.0)), 20, InControl, Some((0.0, 1.0, 25.0)), "nearer to the bottom than 5.00 m"),
        ],
    },
    Case {
        name: "without limits of its own its hull's speed is one",
        limits: None,
        handover: AT_ONCE,
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(0.0, 2.6, Depth(29.5)), 20, InControl, Some((0.0, 2.6, 29.5)), ""),
            (Ask(0.0, 9.0, Depth(5.0)), 20, InControl, Some((0.0, 2.6, 5.0)), "faster than 2.60 m/s"),
        ],
    },
    Case {
        name: "nothing goes astern or above the surface",
        limits: Some(SHALLOW),
        handover: AT_ONCE,
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(0.0, -1.0, Depth(5.0)), 20, InControl, Some((0.0, 0.0, 5.0)), "astern"),
            (Ask(0.0, 1.0, Depth(-3.0)), 20, InControl, Some((0.0, 1.0, 0.0)), "above the surface"),
        ],
    },
    Case {
        name: "its own plan is under them too",
        limits: Some(Limits { depth: Some(2.5), altitude: 0.0, speed: Some(1.0) }),
        handover: AT_ONCE,
        rows: &[(Listen, 20, Monitoring, Some((0.0, 1.0, 2.5)), "deeper than 2.50 m")],
    },
    Case {
        name: "who refuses goes on with its own plan",
        limits: None,
        handover: Handover { refuses: true, ..AT_ONCE },
        rows: &[(TakeOver, 350, Refused, Some(OWN), "")],
    },
    Case {
        name: "who takes its time gives way then",
        limits: None,
        handover: Handover { after: 4.0, ..AT_ONCE },
        rows: &[
            (TakeOver, 20, Requesting, Some(OWN), ""),
            (Listen, 30, InControl, None, ""),
            (Ask(45.0, 2.0, Depth(6.0)), 20, InControl, Some((45.0, 2.0, 6.0)), ""),
        ],
    },
    Case {
        name: "who suspends its guest lets it drive again",
        limits: None,
        handover: Handover { suspends: Some(5.0), lasting: Some(3.0), ..AT_ONCE },
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(45.0, 2.0, Depth(6.0)), 20, InControl, Some((45.0, 2.0, 6.0)), ""),
            (Ask(45.0, 2.0, Depth(6.0)), 40, Suspended, None, ""),
            (Ask(90.0, 1.0, Depth(7.0)), 40, InControl, Some((90.0, 1.0, 7.0)), ""),
        ],
    },
    Case {
        name: "who takes itself back is not driven any more",
        limits: None,
        handover: Handover { takes_back: Some(4.0), ..AT_ONCE },
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(0.0, 2.0, Depth(6.0)), 20, InControl, Some((0.0, 2.0, 6.0)), ""),
            (Ask(0.0, 2.0, Depth(6.0)), 40, Released, None, ""),
        ],
    },
    Case {
        name: "a guest that has given back may ask again",
        limits: None,
        handover: AT_ONCE,
        rows: &[
            (TakeOver, 5, InControl, None, ""),
            (Ask(0.0, 2.0, Depth(6.0)), 20, InControl, Some((0.0, 2.0, 6.0)), ""),
            (GiveBack, 20, Monitoring, None, ""),
            (TakeOver, 10, InControl, None, ""),
            (Ask(180.0, 1.0, Depth(8.0)), 20, InControl, Some((180.0, 1.0, 8.0)), ""),
        ],
    },
];

/// A computer in a front seat, with a guest.
trait Seat {
    fn act(&mut self, act: Act);
    /// One tick, and who drives.
    fn tick(&mut self, ask: Option<&Command>) -> Control;
    /// Degrees, m/s, m.
    fn held(&self) -> Option<(f64, f64, f64)>;
    fn told(&mut self) -> Vec<String>;
}

struct Simulated {
    vehicle: Simulator,
    snapshot: Snapshot,
}

impl Seat for Simulated {
    fn act(&mut self, act: Act) {
        match act {
            TakeOver => self.vehicle.take_over().unwrap(),
            GiveBack => self.vehicle.give_back().unwrap(),
            Listen | Ask(..) => {}
        }
    }

    fn tick(&mut self, ask: Option<&Command>) -> Control {
        self.vehicle.sense(&mut self.snapshot).unwrap();
        if let Some(command) = ask.filter(|_| self.snapshot.control == InControl) {
            self.vehicle.command(command).unwrap();
        }
        self.snapshot.control
    }

    fn held(&self) -> Option<(f64, f64, f64)> {
        let Command { heading, speed, vertical } = self.vehicle.held()?;
        let depth = match vertical {
            Depth(depth) => depth,
            Altitude(altitude) => WATER_DEPTH - altitude,
        };
        Some((degrees(heading.radians()), speed, depth))
    }

    fn told(&mut self) -> Vec<String> {
        self.vehicle.notices()
    }
}

struct Served {
    vehicle: Server<Simulator>,
    controller: Controller,
    snapshot: Snapshot,
    to_vehicle: Vec<u8>,
    state: Option<State>,
}

impl Seat for Served {
    fn act(&mut self, act: Act) {
        match act {
            TakeOver => self.controller.take_over(),
            GiveBack => self.controller.give_back(),
            Listen | Ask(..) => {}
        }
    }

    fn tick(&mut self, ask: Option<&Command>) -> Control {
        self.to_vehicle.extend(self.controller.take_output());
        self.vehicle.tick(&std::mem::take(&mut self.to_vehicle)).unwrap();
        let said = self.vehicle.take_output();
        for line in String::from_utf8(said.clone()).unwrap().lines() {
            let body = line.strip_prefix('#').and_then(|line| line.rsplit_once(",*")).unwrap().0;
            if let FromVehicle::State(state) = FromVehicle::parse(body).unwrap() {
                self.state = Some(state);
            }
        }
        self.controller.hear(&said);
        while self.controller.is_due() {
            self.controller.sense(&mut self.snapshot);
            if let Some(command) = ask.filter(|_| self.snapshot.control == InControl) {
                self.controller.command(command);
            }
        }
        self.snapshot.control
    }

    fn held(&self) -> Option<(f64, f64, f64)> {
        let state = self.state?;
        Some((degrees(state.heading_goal.radians()), state.rpm_goal / (1500.0 / 2.6), state.depth_goal))
    }

    fn told(&mut self) -> Vec<String> {
        let mut told = self.controller.take_notices();
        told.retain(|told| told.contains("error 2"));
        let happenings = self.vehicle.take_happenings().into_iter();
        told.extend(happenings.filter_map(|happening| match happening {
            ServerEvent::Notice(notice) => Some(notice),
            _ => None,
        }));
        told
    }
}

fn seats(case: &Case) -> [(&'static str, Box<dyn Seat>); 2] {
    let route: Route = "400x30x2".parse::<Rows>().unwrap().into();
    let scenario = Scenario {
        environment: Environment { bottom: Bottom::flat(WATER_DEPTH), ..Environment::default() },
        vehicle: VehicleSetup { depth: OWN.2, ..VehicleSetup::default() },
        limits: case.limits.clone(),
        own_mission: Some(OwnMission { route: route.clone(), vertical: Depth(OWN.2) }),
        ..Scenario::default()
    };
    let with_handover = Scenario { handover: Some(case.handover.clone()), ..scenario.clone() };
    let simulated = Simulated { vehicle: Simulator::new(&with_handover, 1).unwrap(), snapshot: Snapshot::default() };
    let frame = TangentFrame { origin: Geodetic::from_degrees(36.18, -75.74) };
    let start = (Point::ORIGIN, Heading::NORTH);
    let vehicle =
        Server::new(recon::server(), Simulator::new(&scenario, 1).unwrap(), frame, &route, start, Depth(OWN.2));
    let served = Served {
        vehicle: vehicle.answering(case.handover.clone()),
        controller: Controller::new(recon::controller(), frame),
        snapshot: Snapshot::default(),
        to_vehicle: Vec::new(),
        state: None,
    };
    [("simulated", Box::new(simulated)), ("served", Box::new(served))]
}

/// Within what the wire rounds to, the sounder measures, and a plan steers to keep its line.
fn near(held: (f64, f64, f64), wanted: (f64, f64, f64)) -> bool {
    let turn = Heading::from_radians(radians(held.0)) - Heading::from_radians(radians(wanted.0));
    degrees(turn.abs()) < 0.5 && (held.1 - wanted.1).abs() < 0.02 && (held.2 - wanted.2).abs() < 0.06
}

#[test]
fn both_front_seats_do_what_the_table_says() {
    for case in CASES {
        for (seat_name, mut seat) in seats(case) {
            seat.tick(None);
            for (i, (act, ticks, control, held, told)) in case.rows.iter().enumerate() {
                let at = format!("{}, {seat_name}, row {i}: {act:?}", case.name);
                seat.act(*act);
                let ask = match *act {
                    Ask(heading, speed, vertical) => {
                        Some(Command::new(Heading::from_degrees(heading), speed, vertical))
                    }
                    _ => None,
                };
                let mut now = Monitoring;
                (0..*ticks).for_each(|_| now = seat.tick(ask.as_ref()));
                assert_eq!(now, *control, "{at}");
                if let Some(wanted) = held {
                    let held = seat.held().unwrap();
                    assert!(near(held, *wanted), "{at}: holds {held:?} instead of {wanted:?}");
                }
                let heard = seat.told();
                assert_eq!(heard.is_empty(), told.is_empty(), "{at}: {heard:?}");
                assert!(told.is_empty() || heard.iter().any(|heard| heard.contains(told)), "{at}: {heard:?}");
            }
        }
    }
}
