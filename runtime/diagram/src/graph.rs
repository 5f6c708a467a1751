//! What all three writers draw: a box for each behavior and each end, and links between boxes.

use albacore_lang::diagram::{Diagram, Edge, Guard, Target};

/// A box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// A behavior: its name.
    Behavior(String),
    /// `finish`, with a result if there is one.
    Finish(Option<String>),
    /// `abort`: why.
    Abort(String),
}

/// A line from a box to a box.
#[derive(Clone, Copy, Debug)]
pub struct Link<'a> {
    /// Index of the box that it leaves.
    pub source: usize,
    /// Index of the box that it enters.
    pub target: usize,
    /// It comes back when the target is done.
    pub back: bool,
    /// Its label.
    pub guards: &'a [Guard],
}

/// Boxes and links. The behaviors come first, and have the indices that they have in the diagram.
pub struct Graph<'a> {
    /// The boxes.
    pub nodes: Vec<Node>,
    /// The links, by the first rule of each.
    pub links: Vec<Link<'a>>,
}

impl<'a> Graph<'a> {
    /// The graph of a diagram: ends that say the same are one box.
    pub fn new(diagram: &'a Diagram) -> Self {
        let mut nodes: Vec<Node> = diagram.behaviors.iter().map(|name| Node::Behavior(name.clone())).collect();
        let mut link = |edge: &'a Edge| {
            let target = match &edge.target {
                Target::Behavior(index) => *index,
                Target::Finish(result) => index_of(&mut nodes, Node::Finish(result.clone())),
                Target::Abort(why) => index_of(&mut nodes, Node::Abort(why.clone())),
            };
            Link { source: edge.source, target, back: edge.back, guards: &edge.guards }
        };
        let links = diagram.edges.iter().map(&mut link).collect();
        Graph { nodes, links }
    }
}

fn index_of(nodes: &mut Vec<Node>, node: Node) -> usize {
    nodes.iter().position(|n| *n == node).unwrap_or_else(|| {
        nodes.push(node);
        nodes.len() - 1
    })
}

impl Node {
    /// What it says, as the script does. No two boxes of a diagram say the same: `finish` and `abort` name no behavior.
    pub fn text(&self) -> String {
        match self {
            Node::Behavior(name) => name.clone(),
            Node::Finish(None) => "finish".into(),
            Node::Finish(Some(result)) => format!("finish {result}"),
            Node::Abort(why) => format!("abort \"{}\"", why.replace('"', "\\\"")),
        }
    }
}

/// A rule as a script writes it after its sources and target, its number before it.
pub fn numbered(guard: &Guard) -> String {
    format!("{}: {}", guard.rule, guard.on)
}
