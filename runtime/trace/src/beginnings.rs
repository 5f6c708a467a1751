//! Which beginnings of statements are told: of one that begins again and again at once, the first few, and then how many.

/// A statement begins at once again within so many ticks: 10 s.
pub const AT_ONCE_TICKS: u64 = 100;
/// It is told so often in a row.
const IN_A_ROW_MAX: u64 = 5;

/// What has begun of late.
#[derive(Clone, Debug)]
pub struct Beginnings {
    /// For each statement of the program.
    rows: Vec<Row>,
    /// Those of which not all beginnings have been told.
    untold: Vec<u32>,
}

/// Beginnings of a statement, each at once after the one before.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    last: u64,
    count: u64,
}

impl Beginnings {
    /// Of so many statements none has begun.
    pub fn new(statements: usize) -> Self {
        Beginnings { rows: vec![Row::default(); statements], untold: Vec::new() }
    }

    /// A statement begins in a tick: whether that is told.
    pub fn begin(&mut self, statement: u32, tick: u64) -> bool {
        let Some(row) = self.rows.get_mut(statement as usize) else { return false };
        let is_at_once = row.count > 0 && tick.saturating_sub(row.last) < AT_ONCE_TICKS;
        *row = Row { last: tick, count: if is_at_once { row.count + 1 } else { 1 } };
        if row.count == IN_A_ROW_MAX + 1 {
            self.untold.push(statement);
        }
        row.count <= IN_A_ROW_MAX
    }

    /// Statements that no longer begin at once, by this tick, each with how many of its beginnings were not told; at the end all.
    pub fn come_to_rest(&mut self, tick: Option<u64>) -> Vec<(u32, u64)> {
        if self.untold.is_empty() {
            return Vec::new();
        }
        let rows = &mut self.rows;
        let goes_on = |row: &Row| tick.is_some_and(|tick| tick.saturating_sub(row.last) < AT_ONCE_TICKS);
        let mut rest = Vec::new();
        self.untold.retain(|&statement| {
            let Some(row) = rows.get_mut(statement as usize) else { return false };
            if goes_on(row) {
                return true;
            }
            rest.push((statement, row.count - IN_A_ROW_MAX));
            row.count = 0;
            false
        });
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fast_loops_are_told_some_times_and_then_counted() {
        let mut beginnings = Beginnings::new(1);
        let told: Vec<u64> = (0..500).filter(|&tick| beginnings.begin(0, tick)).collect();
        assert_eq!(told, [0, 1, 2, 3, 4]);
        assert_eq!(beginnings.come_to_rest(Some(500)), []);
        assert_eq!(beginnings.come_to_rest(Some(599)), [(0, 495)]);
        assert_eq!(beginnings.come_to_rest(None), [], "it is told once");
        assert!(beginnings.begin(0, 600), "and is told again");
    }

    #[test]
    fn slow_loops_are_told_each_time() {
        let mut beginnings = Beginnings::new(1);
        assert!((0..100).all(|round| beginnings.begin(0, round * AT_ONCE_TICKS)));
        assert_eq!(beginnings.come_to_rest(None), []);
    }
}
