//! GeoJSON (RFC 7946): its polygons, wherever they stand. Positions are longitude, latitude, and maybe a height, in degrees on
//! WGS 84 (section 4).

use super::json::Json;
use super::{Contents, Name, Polygon, Position, fault, opened, shortened};
use crate::FileFault;
use serde_json::Value;

/// The kinds of geometry that are no areas (section 1.4).
const OTHERS: [&str; 4] = ["Point", "MultiPoint", "LineString", "MultiLineString"];

/// How positions in degrees on WGS 84, the longitude first, are called where they are called anything.
const WGS_84: [&str; 5] = ["CRS84", "CRS84H", "WGS84", "4326", "4979"];

/// The polygons of a text.
pub(super) fn contents(text: &str) -> Result<Contents, FileFault> {
    let Json(value) = serde_json::from_str(text)
        .map_err(|error| fault(format!("this is no JSON: {error}"), "export the area again as GeoJSON"))?;
    let mut contents = Contents::default();
    object(&value, "", None, &mut contents)?;
    Ok(contents)
}

/// An object of any kind, at a path such as `features[2].geometry`, of a feature of a name.
fn object(value: &Value, path: &str, name: Option<&Name>, into: &mut Contents) -> Result<(), FileFault> {
    let at = |member: &str| if path.is_empty() { member.to_string() } else { format!("{path}.{member}") };
    let list = |member: &str| {
        let list = value.get(member).and_then(Value::as_array);
        list.ok_or_else(|| missing(&at(member), "is no list"))
    };
    on_wgs_84(value)?;
    match value.get("type").and_then(Value::as_str) {
        Some("FeatureCollection") => {
            for (i, feature) in list("features")?.iter().enumerate() {
                object(feature, &format!("{}[{i}]", at("features")), None, into)?;
            }
        }
        Some("Feature") => match value.get("geometry") {
            // A feature may have no place (section 3.2).
            None | Some(Value::Null) => {}
            Some(geometry) => {
                let name = value.get("properties").and_then(|properties| properties.get("name")?.as_str());
                let name = name.map(|name| Name(name.into()));
                object(geometry, &at("geometry"), name.as_ref(), into)?;
            }
        },
        Some("GeometryCollection") => {
            for (i, geometry) in list("geometries")?.iter().enumerate() {
                object(geometry, &format!("{}[{i}]", at("geometries")), name, into)?;
            }
        }
        Some("Polygon") => into.polygons.push(polygon(list("coordinates")?, &at("coordinates"), name)?),
        Some("MultiPolygon") => {
            for (i, rings) in list("coordinates")?.iter().enumerate() {
                let place = format!("{}[{i}]", at("coordinates"));
                let rings = rings.as_array().ok_or_else(|| missing(&place, "is no list of rings"))?;
                into.polygons.push(polygon(rings, &place, name)?);
            }
        }
        Some(other) if OTHERS.contains(&other) => _ = into.others.insert(other.to_string()),
        Some(other) => {
            return Err(missing(&at("type"), &format!("is `{}`, which is no kind of GeoJSON", shortened(other))));
        }
        None => return Err(missing(&at("type"), "is missing")),
    }
    Ok(())
}

/// Before RFC 7946 a file could name another system of coordinates (GeoJSON 2008, section 3): its numbers are no degrees then,
/// or not these.
fn on_wgs_84(value: &Value) -> Result<(), FileFault> {
    let Some(system) = value.get("crs").filter(|system| !system.is_null()) else { return Ok(()) };
    let name = system.get("properties").and_then(|properties| properties.get("name")?.as_str());
    let code = name.and_then(|name| name.rsplit([':', '/', '#']).next()).map(str::to_ascii_uppercase);
    if code.is_some_and(|code| WGS_84.contains(&code.replace(' ', "").as_str())) {
        return Ok(());
    }
    let said = name.map_or("a system that it does not name".to_string(), |name| format!("`{}`", shortened(name)));
    let message = format!("by its `crs` its positions are those of {said}, and areas are read in degrees on WGS 84");
    Err(fault(message, "convert it with `ogr2ogr -t_srs EPSG:4326 OUT.geojson IN.geojson`"))
}

/// A polygon: its outline first, then its holes (section 3.1.6).
fn polygon(rings: &[Value], place: &str, name: Option<&Name>) -> Result<Polygon, FileFault> {
    let corners = ring(rings.first().unwrap_or(&Value::Null), &format!("{place}[0]"))?;
    let holes = rings.iter().enumerate().skip(1).map(|(i, hole)| ring(hole, &format!("{place}[{i}]")));
    let holes = holes.collect::<Result<_, FileFault>>()?;
    Ok(Polygon { name: name.cloned(), place: format!("`{place}`"), corners, holes })
}

/// The corners of a ring.
fn ring(positions: &Value, place: &str) -> Result<Vec<Position>, FileFault> {
    let positions = positions.as_array().ok_or_else(|| missing(place, "is no list of positions"))?;
    let corner = |(i, value): (usize, &Value)| {
        position(value)
            .ok_or_else(|| missing(&format!("{place}[{i}]"), "is not a longitude, a latitude and perhaps a height"))
    };
    positions.iter().enumerate().map(corner).collect::<Result<_, FileFault>>().map(opened)
}

/// More numbers than three (section 3.1.1 lets readers ignore them) are two positions that run together.
fn position(value: &Value) -> Option<Position> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
    match numbers?[..] {
        [longitude, latitude] | [longitude, latitude, _] => {
            Some(Position { latitude_deg: latitude, longitude_deg: longitude })
        }
        _ => None,
    }
}

fn missing(path: &str, what: &str) -> FileFault {
    fault(format!("`{path}` {what}"), "export the area again as GeoJSON, in WGS 84 (RFC 7946)")
}
