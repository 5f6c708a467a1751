use albacore_geometry::*;
use albacore_sim::*;
use albacore_vehicle::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let seeds: u64 = args[1].parse().unwrap();
    let secs: u64 = args[2].parse().unwrap();
    let range_error: f64 = args[3].parse().unwrap();
    let case = args[4].as_str();
    let mut totals = [0.0f64; 30];
    for seed in 1..=seeds {
        let mut s = Scenario::default();
        let hull = if args.get(5).is_some_and(|x| x == "k") {
            HullSetup::Kinematic(KinematicHull::default())
        } else {
            HullSetup::Prestero(SubmersibleHull::prestero(), hull::Crossflow::Corrected)
        };
        s.vehicle = VehicleSetup {
            hull,
            start: Point::new(1200.0, 0.0),
            heading: Heading::from_degrees(180.0),
            depth: 10.0,
            ..Default::default()
        };
        s.environment.flow.mean = Vector::new(0.2, 0.4);
        s.environment.bottom.ground = Ground::Plane(Plane { from: 40.0, to: 40.0, ..Default::default() });
        s.instruments.pressure = Pressure { noise: 200.0 / 1025.0 / 9.81, rate: 5.0, ..Default::default() };
        s.instruments.dvl = Dvl { noise: 0.05, rate: 5.0, ..Default::default() };
        let navigator = serde_json::from_str(&format!(
            "{{\"inertial\":{{\"start\":1.0,\"range_error\":{range_error},\"model\":{}}}}}",
            case == "3" || case == "34"
        ))
        .unwrap();
        s.instruments.navigation = Some(Navigation { navigator, lbl: None });
        if case != "1" {
            s.instruments.inverted_usbl = Some(InvertedUsbl { sound_speed: Some(1500.0), ..Default::default() });
            let (heard, silent) = if case == "5" { (Some(50.0), 50.0) } else { (None, 0.0) };
            s.environment.transponder = Some(Transponder {
                at: Point::new(0.0, 500.0),
                depth: 2.0,
                drift: Vector::ZERO,
                heard,
                silent,
                sound_speed: Some(1500.0),
            });
        }
        if case == "2" || case == "4" || case == "3" || case == "34" {
            let f = |name: &str| Fault {
                trouble: FaultKind::Sensor(Sensor::try_from(name.to_string()).unwrap(), SensorFault::Off),
                from: secs as f64 * 0.3,
                to: Some(secs as f64 * 0.6),
            };
            s.faults.push(f("speed"));
            if case == "4" || case == "34" {
                s.faults.push(f("receivers"));
            }
        }
        let mut sim = Simulator::new(&s, seed).unwrap();
        let mut snap = Snapshot::default();
        sim.take_over().unwrap();
        let mut leg = 0;
        let mut n = 0.0;
        let mut nees = 0.0;
        let mut nis = [[0.0; 2]; 4];
        let mut inside = [0.0; 5];
        let mut most = [0.0f64; 5];
        let mut most_h = 0.0f64;
        let mut sum_h = 0.0;
        let mut part = [0.0; 5];
        for tick in 0..secs * 10 {
            sim.sense(&mut snap).unwrap();
            for n in sim.notices() {
                if args.get(6).is_some() {
                    println!("seed {seed} {:.1} {n}", tick as f64 / 10.0);
                }
            }
            let p = sim.truth().position;
            let goal = |leg: i32| {
                let lane = leg / 2;
                let s = if lane % 2 == 0 { 1.0 } else { -1.0 };
                Point::new(if leg % 2 == 0 { s * 1200.0 } else { -s * 1200.0 }, 250.0 * lane as f64)
            };
            if p.distance(goal(leg)) < 5.0 {
                leg += 1;
            }
            let h = (goal(leg) - p).toward();
            let depth = if tick > secs * 3 { 15.0 } else { 10.0 };
            let _ = sim.command(&Command::new(h, 1.54, Vertical::Depth(depth)));
            let Some(e) = sim.navigation() else { continue };
            if tick % 10 == 5 {
                let _ = part;
            }
            for k in 0..4 {
                if let Some(x) = e.nis[k] {
                    nis[k][0] += x;
                    nis[k][1] += 1.0;
                }
            }
            if tick % 10 == 0 {
                n += 1.0;
                nees += e.nees;
                for k in 0..5 {
                    for i in 3 * k..3 * k + 3 {
                        if e.error[i].abs() <= 3.0 * e.sigma[i] {
                            inside[k] += 1.0 / 3.0;
                        }
                        if tick > 300 {
                            most[k] = most[k].max(e.error[i].abs());
                        }
                    }
                }
                let err = e.error[6].hypot(e.error[7]);
                most_h = most_h.max(err);
                sum_h += err;
                if args.get(6).is_some() && tick % 500 == 0 {
                    println!(
                        "t {:.0} err {:.2?} sigma {:.2?} nees {:.2} yaw {:.4} sy {:.4}",
                        tick as f64 / 10.0,
                        &e.error[6..8],
                        &e.sigma[6..8],
                        e.nees,
                        e.error[2],
                        e.sigma[2]
                    );
                }
            }
        }
        let row: Vec<f64> = [nees / n]
            .into_iter()
            .chain(nis.iter().map(|x| x[0] / f64::max(x[1], 1.0)))
            .chain(inside.iter().map(|x| x / n))
            .chain(most)
            .chain([sum_h / n, most_h])
            .collect();
        println!(
            "seed {seed} nees {:.3} nis {:.3?} inside {:.4?} most {:.4?} h mean {:.2} max {:.2} leg {leg}",
            row[0],
            &row[1..5],
            &row[5..10],
            &row[10..15],
            row[15],
            row[16]
        );
        for (t, x) in totals.iter_mut().zip(row) {
            *t += x / seeds as f64;
        }
    }
    println!("mean {:.3?}", &totals[..17]);
}
