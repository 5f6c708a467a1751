//! Surveys in NetCDF, by the COARDS and CF conventions.
//!
//! The depths are a variable over two dimensions that have variables of their own: `lat` and `lon` in degrees, or `y` and `x`
//! in metres, by their units or else their names. Elevations are negative below the surface; depths, by name or by the
//! attribute `positive = "down"`, are positive. `scale_factor` and `add_offset` are applied; `_FillValue` and
//! `missing_value` are no data.

use crate::axis::Axis;
use crate::classic::{Classic, Variable};
use crate::fault::{Fault, Faults};
use crate::survey::{Kind, Survey, check_size, is_on_earth, on_the_globe};

/// Names of variables that hold the bottom, where a file has several over two dimensions.
const BOTTOM_NAMES: [&str; 10] =
    ["elevation", "z", "depth", "topo", "bathymetry", "altitude", "height", "band1", "bathy", "rose"];
/// How metres are written.
const METRES: [&str; 5] = ["m", "metre", "metres", "meter", "meters"];
/// The mend of cells that hold nothing.
const FILL: &str = "fill them, such as with `cdo fillmiss IN.nc OUT.nc`, or cut out a part without such cells";

/// What an axis counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Latitude,
    Longitude,
    Northing,
    Easting,
}

/// Reads a file that begins as NetCDF does.
pub(crate) fn read(bytes: &[u8], faults: &mut Faults) -> Option<Survey> {
    let file = faults.take(Classic::read(bytes))?;
    let bottom = faults.take(bottom(&file))?;
    let sides = [0, 1].map(|i| faults.take(side(&file, bottom, i)));
    let [(north_side, north), (east_side, east)] = match sides {
        [Some(north), Some(east)] => [north, east],
        _ => return None,
    };
    let axes = match (north_side, east_side) {
        (Side::Latitude, Side::Longitude) => {
            on_the_globe(north, east, faults).map(|(north, east)| (Kind::Geodetic, north, east))
        }
        (Side::Northing, Side::Easting) => Some((Kind::Local, north, east)),
        _ => {
            let names = file.dimension_names(bottom).join(", ");
            let message = format!("`{}({names})` runs over {north_side:?} and {east_side:?}", bottom.name);
            let message = message.to_lowercase();
            faults.add(
                message,
                "its rows must run north and its cells east: `ncpdq -a lat,lon IN.nc OUT.nc` exchanges them",
            );
            None
        }
    };
    faults.take(check_size(u64::from(north.count), u64::from(east.count)))?;
    let depths = depths(&file, bottom, east.count, faults);
    let (kind, north, east) = axes?;
    Some(Survey { kind, north, east, depths: depths? })
}

/// The variable that holds the bottom: the only one over two dimensions, else the one with a name for it.
fn bottom<'f, 'a>(file: &'f Classic<'a>) -> Result<&'f Variable<'a>, Fault> {
    let flat: Vec<_> = file.variables.iter().filter(|v| v.dimensions.len() == 2).collect();
    let named = |v: &&&Variable| BOTTOM_NAMES.contains(&v.name.to_ascii_lowercase().as_str());
    let mut meant = flat.iter().filter(named);
    match (flat.as_slice(), meant.next(), meant.next()) {
        ([only], ..) => Ok(only),
        (_, Some(only), None) => Ok(only),
        ([], ..) => {
            let all = file.variables.iter().map(|v| format!("`{}({})`", v.name, file.dimension_names(v).join(", ")));
            let all: Vec<String> = all.take(8).collect();
            let held = if all.is_empty() { "no variables".to_string() } else { all.join(", ") };
            let message = format!("no variable has two dimensions: the file holds {held}");
            Err(Fault::new(
                message,
                "give a grid such as `elevation(lat, lon)`; `ncwa -a time IN.nc OUT.nc` takes a dimension out",
            ))
        }
        (several, ..) => {
            let names: Vec<String> = several.iter().take(8).map(|v| format!("`{}`", v.name)).collect();
            let message = format!("which variable is the bottom? There is {}", names.join(", "));
            Err(Fault::new(message, "take one out with `ncks -v elevation IN.nc OUT.nc`, or name it `elevation`"))
        }
    }
}

/// What a dimension of a variable counts, and its places.
fn side(file: &Classic, bottom: &Variable, dimension: usize) -> Result<(Side, Axis), Fault> {
    let names = file.dimension_names(bottom);
    let name = names.get(dimension).copied().unwrap_or_default();
    let Some(variable) = file.variable(name) else {
        let message = format!("the dimension `{name}` of `{}` has no variable `{name}({name})`", bottom.name);
        return Err(Fault::new(message, "give it its places, in degrees or in metres"));
    };
    if file.dimension_names(variable) != [name] {
        let over = file.dimension_names(variable).join(", ");
        let message = format!("`{name}({over})` does not tell the places of the dimension `{name}`");
        return Err(Fault::new(
            message,
            format!("give a variable `{name}({name})`: an even grid has one place for each row"),
        ));
    }
    let units = variable.text("units").unwrap_or_default().to_ascii_lowercase();
    let lower = name.to_ascii_lowercase();
    let side = match (units.as_str(), lower.as_str()) {
        (units, _) if units.starts_with("degree") && units.ends_with('n') || units.ends_with("north") => Side::Latitude,
        (units, _) if units.starts_with("degree") && units.ends_with('e') || units.ends_with("east") => Side::Longitude,
        ("" | "degrees" | "degree", name) if name.starts_with("lat") => Side::Latitude,
        ("" | "degrees" | "degree", name) if name.starts_with("lon") => Side::Longitude,
        (units, "y" | "north" | "northing") if METRES.contains(&units) => Side::Northing,
        (units, "x" | "east" | "easting") if METRES.contains(&units) => Side::Easting,
        _ => {
            let said = if units.is_empty() { "has no units".to_string() } else { format!("is in `{units}`") };
            let message = format!("`{name}` {said}: it is neither latitude, longitude, nor metres of `y` or `x`");
            let help =
                format!("say it with `ncatted -a units,{name},o,c,degrees_north FILE.nc`, `degrees_east` or `m`");
            return Err(Fault::new(message, help));
        }
    };
    Ok((side, Axis::through(name, &stored(file, variable)?)?))
}

/// The values of a variable with its scale and offset.
fn stored(file: &Classic, variable: &Variable) -> Result<Vec<f64>, Fault> {
    let (scale, offset) = scaling(variable)?;
    let mut values = file.values(variable)?;
    values.iter_mut().for_each(|value| *value = *value * scale + offset);
    Ok(values)
}

fn scaling(variable: &Variable) -> Result<(f64, f64), Fault> {
    let number = |name: &str, default: f64| match variable.numbers(name).as_slice() {
        [] => Ok(default),
        [value] if value.is_finite() && (name == "add_offset" || *value != 0.0) => Ok(*value),
        other => {
            let message = format!("`{}:{name}` is {other:?}", variable.name);
            Err(Fault::new(
                message,
                format!("it must be one number; take it away with `ncatted -a {name},{},d,,`", variable.name),
            ))
        }
    };
    Ok((number("scale_factor", 1.0)?, number("add_offset", 0.0)?))
}

/// The depths of the bottom's variable, all faults of its cells told.
fn depths(file: &Classic, bottom: &Variable, columns: u32, faults: &mut Faults) -> Option<Vec<f64>> {
    let name = bottom.name;
    let units = bottom.text("units").unwrap_or_default();
    if !METRES.contains(&units.to_ascii_lowercase().as_str()) {
        let said = if units.is_empty() { "has no units".to_string() } else { format!("is in `{units}`") };
        let help = format!("convert it, and say so with `ncatted -a units,{name},o,c,m FILE.nc`");
        faults.add(format!("`{name}` {said}: depths are read in metres"), help);
        return None;
    }
    let down = match bottom.text("positive").map(str::to_ascii_lowercase).as_deref() {
        Some("down") => true,
        Some("up") => false,
        None => [name, bottom.text("standard_name").unwrap_or_default()]
            .iter()
            .any(|n| n.to_ascii_lowercase().contains("depth")),
        Some(other) => {
            let help =
                format!("say `up` for elevations, `down` for depths: `ncatted -a positive,{name},o,c,up FILE.nc`");
            faults.add(format!("`{name}:positive` is `{other}`"), help);
            return None;
        }
    };
    let (scale, offset) = faults.take(scaling(bottom))?;
    let raw = faults.take(file.values(bottom))?;
    let mut nothing = bottom.numbers("_FillValue");
    if nothing.is_empty() {
        nothing.extend(bottom.kind.fill());
    }
    nothing.extend(bottom.numbers("missing_value"));
    let sign = if down { 1.0 } else { -1.0 };
    let before = faults.count();
    let mut depths = Vec::with_capacity(raw.len());
    for (i, &value) in raw.iter().enumerate() {
        let depth = 0.0 + sign * (value * scale + offset);
        let place = || format!("`{name}({}, {})`", i / columns as usize, i % columns as usize);
        if !value.is_finite() || nothing.contains(&value) {
            faults.add(format!("{} is no data ({value})", place()), FILL);
        } else if !is_on_earth(depth) {
            let help = "if it stands for no data, give it to `missing_value` and fill it; if the unit is not metres, convert it";
            faults.add(format!("{} is {value}: neither water nor land on earth", place()), help);
        }
        depths.push(depth);
    }
    (faults.count() == before).then_some(depths)
}
