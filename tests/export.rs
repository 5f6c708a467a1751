//! `albacore export`: files for other programs are well-formed, hold what the journal holds, and take the place of nothing.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test that cannot write its own files has failed")]

mod files;

use albacore_machine::Machine;
use albacore_session::journal::{Entry, Gap, Journal, Reader, Writer};
use albacore_session::{Changes, Plan};
use files::{Mcap, NetCdf, Table};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

const ALL: &str = "--csv --geojson --kml --gpx --netcdf --mcap --alog";
const FILES: [&str; 7] =
    ["track.alog", "track.csv", "track.geojson", "track.gpx", "track.kml", "track.mcap", "track.nc"];

/// A mission in a plane of its own, which logs and reports.
const PLANE: &str = r#"
mission plane in calm within 1 min {
    area op = rectangle(center: point(north: 0 m, east: 0 m), along: 0 deg, length: 400 m, width: 200 m)
    requires { position, course, heading fresh 5 s, else abort }
    recovery within 1 min { goto op.center }
    limits { speed <= 2 m/s }
    with altitude 5 m, speed 1 m/s
    steer 0 deg for 3 s
    report "where": position, leg: 2
}
"#;

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("export").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What `albacore` ends with, prints and says.
fn albacore(folder: &Path, words: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(words.split(' ')).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A folder with a run of a mission in `run`; and its result.
fn run(name: &str, mission: &str) -> (PathBuf, Value) {
    let folder = empty(name);
    let mission = Path::new(env!("CARGO_MANIFEST_DIR")).join("missions").join(mission);
    let (_, told, said) = albacore(&folder, &format!("run {} --out run --json", mission.display()));
    (folder, serde_json::from_str(&told).unwrap_or_else(|_| panic!("{said}")))
}

fn exported(folder: &Path, words: &str) {
    let (code, _, said) = albacore(folder, words);
    assert_eq!((code, said.as_str()), (Some(0), ""), "{words}");
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn read(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join("run/export").join(file)).unwrap()
}

fn bytes(folder: &Path, file: &str) -> Vec<u8> {
    std::fs::read(folder.join("run/export").join(file)).unwrap()
}

fn journal(folder: &Path) -> Journal {
    Journal::read(&std::fs::read(folder.join("run/journal")).unwrap()).unwrap()
}

#[track_caller]
fn near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-8 * a.abs().max(b.abs()).max(1.0), "{a} and {b}");
}

/// Every sample, command and truth of the journal is in the table, and nothing else.
#[test]
fn a_table_holds_what_the_journal_holds() {
    let (folder, result) = run("table", "box.alb");
    exported(&folder, "export run --csv");
    let (table, journal) = (Table::read(&read(&folder, "track.csv")), journal(&folder));
    assert_eq!(table.rows.len(), journal.ticks.len());
    assert_eq!(result["ticks"], journal.ticks.len());
    let at = |name: &str| journal.header.measurements.iter().position(|known| known.name == name).unwrap();
    let scalars = [("depth (m)", at("depth"), 1.0), ("heading (deg)", at("heading"), 180.0 / std::f64::consts::PI)];
    let scalars = scalars.into_iter().chain([("battery (%)", at("battery"), 100.0), ("speed (m/s)", at("speed"), 1.0)]);
    for (head, measurement, scale) in scalars {
        let mut count = 0;
        for (row, tick) in journal.ticks.iter().enumerate() {
            let sample = tick.snapshot.samples.iter().find(|sample| usize::from(sample.origin()) == measurement);
            count += usize::from(sample.is_some());
            match (table.number(row, head), sample) {
                (Some(cell), Some(sample)) => near(cell, scale * sample.reading[0]),
                (cell, sample) => assert_eq!((cell, sample), (None, None), "{head} at {row}"),
            }
        }
        assert!(count > 50, "{head}: {count}");
    }
    for (row, tick) in journal.ticks.iter().enumerate() {
        near(table.number(row, "time (s)").unwrap(), tick.tick as f64 / 10.0);
        let truth = tick.truth.unwrap();
        near(table.number(row, "truth.north (m)").unwrap(), truth.position.north);
        near(table.number(row, "truth.heading (deg)").unwrap(), truth.heading.degrees());
        let told = tick.command.map(|command| command.heading.degrees());
        assert_eq!(table.number(row, "commanded.heading (deg)").is_some(), told.is_some());
        told.iter().for_each(|told| near(table.number(row, "commanded.heading (deg)").unwrap(), *told));
    }
    let active: Vec<&str> = (0..table.rows.len()).map(|row| table.cell(row, "behavior")).collect();
    for chain in ["box > round > sides", "box > round > home"] {
        assert!(active.contains(&chain), "{chain}");
    }
    let report = &result["reports"][0];
    assert!(table.cell(table.rows.len() - 1, "reported").starts_with("end: (36.1"), "{report}");
}

/// Several samples of a measurement in one tick, one that was not believed, one that is doubted, and one that is no number.
#[test]
fn every_sample_of_a_tick_has_a_cell() {
    let (folder, _) = run("samples", "box.alb");
    let bytes = std::fs::read(folder.join("run/journal")).unwrap();
    let mut reader = Reader::new(&bytes).unwrap();
    let header = reader.header().clone();
    let at = |name: &str| header.measurements.iter().position(|known| known.name == name).unwrap() as u16;
    let (_, plan) = Plan::of_journal(&header, &Changes::default()).unwrap();
    let mut written = Vec::new();
    let mut writer = Writer::new(&mut written, &header).unwrap();
    for entry in reader.by_ref() {
        let Entry::Step(mut record) = entry else { panic!("a gap") };
        if record.tick == 5 && record.ending().is_none() {
            let samples = &mut record.snapshot.samples;
            samples.retain(|sample| ![at("depth"), at("altitude"), at("heading")].contains(&sample.origin()));
            record.snapshot.push(at("depth"), &[1.0]);
            record.snapshot.push(at("depth"), &[2.0]);
            record.snapshot.push(at("depth"), &[99.0]);
            record.snapshot.samples.last_mut().unwrap().withhold();
            record.snapshot.push(at("altitude"), &[7.0]);
            record.snapshot.samples.last_mut().unwrap().doubt();
            record.snapshot.push(at("heading"), &[f64::NAN]);
            (0..5).for_each(|i| record.snapshot.push(at("chemical"), &[f64::from(i) / 100.0]));
        }
        // Ten ticks that the disk did not take.
        if record.tick == 20 {
            let mut state = Machine::new(Arc::clone(&plan.program), &header.measurements).unwrap().state().clone();
            state.tick = 30;
            writer.gap(&Gap { first: 20, last: 29, state: Box::new(state) }).unwrap();
        }
        if !(20..30).contains(&record.tick) {
            writer.step(&record).unwrap();
        }
    }
    std::fs::create_dir(folder.join("made")).unwrap();
    std::fs::write(folder.join("made/journal"), written).unwrap();
    let (code, _, said) = albacore(&folder, &format!("export made {ALL}"));
    assert!(code == Some(0) && said.contains("samples are in no column"), "{said}");
    let table = Table::read(&std::fs::read_to_string(folder.join("made/export/track.csv")).unwrap());
    let cell = |head: &str| table.number(5, head);
    assert_eq!(
        (cell("depth (m)"), cell("depth.before (m)"), cell("depth.withheld (m)")),
        (Some(2.0), Some(1.0), Some(99.0))
    );
    assert_eq!((cell("altitude (m)"), cell("altitude.doubted"), cell("heading (deg)")), (Some(7.0), Some(1.0), None));
    let earlier = ["chemical (%)", "chemical.before (%)", "chemical.before_2 (%)", "chemical.before_3 (%)"].map(cell);
    assert_eq!(earlier, [Some(4.0), Some(3.0), Some(2.0), Some(1.0)]);
    assert_eq!((table.number(6, "depth.before (m)"), table.number(19, "time (s)")), (None, Some(1.9)));
    assert_eq!(table.number(20, "time (s)"), Some(3.0));
    let log = std::fs::read_to_string(folder.join("made/export/track.alog")).unwrap();
    assert!(log.contains("missing 10 ticks before this are not in the journal"));
    // No number that is none comes into JSON, whatever the instruments say.
    let file = Mcap::read(&std::fs::read(folder.join("made/export/track.mcap")).unwrap());
    assert!(file.of("/state")[5]["heading"].is_null() && file.of("/state")[5]["depth_withheld"] == 99);
}

#[test]
fn netcdf_holds_what_the_table_holds() {
    let (folder, _) = run("netcdf", "box.alb");
    exported(&folder, "export run --csv --netcdf");
    let (table, bytes) = (Table::read(&read(&folder, "track.csv")), bytes(&folder, "track.nc"));
    let file = NetCdf::read(&bytes);
    assert_eq!(file.dimension("time"), table.rows.len());
    assert_eq!(file.text("", "featureType"), "trajectory");
    assert_eq!(file.text("trajectory", "cf_role"), "trajectory_id");
    let units = file.text("time", "units");
    assert!(units.starts_with("seconds since 20") && units.ends_with('Z'), "{units}");
    let pairs = [
        ("time", "time (s)"),
        ("depth", "depth (m)"),
        ("north", "north (m)"),
        ("flow_east", "flow.east (m/s)"),
        ("battery", "battery (%)"),
        ("commanded_speed", "commanded.speed (m/s)"),
        ("truth_altitude", "truth.altitude (m)"),
    ];
    for (name, head) in pairs {
        let values = file.numbers(name);
        assert_eq!(values.len(), table.rows.len(), "{name}");
        for (row, value) in values.into_iter().enumerate() {
            match table.number(row, head) {
                Some(cell) => near(cell, value),
                None => assert!(value > 9e36, "{name}: {value}"),
            }
        }
    }
    // Where the vehicle is believed to be is held where no sample came.
    assert!(file.numbers("lat").into_iter().all(|latitude| (latitude - 36.18).abs() < 0.01));
    let active = file.texts("behavior");
    assert!((0..table.rows.len()).all(|row| active[row] == table.cell(row, "behavior")));
    assert_eq!((file.texts("report_name"), file.dimension("report")), (vec!["end".to_string()], 1));
}

#[test]
fn mcap_holds_a_state_for_each_tick_and_its_checks_fit() {
    let (folder, _) = run("mcap", "box.alb");
    exported(&folder, "export run --csv --mcap");
    let (table, bytes) = (Table::read(&read(&folder, "track.csv")), bytes(&folder, "track.mcap"));
    let file = Mcap::read(&bytes);
    assert_eq!(file.schemas, ["foxglove.LocationFix", "foxglove.Log", "albacore.State", "albacore.Report"]);
    let states = file.of("/state");
    assert_eq!(states.len(), table.rows.len());
    for (row, state) in states.iter().enumerate() {
        assert_eq!(state["depth"].as_f64(), table.number(row, "depth (m)"));
        assert_eq!(state["behavior"].as_str().unwrap_or_default(), table.cell(row, "behavior"));
    }
    assert_eq!(file.of("/position").len(), table.rows.len());
    assert!(file.of("/log").iter().any(|event| event["message"].as_str().unwrap().starts_with("switch")));
    assert_eq!(file.of("/reports")[0]["name"], "end");
    let counted: u64 =
        ["/state", "/position", "/truth", "/log", "/reports"].map(|topic| file.of(topic).len() as u64).iter().sum();
    assert_eq!(file.messages, counted);
}

#[test]
fn a_log_for_moos_is_in_the_order_of_time() {
    let (folder, _) = run("alog", "box.alb");
    exported(&folder, "export run --csv --alog");
    let (table, log) = (Table::read(&read(&folder, "track.csv")), read(&folder, "track.alog"));
    let lines: Vec<Vec<&str>> =
        log.lines().filter(|line| !line.starts_with("%%")).map(|line| line.split_whitespace().collect()).collect();
    let times: Vec<f64> = lines.iter().map(|line| line[0].parse().unwrap()).collect();
    assert!(times.is_sorted() && log.starts_with("%%"));
    for (name, head) in [("NAV_X", "east (m)"), ("NAV_DEPTH", "depth (m)"), ("DESIRED_SPEED", "commanded.speed (m/s)")]
    {
        let told: Vec<&str> = lines.iter().filter(|line| line[1] == name).map(|line| line[3]).collect();
        let cells: Vec<&str> =
            (0..table.rows.len()).map(|row| table.cell(row, head)).filter(|cell| !cell.is_empty()).collect();
        assert_eq!(told, cells, "{name}");
    }
    assert_eq!(lines.iter().filter(|line| line[1] == "REPORT").count(), 1);
}

/// An area that was reported is a polygon with what was reported beside it, and not to be taken for what is so.
#[test]
fn reported_areas_and_true_outlines_are_polygons() {
    let (folder, result) = run("areas", "../tests/report/spills.alb");
    exported(&folder, &format!("export run {ALL}"));
    let map: Value = serde_json::from_str(&read(&folder, "track.geojson")).unwrap();
    let polygons = map["features"].as_array().unwrap().iter().filter(|one| one["geometry"]["type"] == "Polygon");
    let polygons: Vec<&Value> = polygons.collect();
    let of = |name: &'static str| move |one: &&&Value| one["properties"]["name"] == name;
    let told: Vec<String> = polygons
        .iter()
        .map(|one| format!("{} {}", one["properties"]["kind"], one["properties"]["name"]).replace('"', ""))
        .collect();
    let truth = ["oil", "dye", "slick"].map(|name| format!("true outline true outline of {name}"));
    let reported = ["dye", "guess.outline"].map(|name| format!("reported area {name}"));
    assert_eq!(told, [&["area op".to_string()][..], &truth, &reported].concat());
    let dye = polygons.iter().find(of("dye")).unwrap();
    let (ring, report) = (dye["geometry"]["coordinates"][0].as_array().unwrap(), &result["reports"][0]);
    let corners = report["value"]["corners"].as_array().unwrap();
    assert!(ring.len() == corners.len() + 1 && ring[0] == ring[corners.len()]);
    for corner in corners {
        let near = |at: &Value, degrees: &Value| (at.as_f64().unwrap() - degrees.as_f64().unwrap()).abs() < 1e-7;
        let is_here = |at: &&Value| near(&at[0], &corner["longitude_deg"]) && near(&at[1], &corner["latitude_deg"]);
        assert!(ring.iter().any(|at| is_here(&at)), "{corner}");
    }
    let properties = &dye["properties"];
    assert_eq!((&properties["reported"], &properties["time_s"]), (&"dye".into(), &report["t_s"]));
    assert_eq!(
        (&properties["report"]["depth"], &properties["report"]["error_m"]),
        (&report["labelled"]["depth"], &report["error_m"])
    );
    let kml = read(&folder, "track.kml");
    let kml = roxmltree::Document::parse(&kml).unwrap();
    let count = |name: &str| kml.descendants().filter(|node| node.tag_name().name() == name).count();
    assert_eq!((count("Polygon"), count("Point")), (6, 0));
    let told = kml.descendants().filter(|node| node.tag_name().name() == "description");
    assert_eq!(told.filter(|node| node.text().is_some_and(|text| text.contains("depth = 3.0 m"))).count(), 2);
    assert_eq!(read(&folder, "track.gpx").matches("<rte>").count(), 3, "what is so is no way to go");
    let bytes = bytes(&folder, "track.nc");
    let file = NetCdf::read(&bytes);
    assert_eq!(
        (file.texts("area_name"), file.numbers("area_report")),
        (vec!["dye".into(), "guess.outline".into()], vec![0.0; 2])
    );
    assert_eq!((file.numbers("area_corners"), file.dimension("corner")), (vec![4.0; 2], 8));
    near(file.numbers("corner_lat")[0], corners[0]["latitude_deg"].as_f64().unwrap());
    let last = Table::read(&read(&folder, "track.csv"));
    assert!(last.cell(last.rows.len() - 1, "reported").starts_with("dye: area of 4 corners, depth = 3.0 m"));
}

#[test]
fn maps_hold_track_area_and_reports() {
    let (folder, result) = run("maps", "duck_single.alb");
    exported(&folder, &format!("export run {ALL}"));
    assert_eq!(names(&folder.join("run/export")), FILES);
    let reports = result["reports"].as_array().unwrap();
    let placed: Vec<&Value> = reports.iter().filter(|report| report["latitude_deg"].is_number()).collect();
    assert!(!placed.is_empty());
    let map: Value = serde_json::from_str(&read(&folder, "track.geojson")).unwrap();
    let features = map["features"].as_array().unwrap();
    let of = |kind: &str| features.iter().filter(|feature| feature["properties"]["kind"] == kind).collect::<Vec<_>>();
    assert_eq!((of("track").len(), of("area").len(), of("report").len()), (2, 1, placed.len()));
    for (feature, report) in of("report").into_iter().zip(&placed) {
        assert_eq!(feature["properties"]["name"], report["name"]);
        let at = &feature["geometry"]["coordinates"];
        assert!((at[0].as_f64().unwrap() - report["longitude_deg"].as_f64().unwrap()).abs() < 1e-7);
        assert!((at[1].as_f64().unwrap() - report["latitude_deg"].as_f64().unwrap()).abs() < 1e-7);
        assert_eq!(feature["properties"]["report"]["value"], report["value"]);
    }
    let points = of("track")[0]["geometry"]["coordinates"].as_array().unwrap().len();
    assert_eq!(points, of("track")[0]["properties"]["times"].as_array().unwrap().len());
    let (kml, gpx) = (read(&folder, "track.kml"), read(&folder, "track.gpx"));
    let (kml, gpx) = (roxmltree::Document::parse(&kml).unwrap(), roxmltree::Document::parse(&gpx).unwrap());
    let count = |tree: &roxmltree::Document, name: &str| {
        tree.descendants().filter(|node| node.tag_name().name() == name).count()
    };
    assert_eq!((count(&kml, "Polygon"), count(&kml, "Point"), count(&kml, "Track")), (1, placed.len(), 2));
    assert!(count(&kml, "when") == count(&kml, "coord") + placed.len() && count(&kml, "coord") == 2 * points);
    assert_eq!((count(&gpx, "wpt"), count(&gpx, "rte"), count(&gpx, "trk")), (placed.len(), 1, 2));
    assert_eq!((count(&gpx, "trkpt"), count(&gpx, "time")), (2 * points, 2 * points + placed.len() + 1));
    let table = Table::read(&read(&folder, "track.csv"));
    let told: usize = table.rows.iter().map(|row| usize::from(!row.last().unwrap().is_empty())).sum();
    assert!((1..=reports.len()).contains(&told), "{told}");
}

#[test]
fn the_same_run_gives_the_same_bytes_and_a_bare_journal_a_folder_beside_it() {
    let (folder, _) = run("again", "box.alb");
    exported(&folder, &format!("export run {ALL}"));
    exported(&folder, &format!("export run {ALL} --out other/folder"));
    let all = |from: &Path| FILES.map(|file| std::fs::read(from.join(file)).unwrap());
    assert!(all(&folder.join("run/export")) == all(&folder.join("other/folder")));
    // Without its record nobody knows when it was; all else is the same.
    std::fs::create_dir(folder.join("bare")).unwrap();
    std::fs::copy(folder.join("run/journal"), folder.join("bare/journal")).unwrap();
    let (code, _, said) = albacore(&folder, &format!("export bare/journal {ALL}"));
    assert!(code == Some(0) && said.contains("its first tick is told as 1970-01-01T00:00:00Z"), "{said}");
    assert_eq!(names(&folder.join("bare")), ["export", "journal"]);
    let bare = |file: &str| std::fs::read(folder.join("bare/export").join(file)).unwrap();
    assert!(bare("track.csv") == bytes(&folder, "track.csv"));
    let file = bare("track.nc");
    let file = NetCdf::read(&file);
    assert_eq!(file.text("time", "units"), "seconds since 1970-01-01T00:00:00.000Z");
    assert!(file.text("", "remark").contains("is not known"));
}

#[test]
fn what_is_whole_of_a_journal_that_is_cut_short_is_exported() {
    let (folder, _) = run("cut", "box.alb");
    exported(&folder, &format!("export run {ALL}"));
    let (whole, journal) = (read(&folder, "track.csv"), std::fs::read(folder.join("run/journal")).unwrap());
    let cut = journal.len() / 2;
    std::fs::write(folder.join("cut"), &journal[..cut]).unwrap();
    let (code, told, said) = albacore(&folder, &format!("export cut {ALL} --out cut_short"));
    assert_eq!((code, told.lines().count()), (Some(0), FILES.len()), "{said}");
    let at = said.split("the journal is cut short at byte ").nth(1).and_then(|rest| rest.split(':').next()).unwrap();
    assert!(at.parse::<usize>().is_ok_and(|at| at <= cut), "{said}");
    let table = std::fs::read_to_string(folder.join("cut_short/track.csv")).unwrap();
    let rows = table.lines().count();
    assert!(rows > 1000 && whole.lines().zip(table.lines()).all(|(whole, cut)| whole == cut), "{rows}");
    assert!(said.contains(&format!("what is whole before that: {} ticks", rows - 1)), "{said}");
    let mut damaged = journal;
    damaged[cut] ^= 0xff;
    std::fs::write(folder.join("damaged"), damaged).unwrap();
    let (code, _, said) = albacore(&folder, "export damaged --csv --out damaged_too");
    assert!(code == Some(0) && said.contains("the journal is damaged at byte "), "{said}");
}

#[test]
fn a_mission_in_a_plane_of_its_own_has_tables_and_no_maps() {
    let folder = empty("plane");
    std::fs::write(folder.join("plane.alb"), PLANE).unwrap();
    let (code, _, said) = albacore(&folder, "run plane.alb --out run");
    assert_eq!(code, Some(0), "{said}");
    let (code, _, said) = albacore(&folder, &format!("export run {ALL}"));
    assert!(
        code == Some(2) && said.contains("has no place on the globe, which `--geojson`, `--kml`, `--gpx` must have"),
        "{said}"
    );
    assert!(!folder.join("run/export").exists());
    exported(&folder, "export run --csv --netcdf --mcap --alog");
    let table = Table::read(&read(&folder, "track.csv"));
    assert!(!table.head.iter().any(|head| head.contains("latitude")), "{:?}", table.head);
    assert!(table.number(5, "commanded.altitude (m)").is_some_and(|altitude| altitude == 5.0));
    assert!(table.cell(table.rows.len() - 1, "reported").contains(" m), leg = 2"), "{:?}", table.rows.last());
    let file = bytes(&folder, "track.nc");
    assert_eq!(NetCdf::read(&file).text("x", "standard_name"), "projection_x_coordinate");
    assert!(Mcap::read(&bytes(&folder, "track.mcap")).of("/position").is_empty());
}

#[test]
fn what_cannot_be_exported_is_said_with_a_fix() {
    let (folder, _) = run("refused", "box.alb");
    let refused = |words: &str, code: i32, told: &[&str]| {
        let (ended, printed, said) = albacore(&folder, words);
        assert_eq!((ended, printed.as_str()), (Some(code), ""), "{words}: {said}");
        assert!(told.iter().all(|told| said.contains(told)), "{words}: {said}");
    };
    refused(
        "export run",
        2,
        &["no format is chosen", "`--csv`, `--geojson`, `--kml`, `--gpx`, `--netcdf`, `--mcap`, `--alog`"],
    );
    refused("export . --csv", 2, &["holds no run", "did you mean"]);
    refused("export nothing --csv", 2, &["cannot be read", "name the folder of a run"]);
    refused("export run/run.json --csv", 4, &["this is no journal"]);
    refused("export run --xlsx", 2, &["unexpected argument '--xlsx'"]);
    exported(&folder, "export run --csv");
    std::fs::write(folder.join("run/export/track.csv"), "mine").unwrap();
    refused("export run --csv --kml", 2, &["track.csv` is there already", "`--replace`", "`--out`"]);
    assert!(read(&folder, "track.csv") == "mine" && !folder.join("run/export/track.kml").exists());
    exported(&folder, "export run --csv --replace");
    assert!(read(&folder, "track.csv").starts_with("time (s),"));
    refused("export run --csv --out run/journal", 4, &["cannot be written"]);
    // A folder in the place of a file is no file, and stays.
    std::fs::create_dir_all(folder.join("there/track.csv")).unwrap();
    refused("export run --csv --out there --replace", 4, &["there/track.csv` cannot be written"]);
}

/// What the disk does not take leaves neither a part of a file nor an empty folder.
#[test]
#[cfg(unix)]
fn a_disk_that_is_full_is_said_and_leaves_nothing() {
    let (folder, _) = run("full", "box.alb");
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.args(["export", "run", "--csv", "--mcap"]).current_dir(&folder);
    let output = crate::shell::behind("ulimit -f 100", &command).stdin(Stdio::null()).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(4) && said.contains("track.csv` cannot be written: "), "{said}");
    assert!(!folder.join("run/export").exists(), "{said}");
}
