//! For how many corners areas have room: for those of the largest that a script can make.

use super::{Checked, Module, Override, check_with_room};
use crate::Library;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::types::{AREA_ROOM, TypeTable};

/// Checks all modules. Their files of data come from the library.
pub fn check(modules: &[Module], library: &dyn Library, overrides: Vec<Override>) -> Checked {
    let checked = check_with_room(modules, library, overrides.clone(), AREA_ROOM);
    let corners = checked.types.corners;
    // Where a field of a record lies is told by the words of those before it: with larger areas all is looked at again.
    if corners > AREA_ROOM { check_with_room(modules, library, overrides, corners) } else { checked }
}

/// What is wrong with a line at the prompt after which areas may have more corners than there is room for: what has a name there stays
/// as it is from line to line.
pub fn too_large(types: &TypeTable, line: Span) -> Option<Diagnostic> {
    let TypeTable { corners, area_room, .. } = types;
    let message =
        format!("an area may have {corners} corners here, and those of this session have {area_room} at most");
    let finding = Diagnostic::error(Code::PromptValue, line, message);
    (corners > area_room).then(|| finding.help("open a script at the prompt that makes an area of so many corners"))
}
