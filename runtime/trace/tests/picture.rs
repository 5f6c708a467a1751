//! The picture of a run.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that fails may panic")]

use albacore_geometry::{Area, Grid, Heading, Point, Vector};
use albacore_trace::{Cells, Depths, Digest, Picture, Profile, Sounding, TrueOutline};

fn full() -> Picture {
    let area = Area::rectangle(Point::ORIGIN, Heading::from_degrees(320.0), 1094.0, 367.0);
    let around = |i: u32| Point::new(f64::from(i % 997) - 500.0, f64::from(i % 613) - 300.0);
    Picture {
        title: "a <mission> & \"its\" 'end'".into(),
        subtitle: vec!["control \u{1} character".into()],
        area: area.corners().to_vec(),
        plume: (0..50_000).map(|i| (around(i), 1.0)).collect(),
        // The worst of tracks: every point far from the last, a switch every 40 ticks.
        track: (0..100_000).map(|i| (around(i * 331), (i / 40 % 11) as u16)).collect(),
        behaviors: (0..11).map(|i| format!("b{i}")).collect(),
        detections: (0..30_000).map(around).collect(),
        reports: vec![("declared".into(), Point::new(13.0, 2.0))],
        sources: vec![("dye".into(), Point::ORIGIN)],
        start: Some(Point::new(-300.0, 200.0)),
        flows: vec![("flow".into(), Vector::new(-0.0957, 0.0803))],
        ..Picture::default()
    }
}

/// Every tag is closed, in order, and nothing is there that a browser would load.
#[track_caller]
fn check(svg: &str) {
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains('?'), "a coordinate is no number");
    assert!(!svg.contains("href") && !svg.contains("url(http"));
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        match tag {
            tag if tag.starts_with('/') => assert_eq!(open.pop(), Some(name)),
            tag if tag.ends_with('/') => {}
            _ => open.push(name),
        }
    }
    assert!(open.is_empty());
}

#[test]
fn the_picture_of_a_long_run_is_small_and_always_the_same() {
    let svg = full().svg();
    check(&svg);
    assert!(svg.len() < 500_000, "{} bytes", svg.len());
    assert_eq!(svg, full().svg());
    assert!(svg.contains("a &lt;mission&gt; &amp; &quot;its&quot; &#39;end&#39;"));
    assert!(svg.contains("flow 12.5 cm/s") && svg.contains("toward 140°"));
    assert!(svg.contains(">200 m<"), "a round scale bar");
    let mut digest = Digest::new();
    digest.text(&svg);
    assert_eq!(digest.to_string(), "fbb37cff0c79e398", "the picture's bytes have changed: look at it, then accept");
}

#[test]
fn little_or_nothing_to_show_is_still_a_picture() {
    check(&Picture::default().svg());
    let here = Point::new(3.0, 4.0);
    check(&Picture { track: vec![(here, 0)], ..Picture::default() }.svg());
    check(&Picture { start: Some(here), behaviors: vec!["hold".into()], ..Picture::default() }.svg());
}

#[test]
fn what_is_not_finite_is_left_out() {
    let bad = [f64::NAN, f64::INFINITY, -1e300].map(|x| Point::new(x, 0.0));
    let mut picture = full();
    let clean = picture.svg();
    for p in bad {
        picture.plume.push((p, 1.0));
        picture.track.push((p, 0));
        picture.detections.push(p);
        picture.reports.push(("bad".into(), p));
        picture.sources.push(("bad".into(), p));
        picture.area.push(p);
    }
    let svg = picture.svg();
    check(&svg);
    assert!(!svg.contains("bad"));
    assert_eq!(svg.len(), clean.len());
    check(
        &Picture {
            start: Some(bad[0]),
            flows: vec![("flow".into(), Vector::new(f64::NAN, 0.0))],
            ..Picture::default()
        }
        .svg(),
    );
    check(&Picture { plume: vec![(Point::ORIGIN, f64::NAN)], ..Picture::default() }.svg());
}

#[test]
fn great_and_small_extents_have_round_scales() {
    for span in [1e-6, 0.3, 7.0, 200.0, 1_094.0, 33_333.0, 1e6, 1e8] {
        let corners = [(0.0, 0.0), (span, 0.0), (span, span / 3.0), (0.0, span / 3.0)];
        let area = corners.map(|(n, e)| Point::new(n - span / 2.0, e)).to_vec();
        let svg = Picture { area, ..Picture::default() }.svg();
        check(&svg);
        let bar = svg
            .lines()
            .filter_map(|line| line.strip_suffix(" m</text>").or(line.strip_suffix(" km</text>")))
            .next_back();
        let bar = bar.and_then(|line| line.rsplit_once('>')).unwrap().1;
        assert!(["1", "2", "5"].contains(&bar.trim_end_matches('0')), "a bar of {bar}");
    }
}

#[test]
fn a_straight_stretch_needs_two_points_only() {
    let track = (0..10_000).map(|i| (Point::new(f64::from(i) * 0.2, f64::from(i) * 0.1), 0)).collect();
    let svg = Picture { track, behaviors: vec!["go".into()], ..Picture::default() }.svg();
    let run = svg.lines().find(|line| line.contains("stroke=\"#0072b2\"")).unwrap();
    assert!(run.len() < 80, "{run}");
}

#[test]
fn only_behaviors_that_were_active_are_in_the_legend() {
    let mut picture = full();
    picture.track.retain(|(_, behavior)| *behavior != 5);
    let svg = picture.svg();
    assert!(svg.contains(">b4<") && !svg.contains(">b5<"));
}

#[test]
fn a_searched_bottom_is_drawn_as_lines_of_equal_depth() {
    let pit = |p: Point| 4.0 + 2.0 / (1.0 + p.distance(Point::new(20.0, -30.0)) / 40.0);
    let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 320.0, 220.0);
    let depths = Depths::sound(area.corners(), pit);
    let deepest = Some(Point::new(20.0, -30.0));
    let svg = Picture { area: area.corners().to_vec(), depths, deepest, ..Picture::default() }.svg();
    check(&svg);
    assert!(svg.contains("depth, every 0.2 m") && svg.contains("truly deepest"));
    assert!(svg.matches("stroke-opacity").count() > 6 && svg.len() < 100_000, "{} bytes", svg.len());
}

#[test]
fn places_where_the_vehicle_must_not_be_are_drawn_and_named() {
    let zone = |north| vec![Point::new(north, 0.0), Point::new(north + 50.0, 0.0), Point::new(north, 50.0)];
    let no_go = vec![("wreck".into(), zone(0.0)), ("far away".into(), zone(1e5))];
    let without = full().svg();
    let svg = Picture { no_go, ..full() }.svg();
    check(&svg);
    let outlines = |svg: &str| svg.matches("stroke=\"#b3001b\"").count();
    assert_eq!((outlines(&without), outlines(&svg)), (0, 3), "two zones, and the legend");
    assert!(svg.contains(">wreck</text>") && svg.contains(">no-go zone</text>") && !svg.contains(">far away</text>"));
}

#[test]
fn each_layer_has_its_arrow_and_its_name() {
    let (below, above) = (Vector::new(-0.0957, 0.0803), Vector::new(0.225, 0.0));
    let flows = vec![("lower layer:".into(), below), ("above 3.2 m:".into(), above)];
    let svg = Picture { flows, ..full() }.svg();
    check(&svg);
    let places =
        ["lower layer: 12.5 cm/s", "toward 140°", "above 3.2 m: 22.5 cm/s", "toward 0°"].map(|text| svg.find(text));
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
}

#[test]
fn a_source_that_is_a_line_is_drawn_from_end_to_end_and_named_once() {
    let sources = vec![("pipe".into(), Point::ORIGIN)];
    let leaks = vec![[Point::ORIGIN, Point::new(900.0, 0.0)], [Point::ORIGIN, Point::new(f64::NAN, 0.0)]];
    let svg = Picture { sources, leaks, ..Picture::default() }.svg();
    check(&svg);
    let strokes = |svg: &str| svg.matches("stroke=\"#7a0019\" stroke-width=\"5\"").count();
    assert_eq!((strokes(&svg), svg.matches(">pipe</text>").count()), (2, 1), "the line, and the legend");
    assert!(svg.contains(">leak</text>") && svg.contains(">800</text>"), "its far end is on the chart");
    assert_eq!(strokes(&full().svg()), 0);
}

#[test]
fn water_that_is_to_be_seen_is_on_the_chart() {
    let water = vec![Point::new(-400.0, 0.0), Point::new(400.0, 0.0)];
    let svg = Picture { water, start: Some(Point::ORIGIN), ..Picture::default() }.svg();
    check(&svg);
    assert!(svg.contains(">-400</text>") && svg.contains(">400</text>"));
}

#[test]
fn rounds_of_a_survey_are_named_once_at_a_place_and_turns_of_a_maneuver_are_not() {
    let marked = |rounds: &[(&str, f64, f64)]| {
        let rounds = rounds.iter().map(|(name, north, east)| (name.to_string(), Point::new(*north, *east))).collect();
        let svg = Picture { rounds, ..full() }.svg();
        let names = [">row 1<", ">row 2<", ">round of a loop begins<"];
        names.map(|name| svg.matches(name).count())
    };
    // The same survey twice, from end to end of the area.
    let survey = [("row 1", -150.0, -150.0), ("row 2", 150.0, 150.0)];
    assert_eq!(marked(&[survey, survey].concat()), [1, 1, 1]);
    assert_eq!(marked(&[("row 1", 0.0, 0.0), ("row 2", 1.0, 0.0), ("row 1", 0.0, 0.0)]), [0, 0, 0]);
    assert_eq!(marked(&[]), [0, 0, 0]);
}

#[test]
fn cells_are_the_darker_the_more_is_in_them() {
    let grid = Grid { cell: 10.0, corner: Point::ORIGIN, along: Vector::new(1.0, 0.0), rows: 2, columns: 2 };
    let area = vec![Point::ORIGIN, Point::new(20.0, 0.0), Point::new(20.0, 20.0), Point::new(0.0, 20.0)];
    let picture = |values: [f64; 4]| {
        let map = Some(Cells { legend: "belief: 0 to 1".to_string(), grid, values: values.to_vec() });
        Picture { area: area.clone(), map, ..Picture::default() }.svg()
    };
    let svg = picture([0.0, 0.5, 1.0, f64::NAN]);
    let cells = |svg: &str| svg.lines().filter(|line| line.contains("Z\" fill-opacity")).count();
    assert_eq!(cells(&svg), 2, "neither the least nor what is no number is drawn: {svg}");
    assert!(svg.contains("fill-opacity=\"0.75\"") && svg.contains("fill-opacity=\"0.40\""), "{svg}");
    assert!(svg.contains("belief: 0 to 1"), "{svg}");
    assert_eq!(cells(&picture([2.0; 4])), 0, "where all cells hold the same there is nothing to be seen");
}

#[test]
fn areas_that_were_reported_are_drawn_and_named() {
    let dent = vec![
        Point::ORIGIN,
        Point::new(20.0, 0.0),
        Point::new(5.0, 10.0),
        Point::new(20.0, 20.0),
        Point::new(0.0, 20.0),
    ];
    let svg = Picture { outlines: vec![("hollow".to_string(), dent)], ..Picture::default() }.svg();
    assert!(svg.contains(">hollow<") && svg.contains(">reported area<"), "{svg}");
    assert_eq!(svg.lines().filter(|line| line.contains("Z\" fill=\"#111\" fill-opacity=\"0.08\"")).count(), 2, "{svg}");
}

/// So many seconds at some depths over some bottom.
fn profile(seconds: u32, depth: impl Fn(f64) -> f64, bottom: impl Fn(f64) -> f64) -> Profile {
    let sounding = |t: u32| {
        let t_s = f64::from(t);
        Sounding { t_s, depth: depth(t_s), bottom: bottom(t_s), behavior: (t / 300 % 3) as u16 }
    };
    Profile { soundings: (0..seconds).map(sounding).collect(), is_bottom_true: true }
}

#[test]
fn the_depth_is_under_the_chart_in_the_colours_of_the_track() {
    let svg = Picture { profile: profile(2401, |t| 3.0 + t / 400.0, |_| 12.0), ..full() }.svg();
    check(&svg);
    for told in [">depth (m)<", ">time (min)<", ">true bottom<", ">40<", ">10<"] {
        assert!(svg.contains(told), "{told}: {svg}");
    }
    let strokes = |svg: &str, colour: &str| svg.matches(&format!("stroke=\"{colour}\"")).count();
    // The line of the track, that of the legend, and that of the panel.
    assert_eq!(strokes(&svg, "#0072b2"), 1 + strokes(&full().svg(), "#0072b2"));
    assert!(!full().svg().contains("depth (m)"), "what was not sensed is not drawn");
    let one = Profile { soundings: profile(1, |_| 3.0, |_| 9.0).soundings, is_bottom_true: false };
    assert!(!Picture { profile: one, ..full() }.svg().contains("depth (m)"));
}

#[test]
fn a_bottom_is_drawn_where_it_is_known_and_near() {
    let bottoms = |svg: &str| svg.matches("stroke=\"#8a6d3b\" stroke-width=\"1.4\"").count();
    let drawn = |profile| Picture { profile, ..Picture::default() }.svg();
    // Lost for a while: two pieces and the legend.
    let lost = drawn(profile(600, |_| 5.0, |t| if (200.0..300.0).contains(&t) { f64::NAN } else { 9.0 }));
    assert_eq!(bottoms(&lost), 3, "{lost}");
    check(&lost);
    let abyss = drawn(profile(600, |_| 5.0, |_| 4_000.0));
    assert!(bottoms(&abyss) == 0 && abyss.contains(">5.0<") && !abyss.contains("true bottom"), "{abyss}");
    // One that falls off is shown as long as it is near.
    let edge = drawn(profile(600, |_| 5.0, |t| 10.0 + t));
    assert!(bottoms(&edge) == 2 && edge.contains(">20<") && !edge.contains(">600<"), "{edge}");
    // Deep down the axis does not begin at the surface.
    let deep = drawn(profile(600, |t| 2_990.0 + t / 100.0, |_| 3_000.0));
    assert!(deep.contains(">3000<") && !deep.contains(">1500<"), "{deep}");
    check(&drawn(profile(2, |_| -0.1, |_| f64::INFINITY)));
    check(&drawn(profile(5, |_| f64::NAN, |_| 3.0)));
}

#[test]
fn the_depths_of_a_long_run_in_waves_take_little() {
    let waves = |t: f64| 4.0 + albacore_geometry::math::sin(t * 1.7) + 0.3 * albacore_geometry::math::sin(t * 13.3);
    let profile = profile(36_000, waves, |t| 9.0 + waves(0.3 * t));
    let with = Picture { profile, ..Picture::default() }.svg();
    check(&with);
    assert!(with.len() < 80_000, "{} bytes", with.len());
}

#[test]
fn the_end_has_a_mark_of_its_own() {
    let end = Some(Point::new(40.0, -20.0));
    let (with, without) = (Picture { end, ..full() }.svg(), full().svg());
    check(&with);
    assert_eq!((with.matches(">end</text>").count(), without.matches(">end</text>").count()), (2, 0), "and the legend");
}

#[test]
fn lines_of_equal_depth_have_labels_apart_from_each_other() {
    let area = Area::rectangle(Point::ORIGIN, Heading::NORTH, 320.0, 220.0);
    let depths = Depths::sound(area.corners(), |p| 4.0 + 2.0 / (1.0 + p.distance(Point::new(20.0, -30.0)) / 40.0));
    let svg = Picture { area: area.corners().to_vec(), depths, ..Picture::default() }.svg();
    check(&svg);
    let number = |line: &str, name: &str| -> f64 {
        let after = line.split_once(&format!("{name}=\"")).unwrap().1;
        after.split('"').next().unwrap().parse().unwrap()
    };
    let labels: Vec<(f64, f64)> = svg
        .lines()
        .filter(|line| line.contains("fill=\"#3f5f73\""))
        .map(|line| (number(line, " x"), number(line, " y")))
        .collect();
    assert!((3..=16).contains(&labels.len()), "{labels:?}");
    for (i, a) in labels.iter().enumerate() {
        let apart = |b: &(f64, f64)| (a.0 - b.0).abs() > 19.0 || (a.1 - b.1).abs() > 13.0;
        assert!(labels[i + 1..].iter().all(apart), "{labels:?}");
    }
    assert!(svg.contains(">4.8</text>"), "{svg}");
}

#[test]
fn names_that_are_said_again_and_again_never_stand_on_each_other() {
    let report = |i: u32| ("thermocline crossed".to_string(), Point::new(0.0, f64::from(i) * 12.0));
    let reports = (0..60).map(report).collect();
    let svg = Picture { reports, ..Picture::default() }.svg();
    let count = svg.matches(">thermocline crossed</text>").count();
    assert!((2..20).contains(&count), "{count}");
}

/// As it is and, where that is to be seen, as it was; beneath the track, and without a say in how much of the world is seen.
#[test]
fn a_true_outline_is_drawn_beneath_the_track_as_it_is_and_as_it_was() {
    let ring = |east: f64| -> Vec<Point> {
        let angle = |i: u32| Heading::from_degrees(f64::from(10 * i));
        (0..36).map(|i| Point::new(0.0, east) + 60.0 * angle(i).unit()).collect()
    };
    let with = |named: TrueOutline| Picture { true_outlines: vec![named], ..full() }.svg();
    let oil = |before: f64| TrueOutline { name: "oil".into(), corners: ring(0.0), before: ring(before) };
    let svg = with(oil(-100.0));
    check(&svg);
    assert!(svg.contains(">oil</text>") && svg.contains(">true outline</text>"));
    assert!(svg.contains(">true outline at the start</text>"));
    assert!(svg.find("fill-opacity=\"0.14\"").unwrap() < svg.find("stroke=\"#0072b2\"").unwrap());
    let still = with(oil(0.1));
    assert!(still.contains(">true outline</text>") && !still.contains("at the start"), "it has hardly moved");
    let far = with(TrueOutline { name: "far".into(), corners: ring(1e6), before: Vec::new() });
    assert!(!far.contains(">far<") && !far.contains("true outline"));
    let scale = |svg: &str| svg.contains(">200 m<");
    assert!(scale(&svg) && scale(&far));
    let around = [(-1e5, -1e5), (1e5, -1e5), (1e5, 1e5), (-1e5, 1e5)].map(|(n, e)| Point::new(n, e)).to_vec();
    let within = with(TrueOutline { name: "all".into(), corners: around, before: Vec::new() });
    assert!(within.contains(">true outline</text>"), "all of the chart lies within it");
    check(&with(TrueOutline { name: "none".into(), corners: vec![Point::new(f64::NAN, 0.0); 4], before: Vec::new() }));
}
