//! What a stored number stands for: its scale and offset, and what of it is no data (NetCDF Users Guide, appendix A).

use crate::fault::{Fault, counted, shortened};
use crate::survey::classic::{Kind, Variable};

/// How the numbers of a variable are stored.
#[derive(Debug)]
pub struct Packing {
    scale: f64,
    offset: f64,
    /// What stands for no data.
    nothing: Vec<f64>,
    /// The least and the greatest number that is valid.
    valid: (f64, f64),
    /// Whether these are numbers as they are stored, not as they are meant.
    valid_as_stored: bool,
}

impl Packing {
    /// What the attributes of a variable say of it.
    pub fn of(variable: &Variable) -> Result<Packing, Fault> {
        let (scale, offset) = (one(variable, "scale_factor")?, one(variable, "add_offset")?);
        if scale == Some(0.0) {
            return Err(wrong(variable, "scale_factor", "is 0"));
        }
        let mut nothing = variable.numbers("_FillValue")?;
        if nothing.is_empty() {
            nothing.extend(variable.fill());
        }
        nothing.extend(variable.numbers("missing_value")?);
        if variable.kind == Kind::Float {
            // Told in double precision a mark is a little off.
            let in_single = |value: &f64| f64::from(*value as f32);
            nothing.extend(nothing.iter().map(in_single).collect::<Vec<f64>>());
        }
        let mut valid = match variable.numbers("valid_range")?.as_slice() {
            [] => (f64::NEG_INFINITY, f64::INFINITY),
            [low, high] if low <= high => (*low, *high),
            _ => return Err(wrong(variable, "valid_range", "is no pair of numbers that ascend")),
        };
        valid.0 = one(variable, "valid_min")?.map_or(valid.0, |low| low.max(valid.0));
        valid.1 = one(variable, "valid_max")?.map_or(valid.1, |high| high.min(valid.1));
        // Of whole numbers that are packed a range in floating point is that of what they mean.
        let is_packed = scale.is_some() || offset.is_some();
        let bounds = ["valid_range", "valid_min", "valid_max"].into_iter().find_map(|name| variable.kind_of(name));
        let valid_as_stored = !(is_packed && variable.kind.is_whole() && bounds.is_some_and(|kind| !kind.is_whole()));
        let (scale, offset) = (scale.unwrap_or(1.0), offset.unwrap_or(0.0));
        Ok(Packing { scale, offset, nothing, valid, valid_as_stored })
    }

    /// What a stored number means.
    pub fn value(&self, stored: f64) -> f64 {
        stored * self.scale + self.offset
    }

    /// Whether a stored number stands for no data.
    pub fn is_nothing(&self, stored: f64) -> bool {
        !stored.is_finite() || self.nothing.contains(&stored)
    }

    /// Whether a stored number is none that the variable can have.
    pub fn is_invalid(&self, stored: f64) -> bool {
        let looked_at = if self.valid_as_stored { stored } else { self.value(stored) };
        !(self.valid.0..=self.valid.1).contains(&looked_at)
    }

    /// Whether the variable says which numbers it can have, the least and the greatest.
    pub fn is_bounded(&self) -> bool {
        self.valid.0.is_finite() && self.valid.1.is_finite()
    }
}

/// An attribute that is one number, if it is there.
fn one(variable: &Variable, name: &str) -> Result<Option<f64>, Fault> {
    match variable.numbers(name)?.as_slice() {
        [] => Ok(None),
        [number] if number.is_finite() => Ok(Some(*number)),
        [number] => Err(wrong(variable, name, &format!("is {number}"))),
        several => Err(wrong(variable, name, &format!("has {}", counted(several.len() as u64, "value")))),
    }
}

fn wrong(variable: &Variable, name: &str, what: &str) -> Fault {
    let variable = shortened(variable.name);
    let help = format!("correct it, or take it away with `ncatted -a {name},{variable},d,, FILE.nc`");
    Fault::new(format!("`{variable}:{name}` {what}"), help)
}
