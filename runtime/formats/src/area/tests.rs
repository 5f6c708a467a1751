use super::*;

/// A GeoJSON of features, each with its properties and geometry.
fn geojson(features: &[(&str, &str)]) -> String {
    let feature = |(properties, geometry): &(&str, &str)| {
        format!(r#"{{"type": "Feature", "properties": {properties}, "geometry": {geometry}}}"#)
    };
    let features: Vec<String> = features.iter().map(feature).collect();
    format!(r#"{{"type": "FeatureCollection", "features": [{}]}}"#, features.join(", "))
}

/// A polygon of GeoJSON with this outline, of positions `longitude, latitude`.
fn outline(positions: &[(f64, f64)]) -> String {
    let positions: Vec<String> = positions.iter().map(|(x, y)| format!("[{x}, {y}]")).collect();
    format!(r#"{{"type": "Polygon", "coordinates": [[{}]]}}"#, positions.join(", "))
}

const SQUARE: [(f64, f64); 5] = [(-75.75, 36.18), (-75.74, 36.18), (-75.74, 36.19), (-75.75, 36.19), (-75.75, 36.18)];

fn kml(body: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>\n{body}\n</Document></kml>"
    )
}

fn placemark(name: &str, coordinates: &str) -> String {
    format!(
        "<Placemark><name>{name}</name><Polygon>\n<outerBoundaryIs><LinearRing><coordinates>\n{coordinates}\n\
         </coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>"
    )
}

const KML_SQUARE: &str = "-75.75,36.18,0 -75.74,36.18,0\n-75.74,36.19,0 -75.75,36.19,0 -75.75,36.18,0";

fn read(path: &str, text: &str, named: Option<&str>) -> Result<Vec<Position>, Vec<FileFault>> {
    area(path, text.as_bytes(), named, None).map(|ring| ring.corners)
}

/// The file is refused with one message, that begins with the file's name; the help holds this.
#[track_caller]
fn refused(path: &str, text: &str, named: Option<&str>, message: &str, help: &str) {
    let faults = read(path, text, named).unwrap_err();
    assert_eq!(faults.len(), 1, "{faults:#?}");
    assert_eq!(faults[0].message, format!("`{path}`: {message}"));
    assert!(faults[0].help.as_ref().unwrap().contains(help), "{faults:#?}");
}

/// A GeoJSON with one polygon of this outline is refused.
#[track_caller]
fn misshapen(positions: &[(f64, f64)], message: &str, help: &str) {
    let message = message.replace("POLYGON", "the polygon `box`, `features[0].geometry.coordinates`,");
    refused("a.geojson", &geojson(&[(r#"{"name": "box"}"#, &outline(positions))]), None, &message, help);
}

#[test]
fn both_formats_give_the_same_corners_each_once() {
    let corners: Vec<Position> =
        SQUARE[..4].iter().map(|&(x, y)| Position { latitude_deg: y, longitude_deg: x }).collect();
    assert_eq!(read("a.geojson", &geojson(&[("null", &outline(&SQUARE))]), None).unwrap(), corners);
    assert_eq!(read("a.kml", &kml(&placemark("box", KML_SQUARE)), None).unwrap(), corners);
    // A geometry alone, a file that begins with a byte order mark, an outline that is not closed.
    assert_eq!(read("a.json", &format!("\u{feff}{}", outline(&SQUARE[..4])), None).unwrap(), corners);
    // A comment between the coordinates, and a folder round the placemark.
    let commented = KML_SQUARE.replacen('\n', "\n<!-- east -->\n", 1);
    let inner = format!("<Folder><name>areas</name>{}</Folder>", placemark("box", &commented));
    assert_eq!(read("a.KML", &kml(&inner), Some("box")).unwrap(), corners);
}

#[test]
fn of_several_polygons_one_is_chosen_by_its_name() {
    let far = outline(&SQUARE.map(|(x, y)| (x + 1.0, y)));
    let point = r#"{"type": "Point", "coordinates": [0, 0]}"#;
    let square = outline(&SQUARE);
    let two = geojson(&[(r#"{"name": "box"}"#, &square), (r#"{"name": "pier"}"#, &far), ("{}", point), ("{}", "null")]);
    assert_eq!(read("a.geojson", &two, Some("pier")).unwrap()[0].longitude_deg, -74.75);
    let help = "`area_file(\"a.geojson\", named: \"box\")`";
    refused("a.geojson", &two, None, "there are 2 polygons in it: `box` and `pier`", help);
    let none = "there is no polygon named `peer` in it: `box` and `pier`";
    refused("a.geojson", &two, Some("peer"), none, "did you mean `pier`?");
    let unnamed = geojson(&[("{}", &square), ("null", &far)]);
    refused("a.geojson", &unnamed, None, "there are 2 polygons in it, none with a name", "give each a `name`");
    let alone = geojson(&[("{}", &square)]);
    let none = "there is no polygon named `box` in it, none with a name";
    refused("a.geojson", &alone, Some("box"), none, "leave out `named`");
    let places = kml(&[placemark("box", KML_SQUARE), placemark("box", KML_SQUARE)].join("\n"));
    refused("a.kml", &places, Some("box"), "2 polygons are named `box`: line 3, line 8", "a name of its own");
    let rings = square.replacen("Polygon", "MultiPolygon", 1).replace("[[[", "[[[[").replace("]]]", "]]]]");
    assert_eq!(read("a.geojson", &geojson(&[("{}", &rings)]), None).unwrap().len(), 4);
}

#[test]
fn a_file_that_is_no_chart_is_told_with_its_line() {
    let text = "{\"type\": \"Polygon\",\n  \"coordinates\": [[1, 2,]]}";
    refused("a.geojson", text, None, "this is no JSON: trailing comma at line 2 column 25", "export");
    let text = kml("<Placemark>\n</Folder>");
    let faults = read("a.kml", &text, None).unwrap_err();
    assert!(
        faults[0].message.starts_with("`a.kml`: this is no XML: ") && faults[0].message.contains("4:"),
        "{faults:?}"
    );
    refused("a.kml", "<gpx/>", None, "its outermost element is `gpx`, not `kml`", "export");
    refused("a.kmz", "PK", None, "this is a packed KML", "unpack it");
    let endings = "areas are read from files that end in `.geojson`, `.json` or `.kml`";
    refused("a.shp", "", None, endings, "save the area as GeoJSON");
    refused("a", "", None, endings, "save the area as GeoJSON");
    let faults = area("a.json", b"{\n\xff}", None, None).unwrap_err();
    assert_eq!(faults[0].message, "`a.json`: line 2 is no text in UTF-8");
    // Entities that multiply are never expanded.
    let bomb = "<!DOCTYPE kml [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><kml>&b;</kml>";
    assert!(read("a.kml", bomb, None).unwrap_err()[0].message.contains("this is no XML"));
    // Nor does deep nesting end the reader.
    assert!(read("a.json", &"[".repeat(100_000), None).unwrap_err()[0].message.contains("recursion limit"));
    let deep = format!("{}{}", "<kml>".repeat(50_000), "</kml>".repeat(50_000));
    assert!(read("a.kml", &deep, None).is_err());
}

#[test]
fn what_is_no_polygon_is_told_with_its_place() {
    let line = r#"{"type": "LineString", "coordinates": [[0, 0], [1, 1]]}"#;
    refused("a.json", &geojson(&[]), None, "there is no polygon in it, nothing", "as a polygon");
    refused("a.json", &geojson(&[("{}", line)]), None, "there is no polygon in it, only LineString", "as a polygon");
    let track = "<Placemark><LineString><coordinates>0,0 1,1</coordinates></LineString></Placemark>";
    refused("a.kml", &kml(track), None, "there is no polygon in it, only LineString", "as a polygon");
    let help = "export the area again";
    refused("a.json", "[]", None, "`type` is missing", help);
    refused("a.json", r#"{"type": "Topology"}"#, None, "`type` is `Topology`, which is no kind of GeoJSON", help);
    refused("a.json", r#"{"type": "FeatureCollection"}"#, None, "`features` is no list", help);
    let empty = geojson(&[("{}", r#"{"type": "Polygon", "coordinates": []}"#)]);
    let place = "`features[0].geometry.coordinates[0]` is no list of positions";
    refused("a.json", &empty, None, place, help);
    let place = "`features[0].geometry.coordinates[0][1]` is not a longitude, a latitude and perhaps a height";
    for wrong in [r#"0, "1""#, "0", "0, 1, null", "0, 1, 0, 1", "0, 1, 0, 0, 1, 0"] {
        let ring = format!(r#"{{"type": "Polygon", "coordinates": [[[0, 0], [{wrong}]]]}}"#);
        refused("a.json", &geojson(&[("{}", &ring)]), None, place, help);
    }
    let twice = r#"{"type": "Polygon", "coordinates": [], "coordinates": []}"#;
    let message = "this is no JSON: `coordinates` stands twice in one object at line 1 column 57";
    refused("a.json", twice, None, message, help);
    let flat = r#"{"type": "GeometryCollection", "geometries": [{"type": "MultiPolygon", "coordinates": [1]}]}"#;
    refused("a.json", flat, None, "`geometries[0].coordinates[0]` is no list of rings", help);
    for tuple in
        ["-75.74;36.18", "-75.738,36.182,0,-75.742,36.182,0", "-75.738,36.182,-75.742,36.182", "-75.74,36.18,nan"]
    {
        let said =
            format!("line 4: `{tuple}` is not a longitude, a latitude and perhaps a height with commas between them");
        refused("a.kml", &kml(&placemark("box", tuple)), None, &said, help);
    }
    let hollow = "line 3: this polygon has no outline with `coordinates`";
    refused("a.kml", &kml("<Placemark><Polygon/></Placemark>"), None, hollow, help);
    let square = placemark("box", KML_SQUARE);
    let twice = |from: &str, to: &str| {
        let (begin, end) = (square.find(from).unwrap(), square.rfind(to).unwrap() + to.len());
        kml(&format!("{}{}{}", &square[..end], &square[begin..end], &square[end..]))
    };
    refused(
        "a.kml",
        &twice("<outerBoundaryIs>", "</outerBoundaryIs>"),
        None,
        "line 7: this polygon has two outlines",
        help,
    );
    let two_names = "line 3: this placemark has two names";
    refused("a.kml", &twice("<name>", "</name>"), None, two_names, help);
    let two = "line 7: this outline has two rings";
    refused("a.kml", &twice("<LinearRing>", "</LinearRing>"), None, two, help);
    let broken = KML_SQUARE.replacen("36.18", "36.1<br/>8", 1);
    let inside = "line 5: `coordinates` holds something else than positions";
    refused("a.kml", &kml(&placemark("box", &broken)), None, inside, help);
    refused(
        "a.kml",
        &twice("<coordinates>", "</coordinates>"),
        None,
        "line 7: this ring has `coordinates` twice",
        help,
    );
}

#[test]
fn corners_that_make_no_area_are_told_one_by_one() {
    misshapen(&SQUARE[..2], "POLYGON has 2 corners, and an area needs at least 3", "add what is missing");
    let round: Vec<(f64, f64)> = (0..1025)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 1025.0)
        .map(|a| (albacore_geometry::math::sin(a), albacore_geometry::math::cos(a)))
        .collect();
    misshapen(&round, "POLYGON has 1025 corners, and an area has at most 1024", "simplify its outline");
    let exchanged = SQUARE.map(|(x, y)| (y, x - 20.0));
    let beyond = "corner 1 of POLYGON has latitude -95.75 and longitude 36.18";
    misshapen(&exchanged, beyond, "the longitude first");
    let metres = SQUARE.map(|(x, y)| (x * 1e4, y * 1e4));
    let beyond = "corner 1 of POLYGON has latitude 361800 and longitude -757500";
    misshapen(&metres, beyond, "degrees on WGS 84");
    let wide = [(0.0, 0.0), (8.0, 0.0), (8.0, 0.1), (0.0, 0.1)];
    misshapen(
        &wide,
        "a corner of POLYGON lies 446 km from its middle, and no plane reaches farther than 100 km",
        "smaller areas",
    );
    let bow = [SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]];
    misshapen(&bow, "the outline of POLYGON crosses itself, after corners 1 and 3", "in their order");
    let twice = [SQUARE[0], SQUARE[1], SQUARE[1], SQUARE[2]];
    misshapen(&twice, "corners 2 and 3 of POLYGON are in one place", "leave one of them out");
    // A dent is none, whichever way round the outline goes, unless it reaches the side that is opposite.
    let mut dented = vec![SQUARE[0], SQUARE[1], SQUARE[2], (-75.745, 36.185), SQUARE[3]];
    assert!(read("a.geojson", &geojson(&[("{}", &outline(&dented))]), None).is_ok());
    dented.reverse();
    assert!(read("a.geojson", &geojson(&[("{}", &outline(&dented))]), None).is_ok());
    dented[1].1 = SQUARE[0].1;
    misshapen(&dented, "the outline of POLYGON crosses itself, after corners 1 and 4", "in their order");
    let flat = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)];
    misshapen(&flat, "the corners of POLYGON lie on one line", "draw it as a polygon");
}

#[test]
fn slivers_and_what_goes_round_a_pole_are_no_areas() {
    let sliver = [(-75.75, 36.18), (-75.74, 36.18), (-75.745, 36.180005)];
    misshapen(&sliver, "POLYGON is 0.54 m wide where it is thinnest, and no area is thinner than 1 m", "on one line");
    let round = [(0.0, 89.999), (120.0, 89.999), (-120.0, 89.999)];
    misshapen(&round, "POLYGON goes round a pole, where no longitude is its middle", "cut it into areas");
    let beside = [(170.0, 89.5), (-170.0, 89.5), (180.0, 89.6)];
    assert!(read("a.geojson", &geojson(&[("null", &outline(&beside))]), None).is_ok());
}

#[test]
fn an_area_may_lie_across_the_180th_meridian() {
    let across = [(179.9, 0.0), (-179.9, 0.0), (-179.9, 0.1), (179.9, 0.1)];
    let corners = read("a.geojson", &geojson(&[("{}", &outline(&across))]), None).unwrap();
    assert_eq!(corners[1], Position { latitude_deg: 0.0, longitude_deg: -179.9 }, "as the file has it");
    let bow = [across[0], across[2], across[1], across[3]];
    misshapen(&bow, "the outline of POLYGON crosses itself, after corners 1 and 3", "in their order");
    let place = |&(longitude_deg, latitude_deg): &(f64, f64)| Position { latitude_deg, longitude_deg };
    let outline: Vec<Position> = across.iter().map(place).collect();
    let hole = |east: f64| [(179.95, 0.02), (-180.0 + east, 0.02), (-180.0 + east, 0.04)].iter().map(place).collect();
    let (within, out): (Vec<Position>, Vec<Position>) = (hole(0.05), hole(0.15));
    assert_eq!((corners::outside(&within, &outline), corners::outside(&out, &outline)), (None, Some(1)));
}

#[test]
fn all_that_is_wrong_with_an_outline_is_told_together() {
    let faults = read("bay.json", &geojson(&[("{}", &outline(&[(0.0, 0.0), (1.0, 95.0)]))]), None).unwrap_err();
    let messages: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
    let what = "the polygon at `features[0].geometry.coordinates`";
    let corner = format!("`bay.json`: corner 2 of {what} has latitude 95 and longitude 1");
    assert_eq!(messages, [&format!("`bay.json`: {what} has 2 corners, and an area needs at least 3"), &corner]);
}

/// Two holes, the second of them no area.
const HOLES: [&str; 2] = [
    "[[-75.747, 36.184], [-75.745, 36.184], [-75.746, 36.186], [-75.747, 36.184]]",
    "[[-75.744, 36.184], [-75.742, 36.186]]",
];

#[test]
fn a_hole_is_an_area_of_its_own() {
    let holed = outline(&SQUARE).replace("]]]", &format!("]], {}, {}]", HOLES[0], HOLES[1]));
    let json = geojson(&[(r#"{"name": "bay"}"#, &holed)]);
    let inner = |ring: &str| {
        let tuples = ring.replace("], [", " ").replace(", ", ",").replace(['[', ']'], "");
        format!("<innerBoundaryIs><LinearRing><coordinates>{tuples}</coordinates></LinearRing></innerBoundaryIs>")
    };
    let inner = format!("{}{}</Polygon>", inner(HOLES[0]), inner(HOLES[1]));
    let xml = kml(&placemark("bay", KML_SQUARE).replace("</Polygon>", &inner));
    for (path, text, place) in [("a.json", &json, "`features[0].geometry.coordinates`"), ("a.kml", &xml, "line 3")] {
        let ring = |hole| area(path, text.as_bytes(), Some("bay"), hole);
        let whole = ring(None).unwrap();
        assert_eq!((whole.corners.len(), whole.holes), (4, 2));
        let hole = ring(Some(1)).unwrap();
        let first = Position { latitude_deg: 36.184, longitude_deg: -75.747 };
        assert_eq!((hole.corners.len(), hole.corners[0], &hole.polygon), (3, first, &whole.polygon));
        let message = |hole| ring(Some(hole)).unwrap_err()[0].message.clone();
        let what = format!("the polygon `bay`, {place},");
        assert_eq!(message(2), format!("`{path}`: hole 2 of {what} has 2 corners, and an area needs at least 3"));
        assert_eq!([message(3), message(0)], [(); 2].map(|()| format!("`{path}`: {what} has 2 holes")));
    }
    let error = area("a.kml", kml(&placemark("bay", KML_SQUARE)).as_bytes(), None, Some(1)).unwrap_err();
    assert_eq!(error[0].message, "`a.kml`: the polygon `bay`, line 3, has no hole");
    let empty = kml(&placemark("bay", KML_SQUARE).replace("</Polygon>", "<innerBoundaryIs/></Polygon>"));
    refused("a.kml", &empty, None, "line 7: this hole has no `coordinates`", "export");
    let none = geojson(&[("{}", &outline(&SQUARE).replace("]]]", "]], 3]"))]);
    let place = "`features[0].geometry.coordinates[1]` is no list of positions";
    refused("a.json", &none, None, place, "export");
}

/// Positions of another system are metres, or degrees of another globe.
#[test]
fn another_system_of_coordinates_is_refused() {
    let with = |system: &str, place: &str| {
        let text = geojson(&[("{}", &outline(&SQUARE))]);
        text.replacen(place, &format!("{place}, \"crs\": {system}"), 1)
    };
    let named = |name: &str| format!(r#"{{"type": "name", "properties": {{"name": "{name}"}}}}"#);
    let (collection, geometry) = (r#""type": "FeatureCollection""#, r#""type": "Polygon""#);
    for name in ["urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4326", "WGS 84"] {
        assert_eq!(read("a.geojson", &with(&named(name), collection), None).unwrap().len(), 4, "{name}");
    }
    assert!(read("a.geojson", &with("null", collection), None).is_ok());
    let help = "`ogr2ogr -t_srs EPSG:4326 OUT.geojson IN.geojson`";
    let of = |system: &str| {
        format!("by its `crs` its positions are those of {system}, and areas are read in degrees on WGS 84")
    };
    for name in ["EPSG:32618", "urn:ogc:def:crs:EPSG::3857", "EPSG:4269"] {
        for place in [collection, geometry] {
            refused("a.geojson", &with(&named(name), place), None, &of(&format!("`{name}`")), help);
        }
    }
    let linked = r#"{"type": "link", "properties": {"href": "http://example.com/crs/42"}}"#;
    refused("a.geojson", &with(linked, collection), None, &of("a system that it does not name"), help);
}

/// What is too long for a line of a message is cut, wherever it comes from.
#[test]
fn messages_do_not_grow_with_the_file() {
    let long = "e".repeat(1_000_000);
    let square = outline(&SQUARE);
    let name = format!(r#"{{"name": "{long}"}}"#);
    let two = geojson(&[(&name, &square), (&name, &square)]);
    let bow = geojson(&[(&name, &outline(&[SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]]))]);
    let kind = format!(r#"{{"type": "{long}"}}"#);
    let system = format!(r#"{{"type": "Point", "crs": {{"properties": {{"name": "{long}"}}}}}}"#);
    for text in [&two, &bow, &kind, &system] {
        let fault = read("a.json", text, None).unwrap_err().remove(0);
        assert!(fault.message.len() + fault.help.unwrap().len() < 400, "{}", fault.message.len());
    }
    let texts = [
        kml(&placemark(&long, KML_SQUARE).repeat(2)),
        kml(&placemark("box", &long)),
        kml(&format!("<{long}></b>")),
        format!("<{long}/>"),
        kml(&format!("<a {long}:b='c'/>")),
    ];
    for text in texts {
        let fault = read("a.kml", &text, None).unwrap_err().remove(0);
        assert!(fault.message.len() + fault.help.unwrap().len() < 400, "{}", fault.message.len());
    }
}

/// A name is held once, however many polygons have it: two megabytes times a hundred thousand would be no file's worth.
#[test]
fn polygons_of_one_feature_have_its_name_in_common() {
    let name = "e".repeat(2_000_000);
    let rings = vec!["[[]]"; 100_000].join(",");
    let many = format!(r#"{{"type": "MultiPolygon", "coordinates": [{rings}]}}"#);
    let text = geojson(&[(&format!(r#"{{"name": "{name}"}}"#), &many)]);
    let fault = read("a.json", &text, None).unwrap_err().remove(0);
    assert!(fault.message.starts_with("`a.json`: there are 100000 polygons in it: eee"), "{}", fault.message.len());
    let fault = read("a.json", &text, Some("eel")).unwrap_err().remove(0);
    assert!(
        fault.message.starts_with("`a.json`: there is no polygon named `eel` in it: eee"),
        "{}",
        fault.message.len()
    );
}

/// The reader of XML compares the attributes of an element each with each, and the prefixes in force with those of an element.
#[test]
fn a_crowd_of_attributes_is_refused_before_it_is_read() {
    let attributes: String = (0..300_000).map(|i| format!(" a{i}='1'")).collect();
    let prefixes: String = (0..40).map(|i| format!(" xmlns:a{i}='u'")).collect();
    let nested: String = (0..40).map(|i| format!("<a xmlns:b{i} = \"u\">")).collect();
    let crowd = "it has more than 64 attributes in one element, or more than 32 prefixes";
    for text in [kml(&format!("<a{attributes}/>")), kml(&format!("<a{prefixes}/>")), kml(&nested)] {
        refused("a.kml", &text, None, crowd, "export the area again");
    }
    // Nothing else that looks like them counts.
    let rule = "=".repeat(100);
    let harmless = format!("<!-- {rule} <a {rule} --><a b='{rule}>{rule}'/><![CDATA[<a {rule}]]>{rule}");
    let text = kml(&format!("{harmless}{}", placemark("box", KML_SQUARE)));
    assert_eq!(read("a.kml", &text, None).unwrap().len(), 4);
}

/// Lines are counted once: twice the polygons take twice as long, not four times.
#[test]
fn many_polygons_keep_their_lines() {
    let polygons = placemark("cell", KML_SQUARE) + "\n";
    let text = kml(&(polygons.repeat(12_000) + &placemark("last", KML_SQUARE) + &placemark("last", KML_SQUARE)));
    assert_eq!(read("a.kml", &text, Some("lost")).unwrap_err().len(), 1);
    let line = 3 + 12_000 * 5;
    let message = format!("2 polygons are named `last`: line {line}, line {}", line + 4);
    refused("a.kml", &text, Some("last"), &message, "a name of its own");
}

/// One that touches the outline is within it, as the formats have it; so is one in a bay of an outline that is itself no area.
#[test]
fn a_hole_lies_within_its_outline() {
    let hole = |outline_of: &[(f64, f64)], ring: &[(f64, f64)]| {
        let ring: Vec<String> = ring.iter().map(|(x, y)| format!("[{x}, {y}]")).collect();
        let holed = outline(outline_of).replace("]]]", &format!("]], [{}]]", ring.join(", ")));
        area("a.json", holed.as_bytes(), None, Some(1)).map(|ring| ring.corners.len())
    };
    let triangle = |x: f64, y: f64| [(x, y), (x + 0.001, y), (x, y + 0.001)];
    let (south, west) = SQUARE.iter().fold((f64::MAX, f64::MAX), |least, c| (least.0.min(c.1), least.1.min(c.0)));
    assert_eq!(hole(&SQUARE, &triangle(west + 0.001, south + 0.001)), Ok(3));
    assert_eq!(hole(&SQUARE, &triangle(west, south)), Ok(3), "along two sides");
    let dented = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.05, 0.02), (0.0, 0.1)];
    assert_eq!(hole(&dented, &triangle(0.01, 0.05)), Ok(3));
    let refused = |outline_of: &[(f64, f64)], x, y, corner: usize| {
        let error = hole(outline_of, &triangle(x, y)).unwrap_err();
        let expected = format!("lies outside the outline, with its corner {corner}");
        assert!(error.len() == 1 && error[0].message.ends_with(&expected), "{error:?}");
    };
    refused(&SQUARE, west + 1.0, south, 1);
    refused(&SQUARE, west + 0.001, south - 0.0005, 1);
    refused(&dented, 0.05, 0.05, 1);
    refused(&dented, 0.0, 0.0995, 2);
}

#[test]
fn no_name_is_offered_that_several_polygons_have() {
    let twice = kml(&[placemark("a", KML_SQUARE), placemark("a", KML_SQUARE)].join("\n"));
    let help = "give each polygon a feature and a name of its own, and say which is meant";
    refused("a.kml", &twice, None, "there are 2 polygons in it: `a` and `a`", help);
    let third = kml(&[placemark("a", KML_SQUARE), placemark("a", KML_SQUARE), placemark("b", KML_SQUARE)].join("\n"));
    let help = "`area_file(\"a.kml\", named: \"b\")`";
    refused("a.kml", &third, None, "there are 3 polygons in it: `a`, `a` and `b`", help);
}

/// RFC 7946, section 3.1.9: an area across 180 degrees is written in two parts.
#[test]
fn an_area_that_was_cut_at_180_degrees_is_joined() {
    let half = |from: f64, to: f64| format!("[[[{from}, 1], [{to}, 1], [{to}, 1.1], [{from}, 1.1], [{from}, 1]]]");
    let multi = |second: &str| {
        let both = [half(179.9, 180.0), second.to_string()].join(", ");
        let geometry = format!(r#"{{"type": "MultiPolygon", "coordinates": [{both}]}}"#);
        geojson(&[(r#"{"name": "box"}"#, geometry.as_str())])
    };
    let cut = multi(&half(-180.0, -179.9));
    refused("a.json", &cut, None, "there are 2 polygons in it: `box` and `box`", "join them in one polygon");
    let places = "`features[0].geometry.coordinates[0]`, `features[0].geometry.coordinates[1]`";
    let named = format!("2 polygons are named `box`: {places}");
    refused("a.json", &cut, Some("box"), &named, "join them in one polygon");
    let joined = outline(&[(179.9, 1.0), (-179.9, 1.0), (-179.9, 1.1), (179.9, 1.1), (179.9, 1.0)]);
    assert_eq!(read("a.json", &geojson(&[("{}", &joined)]), None).unwrap().len(), 4);
    // Two that lie apart, on one side or both, are two.
    for apart in [half(178.0, 180.0), half(-179.9, -179.8)] {
        refused("a.json", &multi(&apart), Some("box"), &named, "a name of its own");
    }
}
