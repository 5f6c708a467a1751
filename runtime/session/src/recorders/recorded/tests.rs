use super::*;
use albacore_program::{Display, Mission, Recording, Shape};
use albacore_trace::Step;
use albacore_vehicle::{Sample, Snapshot};

/// A mission, activity 0, that records warmth and depth at 1 Hz, and a behavior in it, activity 1, that records warmth at 5 Hz.
fn recorded(most: usize) -> Recorded {
    let degrees = Shape::Quantity(Display { unit: "degC".to_string(), scale: 1.0, decimals: 2 });
    let input = |name: &str, shape: Shape| {
        let width = shape.words();
        Input { name: name.to_string(), at: 0, width, kept: 0, shape, fields: Vec::new() }
    };
    let program = Program {
        inputs: vec![input("depth", Shape::Depth), input("temperature", degrees)],
        recordings: vec![
            Recording { activity: 0, inputs: vec![(1, Vec::new()), (0, Vec::new())], rate: 1.0 },
            Recording { activity: 1, inputs: vec![(1, Vec::new())], rate: 5.0 },
        ],
        mission: Mission { activity: 0, ..Mission::default() },
        ..Program::default()
    };
    let measurement = |name: &str| Measurement { name: name.to_string(), width: 1 };
    Recorded::of(Arc::new(program), None, &[measurement("depth"), measurement("temperature")], most)
}

/// A tick with these samples: each a measurement and its number.
fn tick(tick: u64, active: &[ActivityId], samples: &[(u16, f64)]) -> TickRecord {
    let samples = samples.iter().map(|&(measurement, x)| Sample { measurement, reading: [x, 0.0, 0.0, 0.0] });
    let snapshot = Snapshot { samples: samples.collect(), ..Snapshot::default() };
    TickRecord { tick, step: Step::Tick, snapshot, active: active.to_vec(), ..TickRecord::default() }
}

const HEAD: &str = "time (s),north (m),east (m),depth (m),temperature (degC)\n";

#[test]
fn a_cell_holds_what_came_since_it_was_due_last() {
    let mut recorded = recorded(1000);
    // Nothing is recorded before the mission has begun; the sensor falls silent after 1 s.
    for at in 0..=30 {
        let warmth = if at <= 10 { vec![(0, 2.0), (1, at as f64 / 10.0)] } else { vec![(0, 2.0)] };
        recorded.take(&tick(at, if at == 0 { &[] } else { &[0] }, &warmth));
    }
    assert_eq!(recorded.text(), format!("{HEAD}1.0,,,2,1\n2.0,,,2,\n3.0,,,2,\n"));
}

#[test]
fn what_is_recorded_at_two_rates_stands_in_one_row() {
    let mut recorded = recorded(1000);
    (0..=10).for_each(|at| recorded.take(&tick(at, &[0, 1], &[(1, at as f64)])));
    let rows = "0.0,,,,0\n0.2,,,,2\n0.4,,,,4\n0.6,,,,6\n0.8,,,,8\n1.0,,,,10\n";
    assert_eq!(recorded.text(), format!("{HEAD}{rows}"));
}

/// A behavior that is not active takes no sample from the mission's row.
#[test]
fn what_is_not_recorded_is_not_told() {
    let mut recorded = recorded(1000);
    // The behavior's clause is due at 0.6 s and 0.8 s, and it is not active; it is from 1.2 s on.
    (3..=14).for_each(|at| {
        let samples = if at == 5 || at == 11 { vec![(1, at as f64)] } else { Vec::new() };
        recorded.take(&tick(at, if at < 12 { &[0] } else { &[0, 1] }, &samples));
    });
    assert_eq!(recorded.text(), format!("{HEAD}1.0,,,,5\n1.2,,,,11\n1.4,,,,\n"));
}

#[test]
fn a_mission_records_in_its_recovery_too_and_a_behavior_while_it_is_active() {
    let mut recorded = recorded(1000);
    (1..=10).for_each(|at| recorded.take(&tick(at, &[2], &[(1, at as f64)])));
    assert_eq!(recorded.text(), format!("{HEAD}1.0,,,,10\n"));
}

/// A sample that is withheld, or that no value of its input can be, has not come: as for the mission.
#[test]
fn what_no_input_takes_is_not_recorded() {
    let mut recorded = recorded(1000);
    let mut record = tick(10, &[0], &[(1, 7.0), (1, 1e200), (1, f64::NAN), (1, 9.0), (9, 9.0)]);
    record.snapshot.samples[3].withhold();
    recorded.take(&record);
    assert_eq!(recorded.text(), format!("{HEAD}1.0,,,,7\n"));
}

/// Place and depth beside a row are as old as limits take them to be, at most.
#[test]
fn a_depth_beside_a_row_grows_old() {
    let mut recorded = recorded(2000);
    // Without the mission's own clause, which records depth.
    recorded.clauses.remove(0);
    recorded.take(&tick(5, &[1], &[(0, 3.5)]));
    (6..=56).for_each(|at| recorded.take(&tick(at, &[1], &[])));
    let rows: Vec<&str> = recorded.text().lines().skip(1).filter(|row| row.contains(".0,")).collect();
    assert_eq!(rows, ["1.0,,,3.5,", "2.0,,,3.5,", "3.0,,,3.5,", "4.0,,,3.5,", "5.0,,,3.5,"]);
    assert!(recorded.text().ends_with("5.4,,,3.5,\n5.6,,,,\n"), "{}", recorded.text());
}

/// Where depth itself is recorded, none stands twice in its rows; beside those of others it stands as ever.
#[test]
fn a_depth_that_is_recorded_is_told_once() {
    let mut recorded = recorded(1000);
    recorded.take(&tick(5, &[0, 1], &[(0, 3.5)]));
    (6..=30).for_each(|at| recorded.take(&tick(at, &[0, 1], if at == 22 { &[(0, 4.0)] } else { &[] })));
    let rows: Vec<&str> = recorded.text().lines().skip(1).filter(|row| row.contains(".0,")).collect();
    assert_eq!(rows, ["1.0,,,3.5,", "2.0,,,,", "3.0,,,4,"]);
    assert!(recorded.text().contains("\n1.8,,,3.5,\n"), "{}", recorded.text());
}

#[test]
fn a_full_table_says_how_many_rows_it_lacks() {
    let rows = "1.0,,,,\n2.0,,,,\n";
    let mut recorded = recorded(HEAD.len() + rows.len());
    (1..=50).for_each(|at| recorded.take(&tick(at, &[0], &[])));
    assert_eq!((recorded.text(), recorded.rows()), (&*format!("{HEAD}{rows}"), (2, 3)));
}

/// Behind a gap in a journal nobody knows what has become active in it.
#[test]
fn a_mission_records_behind_a_gap() {
    let mut recorded = recorded(1000);
    recorded.take(&tick(5, &[0], &[(1, 5.0)]));
    recorded.miss(10, 16);
    (16..=20).for_each(|at| recorded.take(&tick(at, &[], &[(1, at as f64)])));
    assert_eq!(recorded.text(), format!("{HEAD}2.0,,,,20\n"));
}
