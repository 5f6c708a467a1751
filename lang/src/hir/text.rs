//! Texts: what is written, and the values that stand in it.

use super::{Expr, ExprKind};

/// A piece of a text.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each variant is what it says")]
pub enum TextPart {
    Literal(String),
    Hole(Expr),
}

/// A text as it is told, if it is the same whenever it is told.
pub(crate) fn without_holes(parts: &[TextPart]) -> Option<String> {
    let literal = |part: &TextPart| match part {
        TextPart::Literal(text) => Some(text.clone()),
        TextPart::Hole(_) => None,
    };
    parts.iter().map(literal).collect()
}

impl Expr {
    /// The text that it is, if it is one without holes.
    pub fn literal_text(&self) -> Option<String> {
        match &self.kind {
            ExprKind::Text(parts) => without_holes(parts),
            _ => None,
        }
    }
}
