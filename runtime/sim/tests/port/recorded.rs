//! A vehicle in a recorded plume, through the port alone.

use crate::world;
use albacore_formats::recording::{Recording, RecordingHeader};
use albacore_geometry::{Heading, Point, Vector};
use albacore_sim::{Environment, RecordedPlume, Scenario, Simulator, Tide};
use albacore_vehicle::{Command, Snapshot, Vehicle, Vertical};
use std::error::Error;
use std::sync::Arc;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../missions/recorded");

fn recording() -> Result<Arc<Recording>, Box<dyn Error>> {
    let header = RecordingHeader::read(&std::fs::read_to_string(format!("{FOLDER}/case_a.json"))?)?;
    Ok(Arc::new(header.decode(&std::fs::read(format!("{FOLDER}/case_a.bin"))?)?))
}

/// In the record from a moment on, at a place.
fn scenario(start: f64, place: Point) -> Result<Scenario, Box<dyn Error>> {
    let recording = Some(RecordedPlume { start, ..RecordedPlume::new(recording()?) });
    let mut scenario =
        Scenario { environment: Environment { recording, ..Environment::default() }, ..Scenario::default() };
    scenario.instruments.adcp.noise = 0.0;
    (scenario.vehicle.start, scenario.vehicle.depth) = (place, 5.0);
    Ok(scenario)
}

/// It drifts with the recorded flow, its profiler reads that flow and its nose the recorded chemical, all at the record's time.
#[test]
fn sensors_read_the_record() {
    let (start, place) = (1200.0, Point::new(400.0, -25.0));
    let record = recording().unwrap();
    let mut simulator = Simulator::new(&scenario(start, place).unwrap(), 1).unwrap();
    let mut snapshot = Snapshot::default();
    (0..100).for_each(|_| simulator.sense(&mut snapshot).unwrap());
    let truth = simulator.truth();
    let carried = 9.9 * record.flow(place, start + 5.0);
    assert!((truth.position - (place + carried)).length() < 0.01, "{truth:?} {carried:?}");

    simulator.take_over().unwrap();
    simulator.command(&Command::new(Heading::NORTH, 1.0, Vertical::Depth(5.0))).unwrap();
    let measurement = |name: &str| simulator.measurements().iter().position(|c| c.name == name).unwrap() as u16;
    let (flow, chemical) = (measurement("flow"), measurement("chemical"));
    let (mut flows, mut detections, mut saturated) = (Vec::new(), 0, 0);
    for _ in 0..400 {
        simulator.sense(&mut snapshot).unwrap();
        let (truth, time) = (simulator.truth(), start + simulator.time_s());
        let nose = truth.position + 0.8 * truth.heading.unit();
        let wanted = 0.04 * record.concentration(Default::default(), nose, time);
        assert!((truth.concentration - wanted).abs() < 1e-9 * wanted.max(1.0), "{} not {wanted}", truth.concentration);
        for sample in &snapshot.samples {
            if sample.measurement == flow {
                flows.push(Vector::new(sample.reading[0], sample.reading[1]));
            }
            if sample.measurement == chemical {
                detections += u32::from(sample.reading[0] > 0.04);
                saturated += u32::from(sample.reading[0] >= 1.0);
                assert!(sample.reading[0] <= 1.0);
            }
        }
    }
    let last = *flows.last().unwrap();
    assert!((last - record.flow(place, start + 20.0)).length() < 0.01, "{last:?}");
    assert!(detections > 40 && saturated > 3, "{detections} detections, {saturated} at full scale");
}

#[test]
fn a_run_ends_with_its_record() {
    let mut simulator = Simulator::new(&scenario(5390.0, Point::ORIGIN).unwrap(), 1).unwrap();
    let mut snapshot = Snapshot::default();
    let sensed = (0..200).take_while(|_| simulator.sense(&mut snapshot).is_ok()).count();
    assert_eq!(sensed, 101, "ticks 0 to 100");
    let why = simulator.sense(&mut snapshot).unwrap_err().to_string();
    assert!(why.contains("the recorded plume ends after 5400 s"), "{why}");
}

#[test]
fn impossible_playbacks_are_refused() {
    let fault = |change: &dyn Fn(&mut Scenario, &mut RecordedPlume)| {
        let mut scenario = scenario(0.0, Point::ORIGIN).unwrap();
        let mut recorded = scenario.environment.recording.take().unwrap();
        change(&mut scenario, &mut recorded);
        scenario.environment.recording = Some(recorded);
        scenario.validate().map_or_else(|error| error.to_string(), |()| String::from("sound"))
    };
    assert_eq!(fault(&|_, _| ()), "sound");
    let own = world::flat();
    for (said, expected) in [
        (fault(&|_, r| r.start = 5400.0), "that ends at 5400 s"),
        (fault(&|_, r| (r.start, r.start_spread) = (3000.0, 2500.0)), "the run begins up to 5500 s"),
        (fault(&|s, _| s.environment.flow.tides = vec![Tide::default()]), "brings its own plume and its own flow"),
        (
            fault(&|s, _| {
                (s.environment.plume, s.environment.region) =
                    (own.environment.plume.clone(), own.environment.region.clone())
            }),
            "brings its own plume",
        ),
    ] {
        assert!(said.contains(expected), "{said}, not {expected}");
    }
}
