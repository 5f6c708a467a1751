//! Values that stand for nothing although nobody has said so.
//!
//! Who cuts a grid out of another leaves -9999 in its holes, and an elevation of -9999 m is water that could be. Such a value is
//! known by two signs: it is one of those that programs are used to write, and the bottom breaks off all round it. One cell of a
//! trench may well lie at -9999 m, but then those about it lie little higher.

/// What programs write where they know nothing, without its sign; what no depth can be is refused anyway.
const MARKS: [f64; 9] = [999.0, 999.9, 9_998.0, 9_999.0, 9_999.9, 32_766.0, 32_767.0, 32_768.0, 99_999.0];

/// Whether each cell holds a mark that stands apart. Depths are row after row, and what is not finite is no depth; `is_mark` tells
/// of the cell of that index whether its value is one that programs write.
///
/// Neighbours with the same value are one patch. It stands apart if each step across its edge is higher than any between
/// neighbours that are no marks: in the two cuts of ETOPO5 no cell that was measured is so.
pub(crate) fn undeclared(depths: &[f64], columns: usize, is_mark: impl Fn(usize) -> bool) -> Vec<bool> {
    let marks: Vec<bool> = (0..depths.len()).map(|cell| depths[cell].is_finite() && is_mark(cell)).collect();
    let mut apart = vec![false; depths.len()];
    if !marks.contains(&true) {
        return apart;
    }
    let step_max = highest_step(depths, columns, &marks);
    let mut seen = vec![false; depths.len()];
    for first in 0..depths.len() {
        if !marks[first] || seen[first] {
            continue;
        }
        seen[first] = true;
        let (mut patch, mut looked, mut stands_apart) = (vec![first], 0, true);
        while let Some(&cell) = patch.get(looked) {
            looked += 1;
            for other in about(cell, columns, depths.len()) {
                if depths[other] != depths[first] {
                    // From or to what is no depth there is no step.
                    let step = (depths[other] - depths[first]).abs();
                    stands_apart &= step.is_nan() || step > step_max;
                } else if !std::mem::replace(&mut seen[other], true) {
                    patch.push(other);
                }
            }
        }
        if stands_apart {
            patch.into_iter().for_each(|cell| apart[cell] = true);
        }
    }
    apart
}

/// The highest step that the bottom has, m. Where there is nothing but marks, nothing was measured, and any is too high.
fn highest_step(depths: &[f64], columns: usize, marks: &[bool]) -> f64 {
    let is_bottom = |cell: &usize| depths[*cell].is_finite() && !marks[*cell];
    let step = |cell: usize| {
        let others = about(cell, columns, depths.len()).filter(is_bottom);
        others.map(|other| (depths[cell] - depths[other]).abs()).fold(0.0, f64::max)
    };
    (0..depths.len()).filter(is_bottom).map(step).fold(0.0, f64::max)
}

/// The neighbours of a cell in its row and its column.
fn about(cell: usize, columns: usize, cells: usize) -> impl Iterator<Item = usize> {
    let column = cell % columns;
    let neighbours = [
        (column > 0).then(|| cell - 1),
        (column + 1 < columns).then_some(cell + 1),
        cell.checked_sub(columns),
        Some(cell + columns),
    ];
    neighbours.into_iter().flatten().filter(move |other| *other < cells)
}

/// Whether a value is one that programs write. In single precision the same are a little off.
pub(crate) fn is_mark(value: f64) -> bool {
    let size = value.abs();
    MARKS.iter().any(|mark| size == *mark || size == f64::from(*mark as f32))
}

#[cfg(test)]
mod tests {
    use super::is_mark;

    /// The cells that are told, of so many columns.
    fn undeclared<const COLUMNS: usize>(rows: &[[f64; COLUMNS]]) -> Vec<(usize, usize)> {
        let cells = rows.concat();
        let apart = super::undeclared(&cells, COLUMNS, |cell| is_mark(cells[cell]));
        let told = (0..cells.len()).filter(|cell| apart[*cell]);
        told.map(|cell| (cell / COLUMNS, cell % COLUMNS)).collect()
    }

    #[test]
    fn a_mark_is_one_only_where_the_bottom_breaks_off_all_round_it() {
        // Further down the slope the water is deeper than the mark says.
        let slope = |middle| [[-5_000.0; 3], [-6_000.0, middle, -6_200.0], [-8_000.0; 3], [-10_400.0; 3]];
        assert_eq!(undeclared(&slope(-9_999.0)), [], "from -8000 to -10400 is a higher step");
        assert_eq!(undeclared(&slope(-999.0)), [(1, 1)]);
        assert_eq!(undeclared(&[[-9_700.0, -9_800.0, -9_850.0], [-9_900.0, -9_999.0, -9_950.0]]), [], "a trench");
        assert_eq!(undeclared(&[[-9_700.0, -9_800.0, -9_850.0], [-9_900.0, -999.0, -9_950.0]]), [(1, 1)]);
    }

    #[test]
    fn a_patch_of_marks_is_judged_by_its_edge() {
        let gentle = [-12.0, -14.0, -16.0, -17.0];
        let holes = [[-12.0, -999.0, -999.0, -17.0], [-13.0, -999.0, -16.0, -9_999.0], gentle];
        assert_eq!(undeclared(&holes), [(0, 1), (0, 2), (1, 1), (1, 3)]);
        // A plain at such a depth is reached by a slope.
        assert_eq!(undeclared(&[[-993.0, -996.0, -999.0, -999.0], [-995.0, -998.0, -999.0, -999.0]]), []);
        // Other marks beside a real depth make it none.
        assert_eq!(undeclared(&[[-997.0, -998.0, -999.0, -9_999.0], [-996.0, -997.0, -998.0, -999.0]]), [(0, 3)]);
    }

    #[test]
    fn single_precision_whole_files_and_cells_that_are_none() {
        let single = f64::from(-9_999.9_f32);
        assert_eq!(undeclared(&[[-12.0, 999.0, -13.0, single]]), [(0, 1), (0, 3)]);
        assert_eq!(undeclared(&[[-9_999.0, -9_999.0]]), [(0, 0), (0, 1)], "nothing but marks");
        assert_eq!(undeclared(&[[-12.0, -9_999.0, -14.0, f64::NAN]]), [(0, 1)]);
        assert_eq!(undeclared(&[[-40.0, -9_997.0, f64::NAN, f64::INFINITY]]), [], "others are for others to judge");
        assert_eq!(undeclared::<1>(&[]), []);
    }
}
