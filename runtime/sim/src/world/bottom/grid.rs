//! Depths between the cells of a grid.

use crate::world::bottom::Grid;
use albacore_geometry::{Point, Vector};

impl Grid {
    /// Metres of water at a point: bilinear between the four cells about it; beyond the grid those of the nearest edge; on
    /// land none.
    pub(super) fn depth_at(&self, p: Point) -> f64 {
        let (row, north) = split(self.rows_from_south(p.north), self.rows);
        let (column, east) = split(self.columns_from_west(p.east), self.columns);
        let along = |row: u32| {
            let (west, next) = (self.cell(row, column), self.cell(row, column + 1));
            west + (next - west) * east
        };
        let (south, next) = (along(row), along(row + 1));
        (south + (next - south) * north).max(0.0)
    }

    /// The shallowest of all cells that have a part in the depths within a distance of a point.
    pub(super) fn shallowest_within(&self, distance: f64, of: Point) -> f64 {
        let corner = Vector::new(distance, distance);
        let shallowest =
            self.cells_between(of - corner, of + corner).map(|(_, depth)| depth).fold(f64::INFINITY, f64::min);
        shallowest.max(0.0)
    }

    /// The cells about the rectangle between two points, with their places.
    pub(crate) fn cells_between(
        &self,
        south_west: Point,
        north_east: Point,
    ) -> impl Iterator<Item = (Point, f64)> + '_ {
        let first_row = split(self.rows_from_south(south_west.north), self.rows).0;
        let last_row = split(self.rows_from_south(north_east.north), self.rows).0 + 1;
        let first_column = split(self.columns_from_west(south_west.east), self.columns).0;
        let last_column = split(self.columns_from_west(north_east.east), self.columns).0 + 1;
        (first_row..=last_row)
            .flat_map(move |row| (first_column..=last_column).map(move |column| (row, column)))
            .map(|(row, column)| (self.place(row, column), self.cell(row, column)))
    }

    fn place(&self, row: u32, column: u32) -> Point {
        let size = self.north_east - self.south_west;
        let share = |i: u32, count: u32| f64::from(i) / f64::from(count.saturating_sub(1));
        self.south_west + Vector::new(size.north * share(row, self.rows), size.east * share(column, self.columns))
    }

    /// What is not there has no water: a grid that was not checked must not end the run.
    fn cell(&self, row: u32, column: u32) -> f64 {
        let index = row as usize * self.columns as usize + column as usize;
        self.depths.get(index).copied().unwrap_or(0.0)
    }

    fn rows_from_south(&self, north: f64) -> f64 {
        let share = (north - self.south_west.north) / (self.north_east.north - self.south_west.north);
        share * f64::from(self.rows.saturating_sub(1))
    }

    fn columns_from_west(&self, east: f64) -> f64 {
        let share = (east - self.south_west.east) / (self.north_east.east - self.south_west.east);
        share * f64::from(self.columns.saturating_sub(1))
    }
}

/// The last of `count` cells that lies before a place which has another after it, and what share of a step the place is
/// beyond it, 0 to 1.
fn split(place: f64, count: u32) -> (u32, f64) {
    let last = count.saturating_sub(2);
    let place = place.clamp(0.0, f64::from(last) + 1.0);
    let before = (place as u32).min(last);
    (before, place - f64::from(before))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three rows of four, 10 m apart; land in the north-east.
    fn grid() -> Grid {
        Grid {
            south_west: Point::new(-10.0, 0.0),
            north_east: Point::new(10.0, 30.0),
            rows: 3,
            columns: 4,
            depths: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, -4.0],
        }
    }

    #[test]
    fn the_cells_have_their_own_depths_and_their_middles_the_mean() {
        for (place, depth) in grid().cells_between(Point::new(-99.0, -99.0), Point::new(99.0, 99.0)) {
            assert!((grid().depth_at(place) - depth.max(0.0)).abs() < 1e-12, "{place:?}");
        }
        assert!((grid().depth_at(Point::new(-5.0, 5.0)) - (1.0 + 2.0 + 5.0 + 6.0) / 4.0).abs() < 1e-12);
        assert!((grid().depth_at(Point::new(-10.0, 12.5)) - 2.25).abs() < 1e-12);
        assert!((grid().depth_at(Point::new(2.5, 20.0)) - 8.0).abs() < 1e-12);
    }

    #[test]
    fn beyond_the_grid_it_is_as_deep_as_at_the_nearest_edge_and_land_is_dry() {
        assert_eq!(grid().depth_at(Point::new(-500.0, 10.0)), 2.0);
        assert_eq!(grid().depth_at(Point::new(500.0, -500.0)), 9.0);
        assert_eq!(grid().depth_at(Point::new(10.0, 30.0)), 0.0);
        assert_eq!(grid().depth_at(Point::new(10.0, 29.0)), 0.0, "the shore lies where the depth comes to 0");
        assert!(grid().depth_at(Point::new(10.0, 25.0)) > 0.0);
    }

    #[test]
    fn the_shallowest_nearby_bounds_every_depth_nearby() {
        assert_eq!(grid().shallowest_within(4.0, Point::new(-5.0, 15.0)), 2.0);
        assert_eq!(grid().shallowest_within(11.0, Point::new(-5.0, 15.0)), 0.0);
        assert_eq!(grid().shallowest_within(1.0, Point::new(-500.0, -500.0)), 1.0);
    }
}
