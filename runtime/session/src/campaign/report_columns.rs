//! The columns of what reports hold: their values and what stands behind their labels, a column for each number, word and coordinate in it.
//! Lists, areas, lines and maps stand in one cell, as JSON; of an area a column tells how large it is, and one how large what it is meant to be truly is.

use super::columns::METRE_DECIMALS;
use crate::reported;
use crate::summary::Report;
use albacore_program::{Program, ReportSite, Shape, number};
use serde_json::Value;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The columns of one report of a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ReportColumns {
    pub name: String,
    /// Which report of that name it is, from 0.
    pub nth: usize,
    /// Whether its time and error have columns here: those of the first report stand among the columns of every table.
    pub is_timed: bool,
    pub parts: Vec<Part>,
}

/// A part of a report that has a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// The statements whose reports have it, by their places among the program's, in order.
    sites: Vec<u32>,
    label: String,
    /// The fields of records that lead to it.
    fields: Vec<String>,
    unit: Option<String>,
    /// Which coordinate it is of a place or a vector, or which size of an area.
    coordinate: Option<&'static str>,
}

/// How large the spill truly is that an area was reported of.
const TRUE_SURFACE: &str = "true_surface_m2";

/// Label, fields, unit and coordinate of a part.
type Called = (String, Vec<String>, Option<String>, Option<&'static str>);

impl ReportColumns {
    /// Their names, not all of which need be different.
    pub fn names(&self) -> Vec<String> {
        let Self { name, nth, .. } = self;
        let prefix = if *nth == 0 { name.clone() } else { format!("{name}_{}", nth + 1) };
        let timed = ["t_s", "error_m"].into_iter().filter(|_| self.is_timed).map(str::to_string);
        let behind = |part: String| if part.is_empty() { prefix.clone() } else { format!("{prefix}_{part}") };
        timed.chain(self.parts.iter().map(Part::name)).map(behind).collect()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.parts.len() + if self.is_timed { 2 } else { 0 }
    }

    /// Whether such a report is of a place.
    pub fn tells_places(&self) -> bool {
        self.parts.iter().any(Part::is_of_a_place)
    }
}

/// Statements that report under one name, each with its place among the program's.
pub(super) type Sites<'a> = Vec<(u32, &'a ReportSite)>;

/// The names under which anything is reported, in the order of the program, each with the statements that do.
pub(super) fn by_names(sites: &[ReportSite]) -> Vec<(&str, Sites<'_>)> {
    let mut names: Vec<(&str, Sites)> = Vec::new();
    let mut known: BTreeMap<&str, usize> = BTreeMap::new();
    for (at, site) in (0..).zip(sites) {
        let name = *known.entry(&site.name).or_insert_with(|| {
            names.push((&site.name, Vec::new()));
            names.len() - 1
        });
        names[name].1.push((at, site));
    }
    names
}

/// Whether any report of a program is of a place.
pub fn tells_places(program: &Program) -> bool {
    by_names(&program.reports).iter().any(|(_, sites)| parts(sites).iter().any(Part::is_of_a_place))
}

/// The parts of all that is reported under a name.
pub(super) fn parts(sites: &Sites) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let mut known: BTreeMap<Called, usize> = BTreeMap::new();
    for &(site, fields) in sites {
        for (label, value) in &fields.fields {
            let whole =
                Part { sites: vec![site], label: label.clone(), fields: Vec::new(), unit: None, coordinate: None };
            for part in whole.of(&value.shape) {
                match known.entry(part.called()) {
                    Entry::Occupied(known) => parts[*known.get()].sites.push(site),
                    Entry::Vacant(new) => {
                        new.insert(parts.len());
                        parts.push(part);
                    }
                }
            }
        }
    }
    parts
}

impl Part {
    /// Whether it is of the place that a report is of, and of none behind a label.
    fn is_of_a_place(&self) -> bool {
        self.label.is_empty() && self.coordinate == Some("north_m")
    }

    /// What of a value with a shape has columns.
    fn of(self, shape: &Shape) -> Vec<Part> {
        let coordinates = |names: [&'static str; 2], unit: Option<String>| {
            names.map(|name| Part { coordinate: Some(name), unit: unit.clone(), ..self.clone() }).to_vec()
        };
        match shape {
            Shape::Optional(shape) => self.of(shape),
            Shape::Area(_) => {
                let sizes = ["surface_m2", TRUE_SURFACE].map(|name| Part { coordinate: Some(name), ..self.clone() });
                std::iter::once(self.clone()).chain(sizes).collect()
            }
            Shape::Point => coordinates(["north_m", "east_m"], None),
            Shape::Vector(_) => coordinates(["north", "east"], reported::unit(shape)),
            Shape::Record(_, fields) => {
                let of_field = |(field, shape): &(String, Shape)| {
                    let mut part = self.clone();
                    part.fields.push(field.clone());
                    part.of(shape)
                };
                fields.iter().flat_map(of_field).collect()
            }
            _ => vec![Part { unit: reported::unit(shape), ..self }],
        }
    }

    /// What two parts have in common that share a column.
    fn called(&self) -> Called {
        (self.label.clone(), self.fields.clone(), self.unit.clone(), self.coordinate)
    }

    /// What it is called behind the name of its report: of a value that is one number without a unit there is nothing to say.
    fn name(&self) -> String {
        let mut words = vec![self.label.clone()];
        words.extend_from_slice(&self.fields);
        words.extend(self.coordinate.map(str::to_string));
        words.extend(self.unit.as_ref().map(|unit| unit.replace(|c: char| !c.is_ascii_alphanumeric(), "_")));
        words.retain(|word| !word.is_empty());
        words.join("_")
    }

    /// Its cell in the row of a run; empty where the report has no such part, or holds nothing there.
    pub fn cell(&self, report: &Report) -> String {
        if self.sites.binary_search(&report.site).is_err() {
            return String::new();
        }
        if self.coordinate == Some(TRUE_SURFACE) {
            return report.true_surface_m2.map(nine_digits).unwrap_or_default();
        }
        let value = if self.label.is_empty() { Some(&report.value) } else { report.labelled.get(&self.label) };
        let value = self.fields.iter().try_fold(value.unwrap_or(&Value::Null), |value, field| value.get(field));
        let value = match &self.unit {
            Some(_) => value.and_then(|value| value.get("value")),
            None => value,
        };
        let value = value.and_then(|value| self.coordinate.map_or(Some(value), |name| value.get(name)));
        match value {
            None | Some(Value::Null) => String::new(),
            Some(Value::String(text)) => text.clone(),
            Some(Value::Number(number)) if number.is_f64() => {
                // A place is told to a millimetre, whatever else with nine digits.
                let is_of_place = self.coordinate.is_some_and(|c| c.ends_with("_m"));
                let cell = |x| if is_of_place { number::fixed(x, METRE_DECIMALS) } else { nine_digits(x) };
                number.as_f64().map(cell).unwrap_or_default()
            }
            Some(other) => other.to_string(),
        }
    }
}

/// A number with so many digits that no figure made from the table shows the rounding.
fn nine_digits(x: f64) -> String {
    format!("{x:.8e}").parse::<f64>().unwrap_or(x).to_string()
}

#[cfg(test)]
mod tests {
    use super::{ReportColumns, by_names, nine_digits, parts};
    use crate::summary::Report;
    use albacore_program::{Display, ReportSite, Shape, Valued};
    use serde_json::json;

    fn site(fields: &[(&str, Shape)]) -> ReportSite {
        let field = |(label, shape): &(&str, Shape)| (label.to_string(), Valued { slot: 0, shape: shape.clone() });
        ReportSite { name: "visit".into(), fields: fields.iter().map(field).collect() }
    }

    fn quantity(unit: &str) -> Shape {
        Shape::Quantity(Display { unit: unit.into(), scale: 1.0, decimals: 1 })
    }

    #[test]
    fn each_number_word_and_coordinate_has_a_column() {
        let record = Shape::Record("Seen".into(), vec![("at".into(), Shape::Point), ("speed".into(), quantity("m/s"))]);
        let fields = [
            ("", Shape::Optional(Box::new(Shape::Point))),
            ("number", Shape::Int),
            ("share", quantity("%")),
            ("seen", record),
            ("outline", Shape::Area(16)),
        ];
        let sites = [site(&fields), site(&[("", quantity("m"))]), site(&[("number", Shape::Point)])];
        let parts = parts(&by_names(&sites)[0].1);
        let columns = ReportColumns { name: "visit".into(), nth: 1, is_timed: true, parts };
        let names = [
            "visit_2_t_s",
            "visit_2_error_m",
            "visit_2_north_m",
            "visit_2_east_m",
            "visit_2_number",
            "visit_2_share",
            "visit_2_seen_at_north_m",
            "visit_2_seen_at_east_m",
            "visit_2_seen_speed_m_s",
            "visit_2_outline",
            "visit_2_outline_surface_m2",
            "visit_2_outline_true_surface_m2",
            "visit_2_m",
            "visit_2_number_north_m",
            "visit_2_number_east_m",
        ];
        assert_eq!(columns.names(), names);
        assert_eq!(columns.count(), names.len());
        let place = json!({ "north_m": 1.5, "east_m": -2.0, "latitude_deg": 36.0 });
        let labelled = json!({
            "number": 3,
            "share": 0.123_456_789_123,
            "seen": { "at": place, "speed": { "value": 1.5, "unit": "m/s" } },
            "outline": { "corners": [], "surface_m2": 12.5 },
        });
        let labelled = serde_json::from_value(labelled).unwrap();
        let cells = |report: &Report| columns.parts.iter().map(|part| part.cell(report)).collect::<Vec<_>>();
        let first = cells(&Report { value: place, labelled, ..Report::default() });
        assert_eq!(
            first,
            [
                "1.500",
                "-2.000",
                "3",
                "0.123456789",
                "1.500",
                "-2.000",
                "1.5",
                "{\"corners\":[],\"surface_m2\":12.5}",
                "12.5",
                "",
                "",
                "",
                "",
            ]
        );
        // Other statements report under the same name, a length and a place.
        let other = cells(&Report { value: json!({ "value": 4.0, "unit": "m" }), site: 1, ..Report::default() });
        assert_eq!(other, ["", "", "", "", "", "", "", "", "", "", "4", "", ""]);
        let labelled = serde_json::from_value(json!({ "number": { "north_m": 1.0, "east_m": 2.0 } })).unwrap();
        let third = cells(&Report { labelled, site: 2, ..Report::default() });
        assert_eq!(third, ["", "", "", "", "", "", "", "", "", "", "", "1.000", "2.000"]);
    }

    #[test]
    fn numbers_have_nine_digits() {
        assert_eq!(
            [0.1 + 0.2, 1e-12 / 3.0, 123_456_789_012.0].map(nine_digits),
            ["0.3", "0.000000000000333333333", "123456789000"]
        );
    }
}
