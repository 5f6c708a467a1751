//! The plume's physics, each law against its own parameter.

use super::*;
use crate::world::Environment;
use crate::world::water::{Flow, Meander, Tide};
use albacore_geometry::{Area, Heading, Point, Vector};

/// A wide uniform flow with one source near its up-flow end.
fn uniform(rate: f64, settings: Plume) -> Scenario {
    Scenario {
        environment: Environment {
            region: Some(Area::rectangle(Point::ORIGIN, Heading::NORTH, 2000.0, 600.0)),
            flow: Flow { mean: Vector::new(0.2, 0.0), ..Flow::default() },
            plume: Some(settings),
            sources: vec![Source { at: Point::new(-900.0, 0.0), rate, ..Default::default() }],
            ..Environment::default()
        },
        ..Scenario::default()
    }
}

/// A plume in a current that meanders through a region like that of the 2005 paper's trial.
fn meandering(settings: Plume) -> Scenario {
    let down_flow = Heading::from_degrees(140.0);
    Scenario {
        environment: Environment {
            region: Some(Area::rectangle(Point::ORIGIN, down_flow, 1094.0, 367.0)),
            flow: Flow { mean: 0.125 * down_flow.unit(), meander: Some(Meander::default()), ..Flow::default() },
            plume: Some(settings),
            sources: vec![Source { at: Point::ORIGIN - 427.0 * down_flow.unit(), ..Source::default() }],
            ..Environment::default()
        },
        ..Scenario::default()
    }
}

/// The plume of that trial, which rises in a layer.
fn rising() -> Plume {
    Plume { vertical: 1e-3, layer: Some(3.5), ..Plume::default() }
}

fn begun(scenario: &Scenario, begin: f64, seed: u64) -> (FilamentPlume, Water) {
    scenario.validate().unwrap();
    let (flow, region) = (&scenario.environment.flow, scenario.environment.region.as_ref());
    let water = Water::new(flow, region, begin, ahead(scenario), seed);
    (FilamentPlume::new(scenario, water.frame(), begin, seed).unwrap(), water)
}

/// All filaments, and where they are at the end of the last step.
fn now(plume: &FilamentPlume) -> Vec<(Filament, [f64; 3])> {
    plume.at(plume.time(plume.until)).map(|(f, at)| (*f, at)).collect()
}

fn squared(x: f64) -> f64 {
    x * x
}

/// The diffusivity that the filaments show: the mean over all of displacement^2 / (2 age), along and across the flow.
fn shown_diffusivity(step: f64, seed: u64) -> (f64, f64) {
    let (mut plume, mut water) = begun(&uniform(4.0, Plume { step, ..Default::default() }), 0.0, seed);
    plume.advance_to(10_000, &mut water);
    let [x, y, _] = plume.origins[0].place;
    let all = now(&plume);
    let mean = |square: &dyn Fn([f64; 3], f64) -> f64| {
        all.iter().map(|(f, at)| square(*at, plume.time(plume.until) - f.birth)).sum::<f64>() / all.len() as f64
    };
    let along = mean(&|at, age| squared(at[0] - x - 0.2 * age) / (2.0 * age));
    (along, mean(&|at, age| squared(at[1] - y) / (2.0 * age)))
}

/// What it has caught elsewhere: noise times dt instead of its root, which halves the diffusivity with the step.
#[test]
fn the_diffusivity_is_the_parameter_whatever_the_step() {
    for step in [0.5, 2.0] {
        let (along, across) = shown_diffusivity(step, 11);
        assert!((along / 0.027 - 1.0).abs() < 0.06, "{along} along, steps of {step} s");
        assert!((across / 0.027 - 1.0).abs() < 0.06, "{across} across, steps of {step} s");
    }
}

#[test]
fn as_many_are_alive_as_are_released_in_a_transit() {
    let scenario = uniform(1.0, Plume::default());
    let begin = spin_up_begin(&scenario);
    assert!(begin <= -9800.0);
    let mut counts = Vec::new();
    for seed in 0..4 {
        let (mut plume, mut water) = begun(&scenario, begin, seed);
        plume.spin_up(&mut water, &[], 0);
        counts.push(plume.alive(plume.time(plume.until)).count() as f64);
        plume.advance_to(10_000, &mut water);
        counts.push(plume.alive(plume.time(plume.until)).count() as f64);
    }
    // From the source to the end of the margin: 1900 m + 60 m at 0.2 m/s; each count varies by its root, 99.
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    assert!((mean - 9800.0).abs() < 120.0, "{counts:?}");
}

/// A layer fills evenly in the end, and nothing leaves it.
#[test]
fn vertical_mixing_fills_the_layer() {
    let settings = Plume { vertical: 0.01, layer: Some(3.5), ..Default::default() };
    let (mut plume, mut water) = begun(&uniform(2.0, settings), 0.0, 2);
    plume.advance_to(20_000, &mut water);
    let all = now(&plume);
    assert!(all.iter().all(|(_, at)| (0.0..=3.5).contains(&at[2])));
    let old: Vec<f64> =
        all.iter().filter(|(f, _)| plume.time(plume.until) - f.birth > 1000.0).map(|(_, at)| at[2]).collect();
    let mean = old.iter().sum::<f64>() / old.len() as f64;
    let deviation = (old.iter().map(|z| squared(z - mean)).sum::<f64>() / old.len() as f64).sqrt();
    assert!((mean - 1.75).abs() < 0.1 && (deviation - 3.5 / 12.0_f64.sqrt()).abs() < 0.06, "{mean} {deviation}");
}

/// A vehicle meets a rising plume first where the few of its filaments are that rise fastest: as many as a walk that the bottom throws back has,
/// although their strides have one draw.
#[test]
fn as_many_rise_fast_as_in_a_walk() {
    let settings = Plume { vertical: 1e-3, layer: Some(3.5), ..Default::default() };
    let mut scenario = uniform(100.0, settings);
    scenario.environment.sources[0].at = Point::new(850.0, 0.0);
    let (mut plume, mut water) = begun(&scenario, 0.0, 5);
    let (mut all, mut high) = (0, 0);
    for sample in 0..80 {
        let tick = 2000 + 200 * sample;
        plume.advance_to(tick, &mut water);
        let time = tick as f64 * TICK_S;
        for (f, at) in plume.at(time) {
            let is_young = (90.0..110.0).contains(&(time - f.birth));
            all += u32::from(is_young);
            high += u32::from(is_young && at[2] > 1.2);
        }
    }
    // Released at 0.2 m, 100 s old: P(|0.2 m + sqrt(2 K t) N| > 1.2 m) = 1.36 % over these ages.
    let share = f64::from(high) / f64::from(all);
    assert!(all > 150_000 && (share / 0.01363 - 1.0).abs() < 0.05, "{high} of {all}: {share}");
}

#[test]
fn one_search_for_a_neighbourhood_reads_the_same_bits_as_one_for_each_place() {
    let scenario = meandering(rising());
    let begin = spin_up_begin(&scenario);
    let (mut plume, mut water) = begun(&scenario, begin, 4);
    plume.spin_up(&mut water, &[], 0);
    plume.advance_to(10, &mut water);
    let mut shared = Nearby::default();
    let mut read = 0;
    for place in plume.alive(0.5).map(|(place, _)| place).step_by(97).collect::<Vec<_>>() {
        for i in 0..10 {
            let near = [place[0] + 0.2 * f64::from(i), place[1] - 0.1, 1.5];
            let time = 0.1 * f64::from(i);
            let once = shared.reading(&plume, near, time);
            assert_eq!(once.to_bits(), Nearby::default().reading(&plume, near, time).to_bits());
            read += usize::from(once > 0.0);
        }
    }
    assert!(read > 500, "{read} places with chemical");
}

/// Patches alone need no spin-up: who looked at them before the first stride looks anew in it.
#[test]
fn a_look_before_the_first_stride_says_nothing_of_it() {
    let mut scenario = uniform(4.0, Plume::default());
    scenario.environment.sources.clear();
    let patch = Patch { at: Point::ORIGIN, radius: 3.0, filaments: 300, age: 60.0, ..Patch::default() };
    scenario.environment.patches.push(patch.clone());
    let (mut plume, mut water) = begun(&scenario, spin_up_begin(&scenario), 4);
    plume.spin_up(&mut water, &[patch], 4);
    let mut looks = Nearby::default();
    let place = plume.alive(0.0).map(|(place, _)| place).next().unwrap();
    assert!(looks.reading(&plume, place, 0.0) > 0.0);
    for tick in 1..200 {
        plume.advance_to(tick, &mut water);
        let time = tick as f64 * TICK_S;
        let moved = [place[0] + 0.2 * time, place[1], place[2]];
        let anew = Nearby::default().reading(&plume, moved, time);
        assert!(anew > 0.0);
        assert_eq!(looks.reading(&plume, moved, time).to_bits(), anew.to_bits(), "{time} s");
    }
}

/// The index leaves out what reads exactly zero, and sums the rest in another order.
#[test]
fn an_index_reads_what_a_search_of_the_whole_plume_does() {
    for scenario in [meandering(rising()), meandering(Plume::default())] {
        let (mut plume, mut water) = begun(&scenario, spin_up_begin(&scenario), 4);
        plume.spin_up(&mut water, &[], 0);
        plume.advance_to(10, &mut water);
        let index = Index::new(&plume, 0.7);
        assert_eq!(index.len(), plume.alive(0.7).count());
        let (mut read, mut nothing) = (0, 0);
        for place in plume.alive(0.7).map(|(place, _)| place).step_by(31).collect::<Vec<_>>() {
            for aside in [0.0, 3.0, 60.0, 1000.0] {
                let place = [place[0] - 0.3 * aside, place[1] + aside, 1.5];
                let (searched, indexed) = (Nearby::default().reading(&plume, place, 0.7), index.reading(place));
                assert!((searched - indexed).abs() <= 1e-12 * searched, "{searched} {indexed}");
                *(if searched > 0.0 { &mut read } else { &mut nothing }) += 1;
            }
        }
        assert!(read > 300 && nothing > 300, "{read} places with chemical, {nothing} without");
    }
}

/// Old filaments, too, go to and fro within seconds: who crosses a place again soon meets another plume. Straight parts of T seconds take
/// something away from that, a third over T seconds, and three quarters over T / 4.
#[test]
fn old_filaments_go_to_and_fro() {
    let scenario = uniform(1.0, Plume::default());
    let (mut plume, mut water) = begun(&scenario, spin_up_begin(&scenario), 9);
    plume.spin_up(&mut water, &[], 0);
    let places = |plume: &FilamentPlume, time: f64| -> std::collections::BTreeMap<u32, [f64; 3]> {
        plume.at(time).filter(|(f, _)| f.birth < time - 4000.0).map(|(f, at)| (f.number, at)).collect()
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for second in (5..400).step_by(37) {
        plume.advance_to(10 * second, &mut water);
        let before = places(&plume, second as f64);
        plume.advance_to(10 * second + 160, &mut water);
        for (number, after) in places(&plume, second as f64 + 16.0) {
            let Some(before) = before.get(&number) else { continue };
            sum += squared(after[0] - before[0] - 0.2 * 16.0) + squared(after[1] - before[1]);
            count += 2.0;
        }
    }
    let share = sum / count / (2.0 * 0.027 * 16.0);
    assert!(count > 20_000.0 && (0.6..0.8).contains(&share), "{share} of the diffusion, {count}");
}

/// Between steps a filament moves on a line: it ends a step where it begins the next.
#[test]
fn nothing_jumps_between_steps() {
    let scenario = Scenario {
        environment: Environment {
            flow: Flow { mean: Vector::new(0.2, 0.0), meander: Some(Meander::default()), ..Flow::default() },
            ..uniform(1.0, Plume::default()).environment
        },
        ..uniform(1.0, Plume::default())
    };
    let (mut plume, mut water) = begun(&scenario, 0.0, 6);
    let (mut at_once, mut strides) = (0, std::collections::BTreeSet::new());
    for second in 3060..3090 {
        plume.advance_to(10 * second, &mut water);
        let time = second as f64;
        let before: Vec<_> = plume.alive(time).collect();
        plume.advance_to(10 * second + 10, &mut water);
        let after: Vec<_> = plume.alive(time).collect();
        assert_eq!(before.len(), after.len());
        for (a, b) in before.iter().zip(&after) {
            assert!((0..3).all(|i| (a.0[i] - b.0[i]).abs() < 1e-9) && (a.1 - b.1).abs() < 1e-12, "{a:?} {b:?}");
        }
        let begun = plume.time(plume.begun);
        let straight = plume.at(time).map(|(f, _)| plume.steps.straight(begun - f.birth));
        at_once = straight.fold(at_once, u64::max);
        strides.insert(plume.begun);
    }
    assert_eq!((at_once, strides.len()), (16, 2), "the oldest go straight for 16 s");
}

/// What was released in one tide is carried back by the next: the plume lies on both sides of its source.
#[test]
fn a_tide_carries_the_plume_to_both_sides() {
    let tide = Tide { amplitude: Vector::new(0.15, 0.0), period: 8000.0, ..Tide::default() };
    let scenario = Scenario {
        environment: Environment {
            flow: Flow { mean: Vector::new(0.04, 0.0), tides: vec![tide], ..Flow::default() },
            sources: vec![Source { at: Point::new(-300.0, 0.0), ..Default::default() }],
            ..uniform(1.0, Plume::default()).environment
        },
        ..uniform(1.0, Plume::default())
    };
    let begin = spin_up_begin(&scenario);
    assert!((-70_000.0..-40_000.0).contains(&begin), "some 50,000 s at 4 cm/s for 2120 m: {begin}");
    let (mut plume, mut water) = begun(&scenario, begin, 3);
    plume.spin_up(&mut water, &[], 0);
    let [source, ..] = plume.origins[0].place;
    // To and fro by 0.15 T / 2 pi = 191 m: at tick 0, in mid flood, 191 m up-flow of the mean path.
    let fresh: Vec<f64> =
        now(&plume).iter().filter(|(f, _)| (-2000.0..0.0).contains(&f.birth)).map(|(_, at)| at[0] - source).collect();
    assert!(fresh.iter().all(|x| (-40.0..330.0).contains(x)));
    plume.advance_to(40_000, &mut water);
    let young = now(&plume).into_iter().filter(|(f, _)| f.birth > 0.0 && f.birth < 4000.0);
    let sides: Vec<bool> = young.map(|(_, at)| at[0] < source).collect();
    assert!(sides.iter().any(|up| *up) && sides.iter().any(|up| !up), "on both sides after half a tide");
    assert_eq!(water.velocity(Point::ORIGIN, 4000.0).north, 0.04 - 0.15);
}

/// A patch is there at the start, drifts away and is followed by nothing.
#[test]
fn a_patch_is_as_wide_as_asked_and_drifts() {
    let patch =
        Patch { at: Point::new(-500.0, 20.0), radius: 15.0, filaments: 2000, age: 30_000.0, ..Patch::default() };
    let scenario = Scenario {
        environment: Environment {
            sources: Vec::new(),
            patches: vec![patch.clone()],
            ..uniform(1.0, Plume { diffusivity: 0.0, ..Default::default() }).environment
        },
        ..uniform(1.0, Plume { diffusivity: 0.0, ..Default::default() })
    };
    let (mut plume, mut water) = begun(&scenario, spin_up_begin(&scenario), 3);
    plume.spin_up(&mut water, &scenario.environment.patches, 3);
    let [x, y, _] = plume.origins[0].place;
    let centre = |plume: &FilamentPlume| {
        let all = now(plume);
        let mean = |axis: usize| all.iter().map(|(_, at)| at[axis]).sum::<f64>() / all.len() as f64;
        (mean(0), mean(1))
    };
    let (cx, cy) = centre(&plume);
    assert!((cx - x).abs() < 1.5 && (cy - y).abs() < 1.5);
    let variance = now(&plume).iter().map(|(_, at)| squared(at[0] - cx)).sum::<f64>() / 2000.0;
    assert!((variance.sqrt() - 15.0).abs() < 0.8);
    let radius = plume.largest_squared_radius().sqrt();
    assert!((0.0..0.01).contains(&(radius - 3.04_f64.sqrt())), "as wide as 30,000 s make it: {radius}");
    plume.advance_to(10_000, &mut water);
    let (gone, after) = (centre(&plume).0 - cx, plume.time(plume.until));
    assert!((gone - 0.2 * after).abs() < 1e-6 && now(&plume).len() == 2000, "{gone} {}", now(&plume).len());
    // The look-ups know how wide it is.
    let place = [cx + 260.0, cy, 0.2];
    let read = Nearby::default().reading(&plume, place, 1000.0);
    let whole: f64 = plume
        .alive(1000.0)
        .map(|(at, r)| {
            let d2 = squared(at[0] - place[0]) + squared(at[1] - place[1]);
            if d2 <= 25.0 * r * r {
                plume.origins[0].kernel.strength(r * r) * albacore_geometry::math::exp(-d2 / (2.0 * r * r))
            } else {
                0.0
            }
        })
        .sum();
    assert!((read - whole).abs() < 1e-9 && read > 0.0, "{read} {whole}");
}

/// A leak releases evenly along its line.
#[test]
fn a_leak_is_a_line() {
    let mut scenario = uniform(2.0, Plume { diffusivity: 0.0, ..Default::default() });
    scenario.environment.sources[0].to = Some(Point::new(-900.0, 100.0));
    let (mut plume, mut water) = begun(&scenario, 0.0, 3);
    plume.advance_to(20_000, &mut water);
    let [_, y, _] = plume.origins[0].place;
    let mut aside: Vec<f64> = now(&plume).iter().map(|(_, at)| at[1] - y).collect();
    aside.sort_by(f64::total_cmp);
    let quantile = |share: f64| aside[(share * aside.len() as f64) as usize];
    assert!(aside[0] >= -1e-9 && quantile(0.999) <= 100.0);
    assert!((quantile(0.25) - 25.0).abs() < 3.0 && (quantile(0.75) - 75.0).abs() < 3.0);
}
