//! Which of a few measurements one of them is.

use albacore_vehicle::measurements::{ALL, MeasurementInfo};

/// The places of some measurements in a list of them alone, in the order of their numbers.
#[derive(Clone, Debug)]
pub(crate) struct Places([Option<u8>; ALL.len()]);

impl Places {
    /// Those of the measurements of which something is so.
    pub fn of(is_listed: impl Fn(&MeasurementInfo) -> bool) -> Self {
        let mut next = 0..;
        Places(std::array::from_fn(|number| if is_listed(&ALL[number]) { next.next() } else { None }))
    }

    /// That of a measurement by its number.
    #[inline]
    pub fn of_number(&self, measurement: u16) -> Option<usize> {
        self.0.get(usize::from(measurement)).copied().flatten().map(usize::from)
    }
}
