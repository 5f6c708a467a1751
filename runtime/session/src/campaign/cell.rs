//! What stands in a cell of a table, whatever texts others wrote: one line that is seen, and that no spreadsheet computes.

use albacore_program::seen::one_line;

/// A cell as it stands in the file: of one that is so already, the same.
pub fn plain(cell: &str) -> String {
    no_formula(&one_line(cell))
}

/// A text that a spreadsheet would compute stands behind a `'`, which makes it a text there. Numbers are numbers. Where a comma
/// stands in numbers, a spreadsheet parts cells at semicolons.
fn no_formula(cell: &str) -> String {
    let part = |part: &str| {
        let is_number = part.parse::<f64>().is_ok_and(f64::is_finite);
        let said = part.trim_start_matches(|c: char| c.is_whitespace() || c == '"');
        let starts_one = said.starts_with(['=', '+', '-', '@', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}']);
        if starts_one && !is_number { format!("'{part}") } else { part.to_string() }
    };
    cell.split(';').map(part).collect::<Vec<_>>().join(";")
}
