//! Numbers that are none, or that no vehicle can mean, in every field of every message, both ways.

#![expect(clippy::unwrap_used, reason = "a test whose vehicle cannot be made has failed")]

use albacore_geometry::{Geodetic, Heading, Point, TangentFrame};
use albacore_link::recon::{self, seal};
use albacore_link::{Controller, Rows, Server};
use albacore_sim::{Fault, FaultKind, Scenario, Sensor, SensorFault, Simulator, VehicleSetup};
use albacore_vehicle::measurements::ALTITUDE;
use albacore_vehicle::{Limits, Snapshot, Vertical};

/// As a vehicle may send them: all that has numbers.
const FROM_VEHICLE: [&str; 7] = [
    "S,T12:00:00.100,LAT39N30.5553,LON74W19.4386,D-0.10,DG0.00,A5.00,P-0.3,R3.0,TR0,TRG0,V0.00,H0.4,HR0.0,HG0.0,M10,l0",
    "A,F1.200,S-0.050,V0.000,A12.50,H123.4,CF0.100,CS-0.050,CU0.000,U",
    "c,T12.100,C3.400,S35.000,D3.00,V1500.00",
    "F,G1,V-0.0123",
    "B,C1000.0,A523.4,P52.3",
    "C,Speed,1.50 meters/sec",
    "E,107,Illegal time",
];

/// As a guest may send them.
const TO_VEHICLE: [&str; 9] = [
    "C,Heading,Goal,359.9",
    "C,Heading,Rate,-5.0",
    "C,Depth,Depth,4.00",
    "C,Depth,Altitude,2.00",
    "C,Depth,Triangle,3.0,3.0,10.0,30.0",
    "C,Speed,1.50 meters/sec",
    "C,Speed,600 rpm",
    "C,Speed,3.00 knots",
    "c,0",
];

/// What stands for a number instead.
fn instead() -> Vec<String> {
    let mut instead: Vec<String> = [
        "",
        "-",
        "+",
        ".",
        "-0",
        "-0.0",
        "+0",
        "nan",
        "NaN",
        "inf",
        "-inf",
        "Infinity",
        "1e308",
        "1e-400",
        "1e9",
        "999999999",
        "-999999999",
        "12000",
        "-12000",
        "0x10",
        "1,5",
        "1,,2",
        "1;5",
        " 1",
        "1 ",
        "#",
        "*",
        "1*00",
        "½",
        "\u{0}",
        "\u{7f}",
        "\u{1b}[2J",
        "18446744073709551616",
        "-1",
        "65536",
    ]
    .map(str::to_string)
    .into();
    for digits in [20, 308, 309, 400, 900, 2000] {
        instead.push("9".repeat(digits));
        instead.push(format!("-{}", "9".repeat(digits)));
        instead.push(format!("0.{}1", "0".repeat(digits)));
    }
    instead
}

/// A message with each of its numbers in turn replaced by each of those.
fn variants(body: &str) -> Vec<String> {
    let numeric = |b: u8| b.is_ascii_digit() || matches!(b, b'.' | b'-');
    let bytes = body.as_bytes();
    let mut spans = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let length = bytes[at..].iter().take_while(|b| numeric(**b)).count();
        if length > 0 {
            spans.push(at..at + length);
        }
        at += length.max(1);
    }
    assert!(!spans.is_empty(), "{body}");
    let of = |span: &std::ops::Range<usize>| {
        let (head, tail) = (body[..span.start].to_string(), body[span.end..].to_string());
        instead().into_iter().map(move |number| format!("{head}{number}{tail}"))
    };
    spans.iter().flat_map(of).collect()
}

fn frame() -> TangentFrame {
    TangentFrame { origin: Geodetic::from_degrees(39.5, -74.3) }
}

fn vehicle() -> Server<Simulator> {
    let limits = Some(Limits { depth: Some(10.0), altitude: 2.0, speed: Some(2.0) });
    let setup = VehicleSetup { depth: 3.0, ..VehicleSetup::default() };
    let simulator = Simulator::new(&Scenario { vehicle: setup, limits, ..Scenario::default() }, 1).unwrap();
    let rows: Rows = "100x20x2".parse().unwrap();
    Server::new(
        recon::server(),
        simulator,
        frame(),
        &rows.into(),
        (Point::ORIGIN, Heading::NORTH),
        Vertical::Depth(3.0),
    )
}

/// All that came from the vehicle is finite, and of a size that its sums and products stay so.
#[test]
fn no_number_from_a_vehicle_reaches_a_mission_that_is_none() {
    let mut readings = 0;
    for body in FROM_VEHICLE.iter().flat_map(|body| variants(body)) {
        let mut controller = Controller::new(recon::controller(), frame());
        // A profiler's drift becomes a course with the state that follows.
        for body in [&body, FROM_VEHICLE[0]] {
            controller.hear(seal(body).as_bytes());
        }
        let mut snapshot = Snapshot::default();
        while controller.is_due() {
            controller.sense(&mut snapshot);
            for sample in &snapshot.samples {
                readings += 1;
                assert!(sample.reading.iter().all(|x| x.is_finite() && x.abs() <= 1e9), "#{body}: {sample:?}");
            }
        }
    }
    assert!(readings > 10_000, "{readings}");
}

/// The vehicle lives, holds what it may, and speaks in numbers.
#[test]
fn no_number_from_a_guest_stops_the_vehicle_or_takes_it_beyond_its_limits() {
    let mut vehicle = vehicle();
    vehicle.tick(seal("E,1").as_bytes()).unwrap();
    for body in TO_VEHICLE.iter().flat_map(|body| variants(body)) {
        vehicle.tick((seal(&body) + &seal("V,still here")).as_bytes()).unwrap();
        let said = String::from_utf8(vehicle.take_output()).unwrap();
        assert!(said.lines().all(|line| line.len() < 200), "#{body}: {said}");
        let state = said.lines().find(|line| line.starts_with("#S")).unwrap();
        let number = |name: &str| -> f64 {
            let field = state.split(',').find(|field| field.starts_with(name)).unwrap();
            field[name.len()..].parse().unwrap()
        };
        assert!((0.0..=10.0).contains(&number("DG")), "#{body}: {state}");
        assert!((0.0..=1154.0).contains(&number("TRG")), "#{body}: {state}");
        assert!((0.0..360.0).contains(&number("HG")), "#{body}: {state}");
        assert!(!said.contains("inf") && !said.to_lowercase().contains("nan"), "#{body}: {said}");
    }
    assert!(vehicle.is_driven(), "it was driven all the while");
}

/// The lines that an attack sent, and what is answered.
#[test]
fn a_command_that_makes_no_sense_is_answered_with_an_error() {
    let mut vehicle = vehicle();
    vehicle.tick(seal("E,1").as_bytes()).unwrap();
    vehicle.take_output();
    let nines = "9".repeat(400);
    for (body, answer) in [
        (format!("C,Depth,Altitude,{nines}"), "#E,6,is no command of this dialect"),
        ("C,Depth,80".into(), "#E,6,is no command of this dialect"),
        ("C,Depth,Depth,80.00".into(), "#E,2,is asked to go deeper than 10.00 m: it stays there"),
        ("C,Speed,2.60 meters/sec".into(), "#E,2,is asked to go faster than 2.00 m/s: it goes no faster"),
        ("C,Heading,Rate,90.0".into(), "#E,2,faster than this vehicle turns"),
        ("C,Depth,Triangle,3.0,3.0,10.0,30.0".into(), "#E,3,this vehicle does not do that"),
        ("C,Depth,Depth,10.00".into(), "#C,Depth,Depth,10.00"),
    ] {
        vehicle.tick(seal(&body).as_bytes()).unwrap();
        let said = String::from_utf8(vehicle.take_output()).unwrap();
        assert!(said.lines().any(|line| line.starts_with(answer)), "#{body}: {said}");
    }
    let told: Vec<String> = vehicle.take_happenings().iter().map(ToString::to_string).collect();
    let absurd = told.iter().find(|told| told.contains("Altitude")).unwrap();
    assert!(absurd.starts_with("refused `#C,Depth,Altitude,999") && absurd.len() < 120, "{absurd}");
}

/// The attack: a flood of questions, each of which was answered, let the vehicle's clock lag. The newest counts.
#[test]
fn a_flood_is_taken_in_to_an_end() {
    let mut vehicle = vehicle();
    vehicle.tick(seal("E,1").as_bytes()).unwrap();
    vehicle.take_output();
    let flood = seal("v").repeat(100_000) + &seal("C,Nonsense").repeat(100_000) + &seal("C,Heading,Goal,90.0");
    vehicle.tick(flood.as_bytes()).unwrap();
    let said = String::from_utf8(vehicle.take_output()).unwrap();
    assert!(said.lines().count() < 1_000, "{}", said.lines().count());
    assert!(said.contains("#C,Heading,Goal,90.0"), "{}", said.len());
    vehicle.tick(seal("v").repeat(500).as_bytes()).unwrap();
    let said = String::from_utf8(vehicle.take_output()).unwrap();
    assert_eq!(said.matches("#V,").count(), 1, "{said}");
}

/// It answers by what it does, and not by what its faulty sounder tells.
#[test]
fn a_goal_too_near_to_the_bottom_is_answered_by_the_vehicles_own_altitude() {
    for size in [20.0, -20.0] {
        let limits = Some(Limits { altitude: 2.0, ..Limits::default() });
        let trouble = FaultKind::Sensor(Sensor::of(ALTITUDE).unwrap(), SensorFault::Wrong(size));
        let faults = vec![Fault { trouble, from: 0.0, to: None }];
        let simulator = Simulator::new(&Scenario { limits, faults, ..Scenario::default() }, 1).unwrap();
        let water = simulator.water_depth(Point::ORIGIN);
        let rows: Rows = "100x20x2".parse().unwrap();
        let start = (Point::ORIGIN, Heading::NORTH);
        let mut vehicle = Server::new(recon::server(), simulator, frame(), &rows.into(), start, Vertical::Depth(1.0));
        vehicle.tick(seal("E,1").as_bytes()).unwrap();
        for (above, accepted) in [(1.0, false), (3.0, true)] {
            vehicle.take_output();
            vehicle.tick(seal(&format!("C,Depth,Depth,{:.2}", water - above)).as_bytes()).unwrap();
            let said = String::from_utf8(vehicle.take_output()).unwrap();
            assert_eq!(said.contains("#C,Depth"), accepted, "{size}, {above}: {said}");
            assert_eq!(
                said.contains("#E,2,is asked to come nearer to the bottom"),
                !accepted,
                "{size}, {above}: {said}"
            );
        }
    }
}

/// What it holds is within its limits, whatever its sounder tells.
#[test]
fn a_goal_above_the_bottom_is_told_no_deeper_than_the_limit() {
    let limits = Some(Limits { depth: Some(4.0), ..Limits::default() });
    let trouble = FaultKind::Sensor(Sensor::of(ALTITUDE).unwrap(), SensorFault::Garbage);
    let faults = vec![Fault { trouble, from: 0.0, to: None }];
    let simulator = Simulator::new(&Scenario { limits, faults, ..Scenario::default() }, 1).unwrap();
    let altitude = simulator.water_depth(Point::ORIGIN) - 2.0;
    let rows: Rows = "100x20x2".parse().unwrap();
    let start = (Point::ORIGIN, Heading::NORTH);
    let mut vehicle = Server::new(recon::server(), simulator, frame(), &rows.into(), start, Vertical::Depth(1.0));
    vehicle.tick((seal("E,1") + &seal(&format!("C,Depth,Altitude,{altitude:.2}"))).as_bytes()).unwrap();
    for _ in 0..200 {
        vehicle.tick(seal("V,still here").as_bytes()).unwrap();
    }
    let said = String::from_utf8(vehicle.take_output()).unwrap();
    let goals = said.lines().filter_map(|line| line.split(",DG").nth(1)?.split(',').next()?.parse::<f64>().ok());
    let goals: Vec<f64> = goals.collect();
    assert!(goals.len() > 190 && goals.iter().all(|goal| (0.0..=4.0).contains(goal)), "{goals:?}");
}
