//! What stands in a cell of a table, whatever texts others wrote: one line that is seen, and that no spreadsheet computes.

use albacore_export::no_formula;
use albacore_program::seen::one_line;

/// A cell as it stands in the file: of one that is so already, the same.
pub fn plain(cell: &str) -> String {
    no_formula(&one_line(cell))
}
