//! The grid of a map: square cells along the longest edge of an area, over the least such box that holds it.

use crate::rows::LONGER_M;
use crate::{Line, Point, Vector};

/// Outside of a grid by less than this is on its edge, m.
const EDGE_M: f64 = 1e-6;

/// Square cells, row beside row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The side of a cell, m.
    pub cell: f64,
    /// The corner of the first cell, where rows and columns begin.
    pub corner: Point,
    /// Which way a row goes, of length 1: northwards, or due east. The next row lies to the right of it.
    pub along: Vector,
    /// How many rows there are.
    pub rows: u32,
    /// How many cells a row has.
    pub columns: u32,
}

impl Grid {
    /// The finest grid of so many cells at most that covers an area of some edges. It lies in the middle of what it covers. None where
    /// there are no edges, or no cells.
    pub fn over(edges: impl Iterator<Item = Line> + Clone, cells_max: u32) -> Option<Grid> {
        let along = along(edges.clone())?;
        let across = to_the_right(along);
        let origin = edges.clone().next()?.start;
        let mut low = (f64::INFINITY, f64::INFINITY);
        let mut high = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for corner in edges.map(|edge| edge.start - origin) {
            let at = (corner.dot(along), corner.dot(across));
            low = (low.0.min(at.0), low.1.min(at.1));
            high = (high.0.max(at.0), high.1.max(at.1));
        }
        let (length, width) = (high.0 - low.0, high.1 - low.1);
        // For each number of rows the cells must be so large that the rows reach across, and the columns that are left along.
        let side = |rows: u32| (width / f64::from(rows)).max(length / f64::from(cells_max / rows));
        let cell = (1..=cells_max).map(side).reduce(f64::min).filter(|cell| *cell > 0.0)?;
        let count = |length: f64| ((length - EDGE_M) / cell).ceil().max(1.0);
        let (rows, columns) = (count(width), count(length));
        let first = (0.5 * (low.0 + high.0 - columns * cell), 0.5 * (low.1 + high.1 - rows * cell));
        let corner = origin + (first.0 * along + first.1 * across);
        Some(Grid { cell, corner, along, rows: rows as u32, columns: columns as u32 })
    }

    /// The cell that a point lies in: none outside. What lies on the outer edge is inside.
    pub fn index_of(&self, p: Point) -> Option<u32> {
        let from = p - self.corner;
        let along = |length: f64, count: u32| {
            let is_within = length >= -EDGE_M && length <= f64::from(count) * self.cell + EDGE_M;
            is_within.then(|| (length / self.cell).floor().clamp(0.0, f64::from(count.max(1) - 1)) as u32)
        };
        let row = along(from.dot(to_the_right(self.along)), self.rows)?;
        Some(row * self.columns + along(from.dot(self.along), self.columns)?)
    }

    /// The middle of a cell.
    pub fn center(&self, index: u32) -> Point {
        self.place(index, 0.5, 0.5)
    }

    /// The corners of a cell, clockwise.
    pub fn corners(&self, index: u32) -> [Point; 4] {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(along, across)| self.place(index, along, across))
    }

    /// A place in a cell, by shares of its sides.
    fn place(&self, index: u32, along: f64, across: f64) -> Point {
        let columns = self.columns.max(1);
        let (row, column) = (f64::from(index / columns), f64::from(index % columns));
        let way = (column + along) * self.along + (row + across) * to_the_right(self.along);
        self.corner + self.cell * way
    }
}

fn to_the_right(along: Vector) -> Vector {
    Vector::new(-along.east, along.north)
}

/// Along the longest edge, of equals the first, whichever way of it leads north.
fn along(edges: impl Iterator<Item = Line>) -> Option<Vector> {
    let longer = |best: Vector, way: Vector| if way.length() > best.length() + LONGER_M { way } else { best };
    let longest = edges.map(|edge| edge.end - edge.start).reduce(longer)?;
    let unit = (1.0 / longest.length()) * longest;
    // What is meant to lie due east or north may miss that by the last bits.
    let straight = |x: f64| if x.abs() < 1e-12 { 0.0 } else { x };
    let unit = Vector::new(straight(unit.north), straight(unit.east));
    let leads_north = unit.north > 0.0 || (unit.north == 0.0 && unit.east > 0.0);
    let unit = if leads_north { unit } else { -1.0 * unit };
    // No zero is negative.
    (unit.length() > 0.5).then(|| Vector::new(unit.north + 0.0, unit.east + 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Area, Heading};

    fn over(heading_deg: f64, length: f64, width: f64, cells: u32) -> (Area, Grid) {
        let heading = Heading::from_degrees(heading_deg);
        let area = Area::rectangle(Point::new(-40.0, 7.0), heading, length, width);
        let grid = Grid::over(area.edges().map(|edge| edge.line), cells).expect("an area has edges");
        (area, grid)
    }

    #[test]
    fn a_grid_is_as_fine_as_its_cells_allow() {
        let (_, square) = over(0.0, 300.0, 300.0, 900);
        assert_eq!((square.rows, square.columns, square.along), (30, 30, Vector::new(0.0, 1.0)));
        assert!((square.cell - 10.0).abs() < 1e-9, "{square:?}");
        let (_, long) = over(140.0, 1000.0, 100.0, 90);
        assert_eq!((long.rows, long.columns), (3, 30));
        assert!((long.cell - 100.0 / 3.0).abs() < 1e-9, "{long:?}");
        let (_, one) = over(90.0, 7.0, 5.0, 1);
        assert_eq!((one.rows, one.columns), (1, 1));
        assert!(one.center(0).distance(Point::new(-40.0, 7.0)) < 1e-9, "it lies in the middle of what it covers");
    }

    #[test]
    fn no_grid_has_more_cells_than_were_asked_for_and_each_cell_holds_its_middle() {
        for (heading, length, width) in
            [(0.0, 1.0, 1.0), (90.0, 1e5, 1.0), (35.0, 333.3, 77.7), (140.0, 1e5, 1e5), (320.0, 1000.0 / 3.0, 12.0)]
        {
            for cells in [1, 2, 3, 7, 64, 900, 4096] {
                let (area, grid) = over(heading, length, width, cells);
                let count = grid.rows * grid.columns;
                assert!(0 < count && count <= cells, "{length} x {width} in {cells}: {grid:?}");
                assert!((0..count).all(|i| grid.index_of(grid.center(i)) == Some(i)), "{grid:?}");
                for corner in area.corners() {
                    assert!(grid.index_of(*corner).is_some(), "{grid:?} misses {corner:?}");
                }
                let outside = area.corners()[0] + (1.0 + length) * Vector::new(1.0, 1.0);
                assert_eq!(grid.index_of(outside + 2.0 * length * Vector::new(1.0, 1.0)), None, "{grid:?}");
            }
        }
    }
}
