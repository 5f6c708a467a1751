//! The diagram for Graphviz.

use crate::graph::{Graph, Node, numbered};
use crate::wrap::wrapped;
use albacore_lang::diagram::{Diagram, Guard};
use albacore_program::seen::shown;

/// Labels are broken after so many letters.
const LETTERS: usize = 32;

/// The diagram in the language of Graphviz's `dot`. What rules do besides switching is told to whoever points at them.
pub fn dot(diagram: &Diagram) -> String {
    let graph = Graph::new(diagram);
    let mut out = format!("digraph {} {{\n", quoted(&diagram.name));
    let mut line = |text: String| out.push_str(&format!("    {text}\n"));
    line("node [shape=box, style=rounded, fontname=\"Helvetica-Bold\"]".into());
    line("edge [fontname=\"Courier\", fontsize=10]".into());
    // No name of a behavior, which is an identifier.
    line("\"->\" [shape=point, width=0.12, label=\"\"]".into());
    for node in &graph.nodes {
        let more = match node {
            Node::Behavior(_) => String::new(),
            Node::Finish(_) => attributes(node, "peripheries=2, fontname=\"Courier\""),
            Node::Abort(_) => attributes(node, "shape=octagon, style=solid, fontname=\"Courier\""),
        };
        line(format!("{}{more}", quoted(&node.text())));
    }
    let name = |node: usize| quoted(&graph.nodes[node].text());
    line(format!("\"->\" -> {}", name(diagram.start)));
    for link in &graph.links {
        let mut label: Vec<String> = link.guards.iter().flat_map(|guard| wrapped(&numbered(guard), LETTERS)).collect();
        if link.back {
            label.push("then back".into());
        }
        let back = if link.back { ", style=dashed, dir=both, arrowtail=empty" } else { "" };
        let tooltip = tooltip(link.guards).map(|text| format!(", labeltooltip={}", quoted(&text))).unwrap_or_default();
        let label = quoted(&label.join("\n"));
        line(format!("{} -> {} [label={label}{back}{tooltip}]", name(link.source), name(link.target)));
    }
    out + "}\n"
}

fn attributes(node: &Node, more: &str) -> String {
    format!(" [label={}, {more}]", quoted(&wrapped(&node.text(), LETTERS).join("\n")))
}

fn tooltip(guards: &[Guard]) -> Option<String> {
    let effects: Vec<String> =
        guards.iter().filter_map(|g| g.effect.as_ref().map(|e| format!("{}: do {{ {e} }}", g.rule))).collect();
    (!effects.is_empty()).then(|| effects.join("\n"))
}

/// A text as `dot` takes it. A newline becomes the two letters that `dot` reads as one; what looks like an entity of HTML
/// stays what it is.
fn quoted(text: &str) -> String {
    let escaped = shown(text).replace('&', "&amp;").replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
    format!("\"{escaped}\"")
}
