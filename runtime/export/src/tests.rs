//! A run made up of what formats must take care of: absent numbers, texts of every kind, and nothing at all.

use crate::exported::{About, Column, Exported, Happened, Outline, Place, Reported, Role, Track, Values};
use crate::{FORMATS, no_formula};
use serde_json::{Value, json};

const EVIL: &str = "=1+1 \"<a>\" & ]]> é, 'x'";

fn place(north: f64, depth: f64) -> Place {
    Place { north, east: 10.0, latitude: 36.0 + north / 1e5, longitude: -75.5, depth }
}

fn column(name: &str, unit: &'static str, role: Option<Role>, values: Values) -> Column {
    Column { name: name.into(), unit, meaning: EVIL.into(), role, standard_name: None, values }
}

fn triangle(name: &str) -> Outline {
    let corners = vec![place(0.0, f64::NAN), place(9.0, f64::NAN), Place { east: 50.0, ..place(4.0, f64::NAN) }];
    Outline { name: name.into(), corners }
}

fn run() -> Exported {
    let numbers = |numbers: [f64; 3]| Values::Numbers(numbers.to_vec());
    Exported {
        about: About {
            version: "1".into(),
            mission: EVIL.into(),
            scenario: EVIL.into(),
            epoch_ms: Some(1_786_683_600_250),
            is_on_globe: true,
            ..About::default()
        },
        ticks: vec![0, 1, 5],
        columns: vec![
            column("depth", "m", Some(Role::Depth), numbers([1.5, f64::NAN, f64::INFINITY])),
            column("flow.north", "m/s", None, numbers([-0.25, 1e-9, 1e300])),
            column("flow_north", "m/s", None, numbers([f64::NAN; 3])),
            column("2 odd/names", "", None, numbers([0.0, -0.0, 7.0])),
            column("utc", "", None, Values::Dates(vec![1.8e9, f64::NAN, 1.8e9])),
            column("time", "", Some(Role::Behavior), Values::Texts(vec![EVIL.into()], vec![0, u32::MAX, 0])),
        ],
        believed: Track(vec![place(0.0, 1.0), Place::UNKNOWN, place(2.0, f64::NAN)]),
        truth: Some(Track(vec![place(0.0, 1.0), place(1.0, 1.0), place(2.0, 1.0)])),
        outlines: vec![triangle(EVIL)],
        true_outlines: vec![triangle(EVIL)],
        reports: vec![Reported {
            tick: 1,
            name: EVIL.into(),
            told: EVIL.into(),
            place: Some(place(3.0, f64::NAN)),
            areas: vec![triangle("found"), Outline { name: "nowhere".into(), corners: vec![Place::UNKNOWN; 4] }],
            value: json!({ "value": EVIL, "found": { "corners": [1, 2, 3], "surface_m2": 7 } }),
        }],
        events: vec![
            Happened { tick: 0, verb: "log".into(), text: EVIL.into() },
            Happened { tick: 9, verb: "abort".into(), text: EVIL.into() },
        ],
    }
}

fn text(file: &str, run: &Exported) -> String {
    let format = FORMATS.iter().find(|format| format.file == file).unwrap();
    String::from_utf8((format.make)(run)).unwrap()
}

#[test]
fn each_format_has_a_name_and_a_file_of_its_own() {
    for (at, format) in FORMATS.iter().enumerate() {
        assert!(FORMATS[..at].iter().all(|other| other.name != format.name && other.file != format.file));
    }
}

#[test]
fn whatever_texts_and_numbers_there_are_files_are_well_formed() {
    for run in [run(), Exported::default()] {
        for format in &FORMATS {
            assert_eq!((format.make)(&run), (format.make)(&run), "{}", format.name);
        }
        let map: Value = serde_json::from_str(&text("track.geojson", &run)).unwrap();
        assert_eq!(map["type"], "FeatureCollection");
        for file in ["track.kml", "track.gpx"] {
            roxmltree::Document::parse(&text(file, &run)).unwrap();
        }
        let log = text("track.alog", &run);
        assert!(log.lines().all(|line| line.starts_with("%%") || line.split_whitespace().count() >= 4), "{log}");
        let table = text("track.csv", &run);
        assert_eq!(table.lines().count(), run.ticks.len() + 1);
    }
}

#[test]
fn a_table_has_nothing_where_nothing_came() {
    let table = text("track.csv", &run());
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "time (s),depth (m),flow.north (m/s),flow_north (m/s),2 odd/names,utc,time,reported");
    let evil = "\"'=1+1 \"\"<a>\"\" & ]]> é, 'x'\"";
    assert_eq!(rows[1], format!("0.0,1.5,-0.25,,0,2027-01-15T08:00:00.0Z,{evil},"));
    assert!(rows[2].starts_with("0.1,,1e-9,,0,,,\"'=1+1"), "{}", rows[2]);
    assert_eq!(rows[3], format!("0.5,,1e300,,7,2027-01-15T08:00:00.0Z,{evil},"));
}

#[test]
fn maps_go_round_against_the_clock_and_tell_heights() {
    let map: Value = serde_json::from_str(&text("track.geojson", &run())).unwrap();
    let features = map["features"].as_array().unwrap();
    let kinds: Vec<&Value> = features.iter().map(|feature| &feature["properties"]["kind"]).collect();
    assert_eq!(kinds, ["track", "track", "area", "true outline", "report", "reported area"]);
    // The second tick is no whole second, and the last is not known to be anywhere deep.
    assert_eq!(features[0]["geometry"]["coordinates"], json!([[-75.5, 36, -1], [-75.5, 36.00002]]));
    assert_eq!(features[0]["properties"]["times"], json!(["2026-08-14T05:00:00.250Z", "2026-08-14T05:00:00.750Z"]));
    let ring = features[2]["geometry"]["coordinates"][0].as_array().unwrap();
    assert!(ring.len() == 4 && ring[0] == ring[3]);
    assert_eq!(features[3]["properties"]["name"], format!("true outline of {EVIL}"));
    assert_eq!(features[4]["properties"]["report"]["value"], EVIL);
    assert_eq!(
        (&features[5]["geometry"], &features[5]["properties"]["name"]),
        (&features[2]["geometry"], &json!("found"))
    );
    assert_eq!(
        features[5]["properties"]["report"]["found"],
        json!({ "surface_m2": 7 }),
        "its corners are its geometry"
    );
}

/// Those that lie nowhere on the globe are in no map.
#[test]
fn what_was_reported_and_what_is_so_are_polygons_apart() {
    let map = text("track.kml", &run());
    let tree = roxmltree::Document::parse(&map).unwrap();
    let placemarks = tree.descendants().filter(|node| node.tag_name().name() == "Placemark");
    let child = |node: roxmltree::Node, name: &str| {
        node.children().find(|child| child.tag_name().name() == name).and_then(|child| child.text()).map(str::to_string)
    };
    let polygons = placemarks.filter(|node| node.children().any(|child| child.tag_name().name() == "Polygon"));
    let told: Vec<_> = polygons.map(|node| (child(node, "styleUrl"), child(node, "name"))).collect();
    let expected = [
        ("#area", EVIL.into()),
        ("#true_outline", format!("true outline of {EVIL}")),
        ("#reported_area", "found".into()),
    ];
    assert_eq!(told, expected.map(|(style, name)| (Some(style.to_string()), Some(name))));
    assert_eq!(text("track.gpx", &run()).matches("<rte>").count(), 2);
}

/// A name that two columns would have is given once.
#[test]
fn names_in_programs_are_of_one_column_each() {
    let names = run().names_in_programs(&["time"]);
    assert_eq!(names, ["depth", "flow_north", "flow_north_2", "x_2_odd_names", "utc", "time_2"]);
}

#[test]
fn a_log_tells_what_changed() {
    let log = text("track.alog", &run());
    let of = |name: &str| log.lines().filter(|line| line.split_whitespace().nth(1) == Some(name)).count();
    assert_eq!([of("NAV_DEPTH"), of("FLOW_NORTH"), of("MODE"), of("REPORT"), of("EVENT")], [1, 3, 1, 1, 2]);
    assert!(log.contains("%% LOGSTART           1786683600.250\n"), "{log}");
    assert!(log.contains("VIEW_POINT               albacore     x=10,y=3,label="), "{log}");
}

#[test]
fn no_cell_is_a_formula() {
    for (cell, held) in [("=1", "'=1"), ("-1", "-1"), ("1;=2", "1;'=2"), (" @x", "' @x"), ("a", "a")] {
        assert_eq!(no_formula(cell), held);
    }
}
