//! KML 2.3 (OGC 12-007r2): its polygons, wherever they stand. Positions are `longitude,latitude` and maybe a height, in degrees on
//! WGS 84, with blanks between them.

use super::{Contents, Polygon, Position, fault, opened};
use crate::FileFault;
use roxmltree::{Document, Node};

/// The kinds of geometry that are no areas.
const OTHERS: [&str; 4] = ["Point", "LineString", "Model", "Track"];

/// The polygons of a text.
pub(super) fn contents(text: &str) -> Result<Contents, FileFault> {
    // Entities of its own a document cannot declare: the reader refuses them.
    let document = Document::parse(text)
        .map_err(|error| fault(format!("this is no XML: {error}"), "export the area again as KML"))?;
    if !is(document.root_element(), "kml") {
        let what = format!("its outermost element is `{}`, not `kml`", document.root_element().tag_name().name());
        return Err(fault(what, "export the area again as KML"));
    }
    let mut contents = Contents::default();
    for node in document.descendants() {
        let kind = node.tag_name().name();
        if is(node, "Polygon") {
            contents.polygons.push(polygon(node)?);
        } else if OTHERS.contains(&kind) {
            contents.others.insert(kind.to_string());
        }
    }
    Ok(contents)
}

fn polygon(node: Node) -> Result<Polygon, FileFault> {
    let placemark = node.ancestors().find(|above| is(*above, "Placemark"));
    let name = placemark.and_then(|placemark| child(placemark, "name")).map(|name| text(name).trim().to_string());
    let outline = child(node, "outerBoundaryIs").and_then(|outer| child(outer, "LinearRing"));
    let corners = ring(outline, || broken(node, "this polygon has no outline with `coordinates`"))?;
    let inner = node.children().filter(|below| is(*below, "innerBoundaryIs"));
    let hole = |inner: Node| ring(child(inner, "LinearRing"), || broken(inner, "this hole has no `coordinates`"));
    let holes = inner.map(hole).collect::<Result<_, FileFault>>()?;
    Ok(Polygon { name, place: line(node), corners, holes })
}

/// The corners of a ring; `without` any, it says so.
fn ring(ring: Option<Node>, without: impl FnOnce() -> FileFault) -> Result<Vec<Position>, FileFault> {
    let coordinates = ring.and_then(|ring| child(ring, "coordinates")).ok_or_else(without)?;
    let corner = |tuple: &str| {
        let what = || broken(coordinates, &format!("`{tuple}` is no longitude and latitude with a comma between them"));
        position(tuple).ok_or_else(what)
    };
    text(coordinates).split_whitespace().map(corner).collect::<Result<_, FileFault>>().map(opened)
}

fn position(tuple: &str) -> Option<Position> {
    let mut numbers = tuple.split(',').map(|number| number.parse::<f64>().ok());
    let (longitude, latitude) = (numbers.next()??, numbers.next()??);
    Some(Position { latitude_deg: latitude, longitude_deg: longitude })
}

fn is(node: Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|below| is(*below, name))
}

/// What stands in an element, comments left out.
fn text(node: Node) -> String {
    node.children().filter(Node::is_text).filter_map(|part| part.text()).collect()
}

fn line(node: Node) -> String {
    format!("line {}", node.document().text_pos_at(node.range().start).row)
}

fn broken(node: Node, what: &str) -> FileFault {
    fault(format!("{}: {what}", line(node)), "export the area again as KML")
}
