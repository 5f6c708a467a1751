//! Surveys in NetCDF, by the COARDS and CF conventions.
//!
//! The depths are a variable over two dimensions that have variables of their own: `lat` and `lon` in degrees, or `y` and `x`
//! in metres, by their units or else their names. Elevations are negative below the surface; depths, by name or by the
//! attribute `positive = "down"`, are positive. What a stored number stands for, [`mod@packing`] tells.

mod packing;

use crate::fault::{Fault, Faults, compact, listed, shortened};
use crate::survey::axis::Axis;
use crate::survey::classic::{Classic, Variable};
use crate::survey::grid::{Kind, Survey, check_size, check_water, going_on, is_on_earth, on_a_plane, on_the_globe};
use crate::survey::marks;
use packing::Packing;

/// Names of variables that hold the bottom, where a file has several over two dimensions.
const BOTTOM_NAMES: [&str; 10] =
    ["elevation", "z", "depth", "topo", "bathymetry", "altitude", "height", "band1", "bathy", "rose"];
/// How metres are written.
const METRES: [&str; 5] = ["m", "metre", "metres", "meter", "meters"];
/// How degrees of latitude and of longitude are written (CF 1.11, sections 4.1 and 4.2), in lower case; and degrees of either,
/// which the name tells apart.
const NORTH: [&str; 6] = ["degrees_north", "degree_north", "degree_n", "degrees_n", "degreen", "degreesn"];
const EAST: [&str; 6] = ["degrees_east", "degree_east", "degree_e", "degrees_e", "degreee", "degreese"];
const EITHER: [&str; 4] = ["", "degree", "degrees", "deg"];
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
        (Side::Northing, Side::Easting) => {
            on_a_plane(north, east, faults).map(|(north, east)| (Kind::Local, north, east))
        }
        _ => {
            let (name, names) = (shortened(bottom.name), listed(file.dimension_names(bottom)));
            let over = format!("{north_side:?} and {east_side:?}").to_lowercase();
            faults.add(
                format!("`{name}({names})` runs over {over}"),
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
            let named = |v: &Variable| format!("`{}({})`", shortened(v.name), listed(file.dimension_names(v)));
            let all: Vec<String> = file.variables.iter().take(8).map(named).collect();
            let held = if all.is_empty() { "no variables".to_string() } else { all.join(", ") };
            let message = format!("no variable has two dimensions: the file holds {held}");
            Err(Fault::new(
                message,
                "give a grid such as `elevation(lat, lon)`; `ncwa -a time IN.nc OUT.nc` takes a dimension out",
            ))
        }
        (several, ..) => {
            let names: Vec<String> = several.iter().take(8).map(|v| format!("`{}`", shortened(v.name))).collect();
            let message = format!("which variable is the bottom? There is {}", names.join(", "));
            Err(Fault::new(message, "take one out with `ncks -v elevation IN.nc OUT.nc`, or name it `elevation`"))
        }
    }
}

/// What a dimension of a variable counts, and its places.
fn side(file: &Classic, bottom: &Variable, dimension: usize) -> Result<(Side, Axis), Fault> {
    let names = file.dimension_names(bottom);
    let name = names.get(dimension).copied().unwrap_or_default();
    let short = shortened(name);
    let Some(variable) = file.variable(name) else {
        let bottom = shortened(bottom.name);
        let message = format!("the dimension `{short}` of `{bottom}` has no variable `{short}({short})`");
        return Err(Fault::new(message, "give it its places, in degrees or in metres"));
    };
    if file.dimension_names(variable) != [name] {
        let over = listed(file.dimension_names(variable));
        let message = format!("`{short}({over})` does not tell the places of the dimension `{short}`");
        return Err(Fault::new(
            message,
            format!("give a variable `{short}({short})`: an even grid has one place for each row"),
        ));
    }
    let units = variable.text("units").unwrap_or_default().to_ascii_lowercase();
    let lower = name.to_ascii_lowercase();
    let side = match (units.as_str(), lower.as_str()) {
        (units, _) if NORTH.contains(&units) => Side::Latitude,
        (units, _) if EAST.contains(&units) => Side::Longitude,
        (units, name) if EITHER.contains(&units) && name.starts_with("lat") => Side::Latitude,
        (units, name) if EITHER.contains(&units) && name.starts_with("lon") => Side::Longitude,
        (units, "y" | "north" | "northing") if METRES.contains(&units) => Side::Northing,
        (units, "x" | "east" | "easting") if METRES.contains(&units) => Side::Easting,
        _ => {
            let said = said_units(&units);
            let message = format!("`{short}` {said}: it is neither latitude, longitude, nor metres of `y` or `x`");
            let help =
                format!("say it with `ncatted -a units,{short},o,c,degrees_north FILE.nc`, `degrees_east` or `m`");
            return Err(Fault::new(message, help));
        }
    };
    let packing = Packing::of(variable)?;
    let mut places = file.values(variable)?;
    places.iter_mut().for_each(|place| *place = packing.value(*place));
    if side == Side::Longitude {
        going_on(&mut places);
    }
    Ok((side, Axis::through(name, &places)?))
}

/// What a variable says of its units, for a message.
fn said_units(units: &str) -> String {
    if units.is_empty() { "has no units".to_string() } else { format!("is in `{}`", shortened(units)) }
}

/// The depths of the bottom's variable, all faults of its cells told.
fn depths(file: &Classic, bottom: &Variable, columns: u32, faults: &mut Faults) -> Option<Vec<f64>> {
    let name = &shortened(bottom.name);
    let units = bottom.text("units").unwrap_or_default();
    if !METRES.contains(&units.to_ascii_lowercase().as_str()) {
        let help = format!("convert it, and say so with `ncatted -a units,{name},o,c,m FILE.nc`");
        faults.add(format!("`{name}` {}: depths are read in metres", said_units(units)), help);
        return None;
    }
    let down = match bottom.text("positive").map(str::to_ascii_lowercase).as_deref() {
        Some("down") => true,
        Some("up") => false,
        None => [bottom.name, bottom.text("standard_name").unwrap_or_default()]
            .iter()
            .any(|n| n.to_ascii_lowercase().contains("depth")),
        Some(other) => {
            let help =
                format!("say `up` for elevations, `down` for depths: `ncatted -a positive,{name},o,c,up FILE.nc`");
            faults.add(format!("`{name}:positive` is `{}`", shortened(other)), help);
            return None;
        }
    };
    let packing = faults.take(Packing::of(bottom))?;
    let stored = faults.take(file.values(bottom))?;
    let sign = if down { 1.0 } else { -1.0 };
    let before = faults.count();
    let place = |i: usize| format!("`{name}({}, {})`", i / columns as usize, i % columns as usize);
    let mut depths = Vec::with_capacity(stored.len());
    for (i, &value) in stored.iter().enumerate() {
        let depth = 0.0 + sign * packing.value(value);
        let fault = if packing.is_nothing(value) {
            Some((format!("{} is no data ({})", place(i), compact(value)), FILL.to_string()))
        } else if packing.is_invalid(value) {
            Some((format!("{} is no data: {} is outside its valid range", place(i), compact(value)), FILL.to_string()))
        } else if !is_on_earth(depth) {
            let help = "if it stands for no data, give it to `missing_value` and fill it; if the unit is not metres, convert it";
            Some((format!("{} is {}: neither water nor land on earth", place(i), compact(value)), help.to_string()))
        } else {
            None
        };
        depths.push(if fault.is_some() { f64::NAN } else { depth });
        fault.into_iter().for_each(|(message, help)| faults.add(message, help));
    }
    if !packing.is_bounded() {
        // A mark may be one as it is stored, or as it is meant.
        let is_mark = |cell: usize| marks::is_mark(stored[cell]) || marks::is_mark(depths[cell]);
        let apart = marks::undeclared(&depths, columns as usize, is_mark);
        for (i, value) in stored.iter().enumerate().filter(|(i, _)| apart[*i]) {
            let value = compact(*value);
            faults.add(
                format!("{} is {value}: far from the cells about it, as a mark for no data is", place(i)),
                format!(
                    "if it is one, say so with `ncatted -a _FillValue,{name},o,{},{value} FILE.nc`, and {FILL}; if the \
                     water is so deep, give `{name}` a `valid_range`",
                    bottom.kind.letter()
                ),
            );
        }
    }
    let turned = format!("give the variable `positive = \"{}\"`", if down { "up" } else { "down" });
    check_water(&depths, down, &turned, faults);
    (faults.count() == before).then_some(depths)
}
