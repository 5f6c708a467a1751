//! One side of a grid: evenly spaced places, ascending.

use crate::fault::{Fault, compact, counted, shortened};
use crate::survey::CELLS_MAX;
use crate::survey::CUT_IT;

/// A place is off its even spacing by at most this share of a step. Degrees in single precision are: steps of 15 seconds
/// of arc about 290 degrees by 0.4 %.
const UNEVEN_MAX: f64 = 0.01;

/// Evenly spaced places, ascending: metres, or radians of latitude or longitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The first place: the southern or western edge.
    pub first: f64,
    /// The last place.
    pub last: f64,
    /// How many there are, both ends included: two or more.
    pub count: u32,
}

impl Axis {
    /// Between two ends, as the head of a CSV file gives them. `name` is what the file calls the axis.
    pub(crate) fn between(name: &str, first: f64, last: f64, count: u64) -> Result<Axis, Fault> {
        let name = &shortened(name);
        if count < 2 {
            let message = format!("`{name}` has {}: a grid has two or more", counted(count, "place"));
            return Err(Fault::new(message, "widen the cut"));
        }
        let Some(count) = u32::try_from(count).ok().filter(|count| u64::from(*count) <= CELLS_MAX) else {
            let message = format!("`{name}` has {count} places: {CELLS_MAX} cells are read at most");
            return Err(Fault::new(message, CUT_IT));
        };
        let runs = || format!("`{name}` runs from {} to {}", compact(first), compact(last));
        if !(first.is_finite() && last.is_finite()) {
            return Err(Fault::new(runs(), "give finite numbers"));
        }
        if first == last {
            let mend = "give the places of the first cell and of the last: rows run from south to north, cells from west to east";
            return Err(Fault::new(format!("{}: these are one place", runs()), mend));
        }
        if first >= last {
            let message = format!("{}: it must ascend", runs());
            let mend = "give the smaller end first: rows run from south to north, the cells of a row from west to east";
            return Err(Fault::new(message, mend));
        }
        Ok(Axis { first, last, count })
    }

    /// Through places as a file lists them.
    pub(crate) fn through(name: &str, places: &[f64]) -> Result<Axis, Fault> {
        let short = &shortened(name);
        if let Some((i, place)) = places.iter().enumerate().find(|(_, place)| !place.is_finite()) {
            return Err(Fault::new(format!("`{short}({i})` is {place}"), "give finite numbers"));
        }
        if let Some(i) = (1..places.len()).find(|&i| places[i] <= places[i - 1]) {
            let message =
                format!("`{short}({i})` is {} after {}: it must ascend", compact(places[i]), compact(places[i - 1]));
            let mend = match places.windows(2).all(|pair| pair[1] < pair[0]) {
                true => format!("turn it round, rows and all: `ncpdq -a -{short} IN.nc OUT.nc`"),
                false => "give each place once, in their order, with its row".to_string(),
            };
            return Err(Fault::new(message, mend));
        }
        let ends = places.first().zip(places.last());
        let (first, last) = ends.map_or((0.0, 0.0), |(first, last)| (*first, *last));
        let axis = Axis::between(name, first, last, places.len() as u64)?;
        let step = axis.step();
        let off = |(i, place): &(usize, &f64)| (*place - (first + *i as f64 * step)).abs() > UNEVEN_MAX * step;
        match places.iter().enumerate().find(off) {
            None => Ok(axis),
            Some((i, place)) => {
                let (place, even) = (compact(*place), compact(first + i as f64 * step));
                let message =
                    format!("`{short}` is not evenly spaced: `{short}({i})` is {place}, evenly it were {even}");
                Err(Fault::new(message, "lay it onto an even grid, such as with `cdo remapbil` or `gmt surface`"))
            }
        }
    }

    /// From one place to the next.
    pub fn step(&self) -> f64 {
        (self.last - self.first) / f64::from(self.count - 1)
    }

    /// The place that divides the axis in this share.
    pub fn at_share(&self, share: f64) -> f64 {
        self.first + share * (self.last - self.first)
    }

    /// The same in another unit.
    pub(crate) fn times(self, factor: f64) -> Axis {
        Axis { first: self.first * factor, last: self.last * factor, ..self }
    }
}
