use super::outline::DIRECTIONS;
use super::*;
use albacore_geometry::math::PI;

fn spill(shape: Outline) -> Spill {
    Spill {
        name: "oil".into(),
        shape,
        at: Point::new(100.0, -50.0),
        level: 0.4,
        edge: 0.0,
        drift: Vector::ZERO,
        shear: 0.0,
        shear_along: Heading::NORTH,
        half_life: None,
        roughness: 0.0,
        grain: 10.0,
        flicker: 30.0,
    }
}

fn ellipse() -> Outline {
    Outline::Ellipse { length: 150.0, width: 100.0, along: Heading::from_degrees(60.0) }
}

fn fourier() -> Outline {
    Outline::Fourier { radius: 50.0, order: 10, amplitude: 0.125 }
}

fn of(spill: &Spill, seed: u64) -> Slick {
    Slick::new(spill, 0, seed)
}

#[test]
fn an_ellipse_has_its_axes_and_its_area() {
    let slick = of(&spill(ellipse()), 1);
    let centre = Point::new(100.0, -50.0);
    let along = Heading::from_degrees(60.0);
    for (direction, radius) in [(along, 75.0), (along + FRAC_PI_2, 50.0), (along + PI, 75.0)] {
        assert_eq!(slick.concentration(centre + (radius - 0.1) * direction.unit(), 0.0), 0.4);
        assert_eq!(slick.concentration(centre + (radius + 0.1) * direction.unit(), 0.0), 0.0);
    }
    let outline = slick.outline(0.0).unwrap();
    let exact = PI * 75.0 * 50.0;
    let area = outline.surface();
    assert!((area / exact - 1.0).abs() < 2e-4, "{area} m2 for {exact} m2");
}

/// Each seed has an outline of its own, about as rough as Eq. 23 makes it: the variance of the radius is that of the orders from 1 on, half of a third of
/// the squared amplitude each, and that of the order 0.
#[test]
fn fourier_orders_deform_a_circle() {
    let all: Vec<Vec<f64>> = (1..=300).map(|seed| of(&spill(fourier()), seed).radii.0).collect();
    let count = (all.len() * DIRECTIONS) as f64;
    let radii = || all.iter().flatten();
    let mean = radii().sum::<f64>() / count;
    let variance = radii().map(|r| (r - mean) * (r - mean)).sum::<f64>() / count;
    let amplitude: f64 = 6.25;
    let expected = 11.0 * amplitude * amplitude / 6.0;
    assert!((mean - 50.0).abs() < 0.5, "mean {mean}");
    assert!((variance / expected - 1.0).abs() < 0.08, "variance {variance} for {expected}");
    assert!(radii().all(|r| *r >= 5.0) && all[0] != all[1]);
    // Whatever is asked for, an outline is found.
    let wild = Outline::Fourier { radius: 50.0, order: 40, amplitude: 1.0 };
    assert!(of(&spill(wild), 1).outline(0.0).is_some());
}

#[test]
fn the_outline_is_where_half_of_the_chemical_is() {
    let soft = Spill { edge: 8.0, ..spill(fourier()) };
    let slick = of(&soft, 3);
    let outline = slick.outline(0.0).unwrap();
    for corner in outline.corners() {
        assert!((slick.concentration(*corner, 0.0) - 0.2).abs() < 1e-9);
    }
    // Away from it the sensor reads what the distance says, where the outline is not too bent.
    let place = outline.corners()[17];
    let outward = (place - soft.at).toward().unit();
    let (near, far) = (slick.concentration(place + outward, 0.0), slick.concentration(place + 30.0 * outward, 0.0));
    assert!(near < 0.2 && near > 0.05 && far < 1e-3, "{near} {far}");
}

/// It drifts, is sheared and fades; shear and drift leave its area as it was.
#[test]
fn it_drifts_is_sheared_and_fades() {
    let moving = Spill {
        drift: Vector::new(0.1, 0.0),
        shear: 1e-3,
        shear_along: Heading::from_degrees(90.0),
        half_life: Some(600.0),
        ..spill(ellipse())
    };
    let slick = of(&moving, 1);
    let later = slick.outline(1200.0).unwrap();
    let center = later.center();
    assert!((center.north - 220.0).abs() < 0.5 && (center.east + 50.0).abs() < 0.5, "{center:?}");
    let (before, after) = (slick.outline(0.0).unwrap(), &later);
    let ratio = after.surface() / before.surface();
    assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
    // A point ten metres to starboard of a line that leads east is ten metres south of it: it has gone 12 m east.
    let carried = Point::new(220.0 - 10.0, -50.0 + 12.0);
    assert_eq!(slick.concentration(carried, 1200.0), 0.1);
    for corner in later.corners().iter().step_by(30) {
        let outward = (*corner - center).toward().unit();
        assert_eq!(slick.concentration(*corner + 0.5 * outward, 1200.0), 0.0);
    }
}

/// The edge is off by as much as is said, here and there, now and later, and on average not at all.
#[test]
fn roughness_moves_the_edge() {
    let rough = Spill { roughness: 3.0, ..spill(fourier()) };
    let (mut sum, mut squares, mut apart, mut later, mut n) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for seed in 1..=200 {
        let slick = of(&rough, seed);
        let field = slick.roughness.as_ref().unwrap();
        for i in 0..20 {
            let place = Vector::new(25.0 * f64::from(i), 7.0);
            let x = field.at(place, 5.0);
            (sum, squares, n) = (sum + x, squares + x * x, n + 1.0);
            apart += x * field.at(place + Vector::new(10.0, 0.0), 5.0);
            later += x * field.at(place, 65.0);
        }
    }
    let (mean, deviation) = (sum / n, (squares / n).sqrt());
    assert!(mean.abs() < 0.15 && (deviation - 3.0).abs() < 0.1, "{mean} {deviation}");
    // exp(-1/2) a grain away, exp(-2) two flickers later.
    assert!(
        (apart / squares - 0.607).abs() < 0.05 && (later / squares - 0.135).abs() < 0.06,
        "{apart} {later} {squares}"
    );
}
