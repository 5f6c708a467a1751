//! `area_file("bay.geojson")`: an area of a file, read while the script is checked, as if its corners stood in the script.

use super::{Checker, ParamInfo};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::hir::{Expr, ExprKind, without_holes};
use crate::source::{Source, Span};
use crate::syntax::tree;
use crate::types::Type;
use albacore_formats::FileFault;
use albacore_formats::area::{self as area_file, BYTES_MAX, Ring};
use std::collections::BTreeSet;

/// The polygons with holes that were read.
#[derive(Debug, Default)]
pub(super) struct Holed {
    outlines: Vec<Outline>,
    /// The holes that are areas of the script: file, polygon, number.
    holes: BTreeSet<(String, String, usize)>,
}

/// The outline of a polygon with holes, read as an area.
#[derive(Debug)]
struct Outline {
    path: String,
    named: Option<String>,
    ring: Ring,
    span: Span,
}

impl Checker<'_> {
    pub(super) fn area_file(&mut self, args: &[tree::Arg], span: Span) -> Expr {
        let unnamed = self.make(ExprKind::None, Type::None, span);
        let text = |name: &str, default| ParamInfo {
            name: name.into(),
            ty: Type::Text,
            default,
            range: None,
            behavior: None,
            span,
        };
        let hole = ParamInfo {
            name: "hole".into(),
            ty: Type::Int,
            default: Some(unnamed.clone()),
            range: None,
            behavior: None,
            span,
        };
        let params = [text("file", None), text("named", Some(unnamed)), hole];
        let Some(values) = self.arguments("area_file", &params, args, span, None) else { return self.unknown(span) };
        let [file, named, hole] = values.as_slice() else { return self.unknown(span) };
        let Some(path) = self.constant_text(file) else { return self.unknown(span) };
        let named = match named.kind {
            ExprKind::None => None,
            _ => match self.constant_text(named) {
                Some(name) => Some(name),
                None => return self.unknown(span),
            },
        };
        let hole = match (&hole.kind, hole.range.constant()) {
            (ExprKind::None, _) => None,
            (_, Some(number)) => Some(number as usize),
            (_, None) => {
                let what = "the file of an area is read before the launch";
                self.report(Diagnostic::error(Code::AreasFile, hole.span, what).help("write the number itself"));
                return self.unknown(span);
            }
        };
        let ring = match self.data_file(&path) {
            Ok(bytes) => area_file::area(&path, &bytes, named.as_deref(), hole),
            Err(fault) => Err(vec![fault]),
        };
        match ring {
            Ok(ring) => {
                let area = self.polygon_of(&ring.corners, span);
                match hole {
                    Some(number) => _ = self.holed.holes.insert((path, ring.polygon, number)),
                    None if ring.holes > 0 => self.holed.outlines.push(Outline { path, named, ring, span }),
                    None => {}
                }
                area
            }
            Err(faults) => {
                faults.into_iter().for_each(|fault| self.report_file(fault, span));
                self.unknown(span)
            }
        }
    }

    /// An outline is an area only for who has read its holes too, to keep out of them.
    pub(super) fn holes_are_read(&mut self) {
        let Holed { outlines, holes } = std::mem::take(&mut self.holed);
        for Outline { path, named, ring, span } in outlines {
            let is_read = |number| holes.contains(&(path.clone(), ring.polygon.clone(), number));
            let unread: Vec<usize> = (1..=ring.holes).filter(|&number| !is_read(number)).collect();
            if !unread.is_empty() {
                self.report_file(area_file::unread(&path, named.as_deref(), &ring, &unread), span);
            }
        }
    }

    fn report_file(&mut self, FileFault { message, help }: FileFault, span: Span) {
        let finding = Diagnostic::error(Code::AreasFile, span, message);
        self.report(match help {
            Some(help) => finding.help(help),
            None => finding,
        });
    }

    /// The area of corners that are known to make one.
    fn polygon_of(&mut self, corners: &[area_file::Position], span: Span) -> Expr {
        let corner = |c: &area_file::Position| {
            let kind = ExprKind::Geodetic { latitude_deg: c.latitude_deg, longitude_deg: c.longitude_deg };
            self.make(kind, Type::Point, span)
        };
        let list = ExprKind::List(corners.iter().map(corner).collect());
        let list = self.make(list, Type::List(Box::new(Type::Point), corners.len() as u32), span);
        self.area_of(list, span).unwrapped()
    }

    /// A text without values in it: a file is read before anything is known of a run.
    fn constant_text(&mut self, e: &Expr) -> Option<String> {
        let plain = match &e.kind {
            ExprKind::Text(parts) => without_holes(parts),
            _ => None,
        };
        if plain.is_none() && e.ty != Type::Unknown {
            self.report(
                Diagnostic::error(Code::AreasFile, e.span, "the file of an area is read before the launch")
                    .help("write the text itself, without values in `{` and `}`"),
            );
        }
        plain
    }

    /// The bytes of a file of the project, each file read once; it becomes one of the script's sources.
    fn data_file(&mut self, path: &str) -> Result<Vec<u8>, FileFault> {
        let read = self.files.entry(path.to_string()).or_insert_with(|| self.library.data_file(path, BYTES_MAX));
        read.clone()
    }

    /// The files that were read, as sources.
    pub(super) fn files_read(&self) -> Vec<Source> {
        let source = |(path, read): (&String, &Result<Vec<u8>, FileFault>)| {
            let text = String::from_utf8_lossy(read.as_ref().ok()?);
            Some(Source { name: path.as_str().into(), text: text.as_ref().into() })
        };
        self.files.iter().filter_map(source).collect()
    }
}
