use super::{Page, page};
use crate::source::Source;

const SCRIPT: &str = "\
//! A page.
//!
//! More of it.
use search

/// Where.
record Place { at: Point }

/// Goes there
/// and back.
strategy tour(
    to: Point,                          // far away
    speed: Speed = 1 m/s in 0.5 m/s..2 m/s, times: Int = 1,     // of two
    /// How long.
    rest: Duration = 1 min,
) -> Place? {
    signal near = distance(to, position) < 5 m
    /// On the way.
    behavior go { goto to }
    behavior back_home {                // to where it began
        steer 0 deg
    }
    start go
    go -> back_home on done and
        near
    back_home -> finish none on after 1 min
}

/// Of nothing.

const far = 1 km /// behind
//! late
test \"it\" {}
/// At the end.
";

fn told(text: &str) -> Page {
    page(&Source { name: "page.alb".into(), text: text.into() }).unwrap()
}

#[test]
fn comments_belong_to_what_stands_below_them() {
    let page = told(SCRIPT);
    assert_eq!(page.text, "A page.\n\nMore of it.");
    let texts: Vec<(&str, &str)> = page.declarations.iter().map(|d| (d.name.as_str(), d.text.as_str())).collect();
    assert_eq!(texts, [("Place", "Where."), ("tour", "Goes there\nand back."), ("far", "")]);
    assert_eq!(page.tests, ["it"]);
    let stray: Vec<&str> = page.stray.iter().map(|s| &SCRIPT[s.start as usize..s.end as usize]).collect();
    assert_eq!(stray, ["/// Of nothing.", "/// behind", "//! late", "/// At the end."]);
}

#[test]
fn parameters_behaviors_and_tables_are_as_written() {
    let page = told(SCRIPT);
    let tour = &page.declarations[1];
    let params: Vec<[&str; 5]> = tour
        .params
        .iter()
        .map(|p| [&*p.name, &*p.ty, p.default.as_deref().unwrap_or(""), p.range.as_deref().unwrap_or(""), &*p.text])
        .collect();
    assert_eq!(
        params,
        [
            ["to", "Point", "", "", "far away"],
            ["speed", "Speed", "1 m/s", "0.5 m/s..2 m/s", ""],
            ["times", "Int", "1", "", ""],
            ["rest", "Duration", "1 min", "", "How long."],
        ]
    );
    let behaviors: Vec<(&str, &str)> = tour.behaviors.iter().map(|b| (b.name.as_str(), b.text.as_str())).collect();
    assert_eq!(behaviors, [("go", "On the way."), ("back_home", "to where it began")]);
    assert_eq!(tour.result.as_deref(), Some("Place?"));
    assert!(tour.written.starts_with("strategy tour(\n    to: Point,"), "{}", tour.written);
    assert!(tour.written.ends_with(") -> Place?"), "{}", tour.written);
    let table = "signal near = distance(to, position) < 5 m\n\nstart go\ngo -> back_home on done and\n    near\n\
                 back_home -> finish none on after 1 min";
    assert_eq!(tour.table.as_deref(), Some(table));
}

#[test]
fn a_script_with_mistakes_has_no_page() {
    assert_eq!(page(&Source { name: "page.alb".into(), text: "mission {".into() }), None);
    assert_eq!(told("").declarations, []);
}
