//! KML 2.3 (OGC 12-007r2): its polygons, wherever they stand. Positions are `longitude,latitude` and maybe a height, in degrees on
//! WGS 84, with blanks between them.

use super::{Contents, Name, Polygon, Position, fault, opened, shortened};
use crate::FileFault;
use roxmltree::{Document, Node, NodeId};
use std::collections::BTreeSet;

/// The kinds of geometry that are no areas.
const OTHERS: [&str; 4] = ["Point", "LineString", "Model", "Track"];

/// An element has no more attributes than this, and a file no more prefixes of names: the reader compares each with each.
const ATTRIBUTES_MAX: usize = 64;
const PREFIXES_MAX: usize = 32;

/// A placemark has its polygons no deeper in it than this: in a `MultiGeometry`, maybe in another.
const PLACEMARK_DEPTH_MAX: usize = 16;

/// The lines of a text, counted once from its beginning to its end.
struct Lines<'t> {
    text: &'t str,
    at: usize,
    line: usize,
}

/// The polygons of a text.
pub(super) fn contents(text: &str) -> Result<Contents, FileFault> {
    uncrowded(text)?;
    // Entities of its own a document cannot declare: the reader refuses them.
    let document = Document::parse(text).map_err(|error| {
        let (told, at) = (error.to_string(), error.pos());
        let short = shortened(&told);
        let told = if short == told { told } else { format!("{short} at {at}") };
        fault(format!("this is no XML: {told}"), "export the area again as KML")
    })?;
    if !is(document.root_element(), "kml") {
        let outermost = shortened(document.root_element().tag_name().name());
        let what = format!("its outermost element is `{outermost}`, not `kml`");
        return Err(fault(what, "export the area again as KML"));
    }
    let mut contents = Contents::default();
    let mut lines = Lines { text, at: 0, line: 1 };
    // The last placemark and its name, which may be long, and that of many polygons.
    let mut named: (Option<NodeId>, Option<Name>) = (None, None);
    for node in document.descendants() {
        let kind = node.tag_name().name();
        if is(node, "Polygon") {
            let placemark = node.ancestors().take(PLACEMARK_DEPTH_MAX).find(|above| is(*above, "Placemark"));
            if placemark.map(|placemark| placemark.id()) != named.0 {
                placemark.map_or(Ok(()), |placemark| alone(placemark, "name", "this placemark has two names"))?;
                let name = placemark.and_then(|placemark| child(placemark, "name"));
                named = (placemark.map(|p| p.id()), name.map(|name| Name(text_of(name).trim().into())));
            }
            let place = format!("line {}", lines.line_at(node.range().start));
            contents.polygons.push(polygon(node, named.1.clone(), place)?);
        } else if OTHERS.contains(&kind) {
            contents.others.insert(kind.to_string());
        }
    }
    Ok(contents)
}

/// Whether the reader of XML gets through a text in good time: an element may have few attributes, and a file few prefixes.
fn uncrowded(text: &str) -> Result<(), FileFault> {
    let mut prefixes = BTreeSet::new();
    let mut rest = text;
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let aside = [("!--", "-->"), ("![CDATA[", "]]>")].into_iter().find(|(begin, _)| rest.starts_with(begin));
        if let Some((_, end)) = aside {
            rest = rest.find(end).map_or("", |at| &rest[at..]);
            continue;
        }
        let (mut count, mut quote) = (0, None);
        for (i, byte) in rest.bytes().enumerate() {
            match (quote, byte) {
                (None, b'>' | b'<') => break,
                (None, b'"' | b'\'') => quote = Some(byte),
                (Some(begun), byte) if begun == byte => quote = None,
                (None, b'=') => {
                    count += 1;
                    let name = rest[..i].trim_end().rsplit(char::is_whitespace).next().unwrap_or_default();
                    prefixes.extend(name.strip_prefix("xmlns:"));
                }
                _ => {}
            }
            if count > ATTRIBUTES_MAX || prefixes.len() > PREFIXES_MAX {
                let message = format!(
                    "it has more than {ATTRIBUTES_MAX} attributes in one element, or more than {PREFIXES_MAX} prefixes"
                );
                return Err(fault(message, "export the area again as KML: a chart needs a few"));
            }
        }
    }
    Ok(())
}

fn polygon(node: Node, name: Option<Name>, place: String) -> Result<Polygon, FileFault> {
    alone(node, "outerBoundaryIs", "this polygon has two outlines")?;
    let outer = child(node, "outerBoundaryIs");
    outer.map_or(Ok(()), |outer| alone(outer, "LinearRing", "this outline has two rings"))?;
    let outline = outer.and_then(|outer| child(outer, "LinearRing"));
    let corners = ring(outline, || broken(node, "this polygon has no outline with `coordinates`"))?;
    let inner = node.children().filter(|below| is(*below, "innerBoundaryIs"));
    let hole = |inner: Node| {
        alone(inner, "LinearRing", "this hole has two rings: each hole has an `innerBoundaryIs` of its own")?;
        ring(child(inner, "LinearRing"), || broken(inner, "this hole has no `coordinates`"))
    };
    let holes = inner.map(hole).collect::<Result<_, FileFault>>()?;
    Ok(Polygon { name, place, corners, holes })
}

/// The corners of a ring; `without` any, it says so.
fn ring(ring: Option<Node>, without: impl FnOnce() -> FileFault) -> Result<Vec<Position>, FileFault> {
    let coordinates = ring.and_then(|ring| child(ring, "coordinates")).ok_or_else(without)?;
    ring.map_or(Ok(()), |ring| alone(ring, "coordinates", "this ring has `coordinates` twice"))?;
    if let Some(inside) = coordinates.children().find(Node::is_element) {
        return Err(broken(inside, "`coordinates` holds something else than positions"));
    }
    let corner = |tuple: &str| {
        let no_position = "is not a longitude, a latitude and perhaps a height with commas between them";
        let what = || broken(coordinates, &format!("`{}` {no_position}", shortened(tuple)));
        position(tuple).ok_or_else(what)
    };
    text_of(coordinates).split_whitespace().map(corner).collect::<Result<_, FileFault>>().map(opened)
}

fn position(tuple: &str) -> Option<Position> {
    let number = |number: &str| number.parse::<f64>().ok().filter(|number| number.is_finite());
    let numbers: Option<Vec<f64>> = tuple.split(',').map(number).collect();
    match numbers?[..] {
        [longitude, latitude] | [longitude, latitude, _] => {
            Some(Position { latitude_deg: latitude, longitude_deg: longitude })
        }
        _ => None,
    }
}

fn is(node: Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|below| is(*below, name))
}

/// That an element has no two children of a name: which of them counts nobody could tell.
fn alone(node: Node, name: &str, what: &str) -> Result<(), FileFault> {
    let second = node.children().filter(|below| is(*below, name)).nth(1);
    second.map_or(Ok(()), |second| Err(broken(second, what)))
}

/// What stands in an element, comments left out.
fn text_of(node: Node) -> String {
    node.children().filter(Node::is_text).filter_map(|part| part.text()).collect()
}

fn broken(node: Node, what: &str) -> FileFault {
    let line = node.document().text_pos_at(node.range().start).row;
    fault(format!("line {line}: {what}"), "export the area again as KML")
}

impl Lines<'_> {
    /// The line of a byte; that of none before it is asked any more.
    fn line_at(&mut self, byte: usize) -> usize {
        let passed = self.text.as_bytes().get(self.at..byte).unwrap_or_default();
        self.line += passed.iter().filter(|byte| **byte == b'\n').count();
        self.at = byte;
        self.line
    }
}
