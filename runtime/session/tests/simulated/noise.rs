//! Instruments may scatter as much as scenarios allow: what they tell is believed, and no mission is aborted for it.

use albacore_session::{Outcome, Plan, Run, Script, Source, load_text};

/// The instruments whose samples are judged, and the most that each may scatter.
const NOISIEST: [(&str, f64, &str); 5] = [
    ("sounder", 30.0, "cm"),
    ("compass", 3.5, "deg"),
    ("pressure", 20.0, "cm"),
    ("dvl", 5.0, "cm/s"),
    ("battery", 1.5, "%"),
];

fn script(instruments: &str) -> Script {
    let text = format!(
        "mission m in bay within 15 min {{
            area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 2 km, width: 2 km)
            limits {{ altitude >= 5 m, depth <= 100 m, speed <= 3 m/s }}
            requires {{ depth, altitude, heading, course, speed, battery fresh 1 s, else abort }}
            recovery within 1 min {{ steer north for 1 min }}
            with speed 1.5 m/s, altitude 8 m
            memory seen: Bool = false
            on battery < 1 % or speed < 0 m/s or course - heading > 179 deg {{ seen = true }}
            for n in 1..5 {{
                steer north for 1 min at depth 5 m
                steer east for 1 min
            }}
        }}
        scenario bay {{
            vehicle(kinematic, start: point(north: 0 m, east: 0 m), depth: 3 m)
            bottom(from: 20 m, to: 20 m)
            {instruments}
        }}"
    );
    load_text(Source { name: "m.alb".into(), text: text.into() })
}

fn clause((name, noise, unit): (&str, f64, &str)) -> String {
    // The gauge of the battery is slow of itself.
    let rate = if name == "battery" { ", rate: 10 Hz" } else { "" };
    format!("{name}(noise: {noise} {unit}{rate})\n")
}

#[test]
fn the_noisiest_instruments_abort_no_mission() {
    let script = script(&NOISIEST.map(clause).concat());
    assert!(script.is_sound(), "{:#?}", script.findings);
    for seed in 1..=4 {
        let run = Plan::new(&script, "m.alb", None, None).and_then(|plan| Run::new(&plan, seed));
        let ended = run.map(|mut run| run.to_end()).map_err(|error| format!("{error:?}"));
        assert_eq!(ended, Ok(Outcome::Completed), "seed {seed}");
    }
}

#[test]
fn more_noise_than_is_believed_is_refused() {
    for (name, noise, unit) in NOISIEST {
        assert!(!script(&clause((name, 1.01 * noise, unit))).is_sound(), "{name}");
    }
}
