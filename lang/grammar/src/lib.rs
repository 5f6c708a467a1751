//! The grammar of scripts (`grammar.pest`), as the parser that is made from it. It stands alone because it takes longer to compile
//! than all that reads its trees.
#![allow(missing_docs, reason = "made from grammar.pest, whose rules carry their own comments")]

#[derive(pest_derive::Parser)]
#[grammar = "grammar.pest"]
pub struct Grammar;
