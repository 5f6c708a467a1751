//! The switching diagram of a strategy, drawn: as SVG, for Graphviz and for Mermaid. Each is a pure function of a
//! [`Diagram`]: the same script gives the same bytes on every machine.

mod dot;
mod graph;
mod layout;
mod mermaid;
mod svg;
mod wrap;

pub use albacore_lang::diagram::Diagram;
pub use dot::dot;
pub use mermaid::mermaid;
pub use svg::{marked_svg, svg};
