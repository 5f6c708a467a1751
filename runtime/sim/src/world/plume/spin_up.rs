//! How long before the run a plume must begin to be whole at its start.

use crate::scenario::Scenario;
use crate::world::plume::SPIN_UP_MAX_S;
use crate::world::plume::steps::spin_up_stride;
use crate::world::water::{Current, FlowFrame};

/// The spin-up lasts this many times the mean flow's time from the farthest source to the down-flow end.
const SPIN_UP_TRANSITS: f64 = 1.15;
/// Steps in which it is found out how long that takes where the flow changes, s.
const TRANSIT_STEP_S: f64 = 60.0;

/// When the spin-up begins, s: so long before 0 that what was released earlier has left its box by 0. Nobody looks before 0, so
/// that all strides are as long as they may be: a whole number of them.
pub fn begin(scenario: &Scenario) -> f64 {
    if scenario.environment.plume.is_none() || scenario.environment.sources.is_empty() {
        return 0.0;
    }
    let frame = FlowFrame::new(&scenario.environment.flow, scenario.environment.region.as_ref());
    let current = Current::new(&scenario.environment.flow);
    let transit = if current.is_steady() {
        let farthest =
            scenario.environment.sources.iter().map(|s| frame.length - frame.to_local(s.at).0).fold(0.0, f64::max);
        SPIN_UP_TRANSITS * (farthest / scenario.environment.flow.mean.length())
    } else {
        emptied_in(&current, SPIN_UP_TRANSITS * frame.length, SPIN_UP_TRANSITS * frame.width, &frame)
    };
    let stride = spin_up_stride(scenario);
    -(transit / stride).ceil() * stride
}

/// How long before 0 the water was elsewhere by so much along or across the flow (m) at some time since, s: a bit more than
/// [`SPIN_UP_MAX_S`] if it never was.
fn emptied_in(current: &Current, length: f64, width: f64, frame: &FlowFrame) -> f64 {
    // Going back from 0: where the water was that is at the origin then, and how far it has come either way since.
    let (mut x, mut y) = (0.0_f64, 0.0_f64);
    let (mut xs, mut ys) = ([0.0_f64; 2], [0.0_f64; 2]);
    let mut age = 0.0;
    while age <= SPIN_UP_MAX_S {
        let (u, v) = frame.of_vector(current.velocity(-(age + 0.5 * TRANSIT_STEP_S)));
        age += TRANSIT_STEP_S;
        (x, y) = (x - u * TRANSIT_STEP_S, y - v * TRANSIT_STEP_S);
        (xs, ys) = ([xs[0].min(x), xs[1].max(x)], [ys[0].min(y), ys[1].max(y)]);
        if (xs[1] - x).max(x - xs[0]) > length || (ys[1] - y).max(y - ys[0]) > width {
            break;
        }
    }
    age
}
