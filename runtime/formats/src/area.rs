//! Areas that charting programs save: the polygons of a GeoJSON or KML file, and the one of them that a script means.

mod corners;
mod geojson;
mod json;
mod kml;

use crate::FileFault;
use albacore_wording::{listed, nearest};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::rc::Rc;

/// A file larger than this, in bytes, is refused: an area has few corners.
pub const BYTES_MAX: u64 = 4_000_000;

/// What is said where latitude and longitude seem to have changed places.
pub const SWAPPED: &str = "latitude and longitude seem to be swapped: GeoJSON and KML want the longitude first";

/// The mend of polygons of one name, or of several in one feature.
const APART: &str = "give each polygon a feature and a name of its own";

/// The mend of an area in two parts, on both sides of 180 degrees.
const JOIN: &str = "they were cut at 180 degrees: join them in one polygon without the corners there; one longitude may be 179.9 and \
     the next -179.9";

/// So many names are listed in a message at most.
const LISTED_MAX: usize = 12;

/// So many characters of a file's own text stand in a message at most.
const QUOTED_MAX: usize = 60;

/// A position on the globe (WGS 84), in degrees; north and east are positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// Its latitude.
    pub latitude_deg: f64,
    /// Its longitude.
    pub longitude_deg: f64,
}

/// The name of a feature, which all its polygons have in common. A message shows no more of it than its beginning.
#[derive(Clone, Debug, PartialEq)]
struct Name(Rc<str>);

/// A polygon of a file.
#[derive(Clone, Debug, PartialEq)]
struct Polygon {
    /// The name of the feature that it belongs to.
    name: Option<Name>,
    /// Where it stands in its file: `line 12`, or a path such as `features[0].geometry`.
    place: String,
    /// Its corners, each once.
    corners: Vec<Position>,
    /// The corners of its holes.
    holes: Vec<Vec<Position>>,
}

/// A ring of a polygon, which is an area: its outline, or one of its holes.
#[derive(Debug)]
pub struct Ring {
    /// Its corners, each once.
    pub corners: Vec<Position>,
    /// The polygon, as messages call it.
    pub polygon: String,
    /// How many holes the polygon has.
    pub holes: usize,
}

/// What a file holds.
#[derive(Debug, Default)]
struct Contents {
    polygons: Vec<Polygon>,
    /// The kinds of what it holds beside polygons, such as `LineString`.
    others: BTreeSet<String>,
}

/// The area that is meant: a file's only polygon, or the one of a name; its outline, or the hole of a number, from 1.
pub fn area(path: &str, bytes: &[u8], named: Option<&str>, hole: Option<usize>) -> Result<Ring, Vec<FileFault>> {
    let in_file = |fault: FileFault| FileFault { message: format!("`{path}`: {}", fault.message), ..fault };
    let one = |fault| vec![in_file(fault)];
    let contents = contents(path, bytes).map_err(one)?;
    let polygon = choose(path, &contents, named).map_err(one)?;
    let what = match &polygon.name {
        Some(name) => format!("the polygon `{name}`, {},", polygon.place),
        None => format!("the polygon at {}", polygon.place),
    };
    let (corners, ring) = match hole {
        None => (Some(&polygon.corners), what.clone()),
        Some(number) => (polygon.holes.get(number.wrapping_sub(1)), format!("hole {number} of {what}")),
    };
    let corners = corners.ok_or_else(|| one(no_hole(&what, polygon.holes.len())))?;
    corners::sound(corners, &ring).map_err(|faults| faults.into_iter().map(in_file).collect::<Vec<_>>())?;
    if let Some(corner) = hole.and_then(|_| corners::outside(corners, &polygon.corners)) {
        let message = format!("{ring} lies outside the outline, with its corner {}", corner + 1);
        let help = "a hole lies within: correct its corners, or give it a feature of its own and read it by its name";
        return Err(one(fault(message, help)));
    }
    Ok(Ring { corners: corners.clone(), polygon: what, holes: polygon.holes.len() })
}

/// A hole is asked for that is not there.
fn no_hole(what: &str, holes: usize) -> FileFault {
    match holes {
        0 => fault(format!("{what} has no hole"), "leave out `hole`"),
        1 => fault(format!("{what} has one hole"), "write `hole: 1`"),
        _ => fault(format!("{what} has {holes} holes"), format!("write a number from 1 to {holes}")),
    }
}

/// The outline of a polygon is read, and not all of its holes: whoever works in the one must know of the others.
pub fn unread(path: &str, named: Option<&str>, ring: &Ring, unread: &[usize]) -> FileFault {
    let what = &ring.polygon;
    let numbers: Vec<String> = unread.iter().take(LISTED_MAX).map(usize::to_string).collect();
    let more = if unread.len() > LISTED_MAX { ", …" } else { "" };
    let (numbers, first) = (numbers.join(", ") + more, unread.first().copied().unwrap_or(1));
    let message = match ring.holes {
        1 => format!("`{path}`: {what} has a hole that is read nowhere, and an area is whole"),
        _ => format!("`{path}`: {what} has holes that are read nowhere, and an area is whole: {numbers}"),
    };
    let named = named.map_or(String::new(), |name| format!("named: \"{name}\", "));
    let help = format!(
        "read it as an area of its own, and keep out of it: `const hole_{first} = area_file(\"{path}\", {named}hole: {first})`, \
         `no_go(\"hole {first}\", hole_{first})` in the scenario, `safety.keep_out(hole_{first})` in the mission"
    );
    fault(message, help)
}

/// What a file holds, by the ending of its name.
fn contents(path: &str, bytes: &[u8]) -> Result<Contents, FileFault> {
    let ending = path.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase()).unwrap_or_default();
    let read = match ending.as_str() {
        "geojson" | "json" => geojson::contents,
        "kml" => kml::contents,
        "kmz" => return Err(fault("this is a packed KML", "unpack it, as a ZIP is, and name the KML that is in it")),
        _ => {
            let what = "areas are read from files that end in `.geojson`, `.json` or `.kml`";
            return Err(fault(what, "save the area as GeoJSON in WGS 84"));
        }
    };
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].iter().filter(|&&b| b == b'\n').count() + 1;
        fault(format!("line {line} is no text in UTF-8"), "save it as UTF-8")
    })?;
    read(text.trim_start_matches('\u{feff}'))
}

/// The polygon that is meant.
fn choose<'c>(path: &str, contents: &'c Contents, named: Option<&str>) -> Result<&'c Polygon, FileFault> {
    let polygons = &contents.polygons;
    let names: Vec<&str> = polygons.iter().filter_map(|polygon| polygon.name.as_deref()).collect();
    if polygons.is_empty() {
        let others: Vec<&str> = contents.others.iter().map(String::as_str).collect();
        let what = if others.is_empty() { "nothing".to_string() } else { format!("only {}", others.join(", ")) };
        let help = "draw the area as a polygon, not as a line or as points, and save it again";
        return Err(fault(format!("there is no polygon in it, {what}"), help));
    }
    let Some(named) = named else {
        return match polygons.as_slice() {
            [only] => Ok(only),
            _ => Err(fault(
                format!("there are {} polygons in it{}", polygons.len(), in_all(&names)),
                match only_once(&names) {
                    _ if are_halves(polygons.iter()) => JOIN.to_string(),
                    Some(name) => format!("say which by its name: `area_file(\"{path}\", named: \"{name}\")`"),
                    None if names.is_empty() => {
                        "give each a `name`, and say which is meant: `area_file(…, named: \"…\")`".to_string()
                    }
                    None => format!("{APART}, and say which is meant: `area_file(…, named: \"…\")`"),
                },
            )),
        };
    };
    let found: Vec<&Polygon> = polygons.iter().filter(|polygon| polygon.name.as_deref() == Some(named)).collect();
    match found.as_slice() {
        [only] => Ok(only),
        [] => Err(fault(
            format!("there is no polygon named `{named}` in it{}", in_all(&names)),
            match (nearest(named, names.iter().copied().filter(|name| is_short(name))), polygons.len()) {
                (Some(near), _) => format!("did you mean `{near}`?"),
                (None, 1) => "leave out `named`: there is one polygon only".to_string(),
                (None, _) if names.is_empty() => "give the polygon that is meant a `name`".to_string(),
                (None, _) => "use one of these names".to_string(),
            },
        )),
        several => {
            let places: Vec<&str> = several.iter().map(|polygon| polygon.place.as_str()).collect();
            let places = places[..places.len().min(LISTED_MAX)].join(", ");
            Err(fault(
                format!("{} polygons are named `{named}`: {places}", several.len()),
                if are_halves(several.iter().copied()) { JOIN } else { APART },
            ))
        }
    }
}

/// A name that one polygon has and no other, short enough for a message.
fn only_once<'n>(names: &[&'n str]) -> Option<&'n str> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    names.iter().for_each(|name| *counts.entry(name).or_default() += 1);
    names.iter().copied().find(|name| is_short(name) && counts.get(name) == Some(&1))
}

/// Whether polygons are what was one, cut at 180 degrees as RFC 7946 (section 3.1.9) wants it: all touch that meridian, from both sides.
fn are_halves<'p>(polygons: impl Iterator<Item = &'p Polygon>) -> bool {
    let (mut sides, mut all) = ([false; 2], true);
    for polygon in polygons {
        let touches = |at: f64| polygon.corners.iter().any(|corner| corner.longitude_deg == at);
        let touched = [touches(-180.0), touches(180.0)];
        all &= touched != [false; 2];
        sides = [sides[0] || touched[0], sides[1] || touched[1]];
    }
    all && sides == [true; 2]
}

/// The names that there are.
fn in_all(names: &[&str]) -> String {
    let told: Vec<String> = names.iter().take(LISTED_MAX).map(|name| shortened(name)).collect();
    match names.len().checked_sub(LISTED_MAX) {
        _ if names.is_empty() => ", none with a name".to_string(),
        None | Some(0) => format!(": {}", listed(&told.iter().map(String::as_str).collect::<Vec<_>>())),
        Some(more) => format!(": {} and {more} more", told.join(", ")),
    }
}

/// The corners of a ring, without the last position that closes it.
fn opened(mut ring: Vec<Position>) -> Vec<Position> {
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

/// The beginning of a file's own text, for a message: whoever made the file made it as long as it pleased.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(QUOTED_MAX) {
        None => text.to_string(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

/// Whether a text stands in a message as it is.
fn is_short(text: &str) -> bool {
    text.char_indices().nth(QUOTED_MAX).is_none()
}

impl std::ops::Deref for Name {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&shortened(&self.0))
    }
}

fn fault(message: impl Into<String>, help: impl Into<String>) -> FileFault {
    FileFault { message: message.into(), help: Some(help.into()) }
}

#[cfg(test)]
mod tests;
