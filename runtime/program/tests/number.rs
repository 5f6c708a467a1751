//! Numbers as traces print them.

use albacore_geometry::Point;
use albacore_program::number::{angle, fixed, heading, metres, metres_per_second, point, seconds, value};
use albacore_program::{Display, Shape, area_words};
use std::f64::consts::PI;

fn display(unit: &str, scale: f64, decimals: u8) -> Display {
    Display { unit: unit.to_string(), scale, decimals }
}

#[track_caller]
fn check(shape: Shape, words: &[f64], expected: &str) {
    assert_eq!(value(&shape, words), expected);
}

#[test]
fn no_negative_zero_is_ever_printed() {
    for x in [-0.0, -0.04, -1e-300] {
        assert_eq!(fixed(x, 1), "0.0");
        assert_eq!(point(Point::new(x, -x)), "(0.0, 0.0) m");
    }
    assert_eq!(fixed(-0.4, 0), "0");
    assert_eq!(fixed(-0.06, 1), "-0.1");
}

#[test]
fn what_is_no_number_is_a_question_mark_and_what_is_huge_is_short() {
    assert_eq!(fixed(f64::NAN, 1), "?");
    assert_eq!(fixed(f64::NEG_INFINITY, 1), "-inf");
    assert_eq!(fixed(1e300, 1), "1e300");
}

#[test]
fn times_come_from_the_tick_alone() {
    assert_eq!(seconds(0), "    0.0 s");
    assert_eq!(seconds(4123), "  412.3 s");
    assert_eq!(seconds(u64::MAX), "1844674407370955161.5 s");
}

#[test]
fn headings_stay_below_a_full_turn_as_printed() {
    assert_eq!(heading(291.0 * PI / 180.0), "291.0 deg");
    assert_eq!(heading(359.96 * PI / 180.0), "0.0 deg");
    assert_eq!(heading(359.94 * PI / 180.0), "359.9 deg");
    assert_eq!(heading(-PI / 2.0), "270.0 deg");
    assert_eq!(heading(f64::INFINITY), "? deg");
    assert_eq!(angle(-PI / 8.0), "-22.5 deg");
    for tenth in -7200..7200 {
        let printed = heading(f64::from(tenth) * 0.05 * PI / 180.0);
        let degrees: f64 = printed.trim_end_matches(" deg").parse().unwrap();
        assert!((0.0..360.0).contains(&degrees), "{printed}");
    }
}

#[test]
fn each_shape_has_its_form() {
    check(Shape::Bool, &[1.0], "true");
    check(Shape::Int, &[-3.0], "-3");
    check(Shape::Quantity(display("%", 0.01, 1)), &[0.052], "5.2 %");
    check(Shape::Quantity(display("", 1.0, 2)), &[0.5], "0.50");
    check(Shape::Heading, &[PI], "180.0 deg");
    check(Shape::Depth, &[2.0], "2.0 m");
    check(Shape::Altitude, &[-0.01], "0.0 m");
    check(Shape::Point, &[-405.6, 116.2], "(-405.6, 116.2) m");
    check(Shape::Vector(display("m/s", 1.0, 2)), &[0.12, -0.03], "(0.12, -0.03) m/s");
    check(Shape::Line, &[1.0, 2.0, 3.0, 4.0], "(1.0, 2.0) m to (3.0, 4.0) m");
    check(Shape::Edge, &[1.0, 2.0, 3.0, 4.0, 0.0, 1.0], "(1.0, 2.0) m to (3.0, 4.0) m");
    let mut area = [0.0; area_words(16) as usize];
    area[0] = 4.0;
    check(Shape::Area(16), &area, "area of 4 corners");
    check(Shape::Text, &[3.0], "text 3");
    check(Shape::Enum(["surface".into(), "dive".into()].into()), &[1.0], "dive");
    check(Shape::Optional(Box::new(Shape::Int)), &[0.0, 9.0], "none");
    check(Shape::Optional(Box::new(Shape::Int)), &[1.0, 9.0], "9");
    let source = vec![("at".to_string(), Shape::Point), ("at_edge".to_string(), Shape::Bool)];
    check(
        Shape::Record("Source".into(), source),
        &[414.2, -242.1, 0.0],
        "Source(at: (414.2, -242.1) m, at_edge: false)",
    );
    assert_eq!(metres(1.25), "1.2 m");
    assert_eq!(metres_per_second(1.5), "1.50 m/s");
}

#[test]
fn long_lists_are_cut_and_counted() {
    let list = Shape::List(Box::new(Shape::Int), 9);
    check(list.clone(), &[0.0], "[]");
    check(list.clone(), &[2.0, 5.0, 6.0, 7.0], "[5, 6]");
    let words = [8.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    check(list.clone(), &words, "[1, 2, 3, 4, 5, 6, … 8 in all]");
    check(list, &[1e9], "[?, ?, ?, ?, ?, ?, … 9 in all]");
}

#[test]
fn short_and_senseless_words_are_no_reason_to_fail() {
    let inner = Shape::Record("R".into(), vec![("p".into(), Shape::Point), ("e".into(), Shape::Enum([].into()))]);
    let shapes = [
        (Shape::Bool, "?"),
        (Shape::Int, "?"),
        (Shape::Quantity(display("s", 0.0, 1)), "? s"),
        (Shape::Line, "(?, ?) m to (?, ?) m"),
        (Shape::Area(16), "?"),
        (Shape::Text, "?"),
        (Shape::Optional(Box::new(Shape::Point)), "?"),
        (Shape::List(Box::new(inner.clone()), 4), "?"),
        (inner, "R(p: (?, ?) m, e: ?)"),
    ];
    for (shape, expected) in shapes {
        check(shape.clone(), &[], expected);
        for word in [f64::NAN, f64::INFINITY, -1.0, 1e300, 0.5, 3.0] {
            value(&shape, &[word]);
        }
    }
}
