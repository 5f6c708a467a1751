//! The diagram for Mermaid, which documents in Markdown show as a picture.

use crate::graph::{Graph, Node, numbered};
use albacore_lang::diagram::Diagram;
use albacore_program::seen::one_line;

/// The diagram as a Mermaid flowchart. What rules do besides switching is left out: there is no place for it.
pub fn mermaid(diagram: &Diagram) -> String {
    let graph = Graph::new(diagram);
    let mut out = String::from("flowchart TD\n");
    let mut line = |text: String| out.push_str(&format!("    {text}\n"));
    // Names of our own: Mermaid has words that no name may be, such as `end`.
    line("start(( ))".into());
    for (i, node) in graph.nodes.iter().enumerate() {
        let text = quoted(&node.text());
        line(match node {
            Node::Behavior(_) => format!("n{i}[{text}]"),
            Node::Finish(_) => format!("n{i}([{text}])"),
            Node::Abort(_) => format!("n{i}{{{{{text}}}}}"),
        });
    }
    line(format!("start --> n{}", diagram.start));
    for link in &graph.links {
        let mut guards: Vec<String> = link.guards.iter().map(numbered).collect();
        if link.back {
            guards.push("then back".into());
        }
        let label = guards.iter().map(|guard| escaped(guard)).collect::<Vec<_>>().join("<br>");
        let arrow = if link.back { "-.->" } else { "-->" };
        line(format!("n{} {arrow}|\"{label}\"| n{}", link.source, link.target));
    }
    out
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", escaped(text))
}

/// A text as Mermaid takes it between quotes, where it looks for HTML and Markdown.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in one_line(text).chars() {
        match c {
            '"' => out.push_str("#quot;"),
            '<' => out.push_str("#lt;"),
            '>' => out.push_str("#gt;"),
            '&' => out.push_str("#amp;"),
            '#' | '*' | '`' | '\\' => out.push_str(&format!("#{};", u32::from(c))),
            c => out.push(c),
        }
    }
    out
}
