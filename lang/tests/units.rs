//! Units and dimensions: what each comes to.

#![expect(clippy::unwrap_used, reason = "a unit that is not known has failed the test")]

use albacore_lang::dimension::{DEGREE, Dimension, unit};

#[track_caller]
fn check(text: &str, dimension: Dimension, scale: f64) {
    let unit = unit(text, &|_| None).unwrap();
    assert_eq!(unit.dimension, dimension);
    assert!((unit.scale - scale).abs() < 1e-12 * scale, "{}", unit.scale);
}

#[test]
fn units_compose() {
    check("cm/s", Dimension::SPEED, 0.01);
    check("m2/s", Dimension::of_type("Diffusivity").unwrap(), 1.0);
    check("m/s^0.5", Dimension::of_type("RandomWalk").unwrap(), 1.0);
    check("deg/s", Dimension::of_type("TurnRate").unwrap(), DEGREE);
    check("degC/m", Dimension::TEMPERATURE.over(Dimension::LENGTH).unwrap(), 1.0);
    assert_eq!(unit("sec", &|_| None), None);
    assert_eq!(unit("m/t", &|_| None), None);
}

/// A number in a unit that is a power of ten is that number with its point moved, to the last bit.
#[test]
fn the_point_moves() {
    let si = |number: f64, text: &str| unit(text, &|_| None).unwrap().si(number);
    for percent in 1..=100 {
        let written: f64 = format!("{}.{:02}", percent / 100, percent % 100).parse().unwrap();
        assert_eq!((si(percent.into(), "%"), si(percent.into(), "cm")), (written, written), "{percent}");
    }
    assert_eq!([si(1.005, "km"), si(94.0, "ppm"), si(12.3, "cm/s"), si(0.3, "ms")], [1005.0, 0.000_094, 0.123, 0.0003]);
    assert_eq!(si(90.0, "deg"), 90.0 * DEGREE);
}

#[test]
fn a_dimension_says_its_name_or_its_units() {
    assert_eq!(Dimension::SPEED.to_string(), "Speed");
    assert_eq!(Dimension::LENGTH.times(Dimension::ANGLE).unwrap().to_string(), "a quantity in m rad");
}

/// What a function is given for a parameter says what `Quantity` is, and that the type of all else.
#[test]
fn a_quantity_is_found_in_what_is_given_for_it() {
    let quantity = Dimension::QUANTITY;
    let rate = quantity.over(Dimension::TIME).unwrap();
    assert_eq!(rate.quantity_in(Dimension::SPEED), Some(Dimension::LENGTH));
    assert_eq!(rate.with_quantity(Dimension::LENGTH), Some(Dimension::SPEED));
    let square = quantity.power(2.0).unwrap();
    assert_eq!(square.quantity_in(Dimension::of_type("Surface").unwrap()), Some(Dimension::LENGTH));
    assert_eq!(square.quantity_in(rate), rate.power(0.5));
    let cube = quantity.power(3.0).unwrap();
    assert_eq!(cube.quantity_in(Dimension::SPEED), None);
    assert_eq!(cube.with_quantity(Dimension::LENGTH.power(20.0).unwrap()), None);
    assert_eq!(square.over(Dimension::SPEED).unwrap().to_string(), "Quantity^2*Duration/Length");
    assert_eq!(quantity.power(-0.5).unwrap().to_string(), "Ratio/Quantity^0.5");
}

/// What messages advise can be written.
#[test]
fn every_dimension_has_a_unit_that_is_read_as_it() {
    let bases = [Dimension::LENGTH, Dimension::TIME, Dimension::ANGLE, Dimension::MASS, Dimension::TEMPERATURE];
    for (i, a) in bases.into_iter().enumerate() {
        for b in bases {
            for (p, q) in [(1.0, 1.0), (-1.0, -1.0), (2.0, -0.5), (-3.0, 1.5), (0.0, -1.0)] {
                let dimension = a.power(p).and_then(|a| a.times(b.power(q)?)).unwrap();
                let text = dimension.unit();
                assert_eq!(unit(&text, &|_| None).map(|u| u.dimension), Some(dimension), "{i}: {text}");
            }
        }
    }
}
