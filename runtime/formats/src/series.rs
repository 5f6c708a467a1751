//! Numbers over time, some columns of a table such as a run records:
//!
//! ```text
//! time (s),depth (m),temperature (degC),flow.north (m/s),flow.east (m/s)
//! 1.0,3.02,14.2,,
//! 2.0,3.01,,0.12,-0.03
//! ```
//!
//! It is CSV as RFC 4180 has it, but that no cell goes over the end of its line. The head names the columns, each with its unit; those
//! that are asked for are read, and the others are passed over. Times rise. Cells without anything are no sample.

use crate::fault::{Fault, Faults, Unreadable, counted, listed, shortened};

/// Times are no nearer to each other than this, s: no instrument of ours is sampled faster.
const APART_MIN_S: f64 = 1e-3;
/// What a time in decimals may lose of that, as a share.
const ROUNDING: f64 = 1e-6;
/// No run lasts so long, s: a later time counts from another beginning than that of a run, such as that of 1970.
const TIME_MAX_S: f64 = 3.6e7;
/// A table has at most so many columns.
const COLUMNS_MAX: usize = 1000;

/// A sample has at most so many numbers.
const NUMBERS_MAX: usize = 4;

/// The numbers of a sample, each in the unit of its column; 0 where it has fewer.
pub type Numbers = [f64; NUMBERS_MAX];

/// What is read of a table.
#[derive(Clone, Copy, Debug)]
pub struct Columns<'a> {
    /// The head of the times, in seconds: `time (s)`.
    pub time: &'a str,
    /// What is measured: `position`.
    pub name: &'a str,
    /// The columns of its numbers, in their order in a sample.
    pub numbers: &'a [Column],
}

/// A column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its head, with its unit if it has one: `temperature (degC)`.
    pub head: String,
    /// What its numbers are in a table that has no such column; none: a table has it.
    pub otherwise: Option<f64>,
    /// Whether its numbers stand in every row, those of an earlier sample too. Beside others they are a sample where these stand as well.
    pub is_standing: bool,
}

/// Reads the samples of a table, each its time in s and its numbers, else tells all that is wrong. Numbers that cannot be are wrong.
pub fn read(
    bytes: &[u8],
    columns: Columns,
    can_be: impl Fn(Numbers) -> bool,
) -> Result<Vec<(f64, Numbers)>, Unreadable> {
    let mut faults = Faults::default();
    let samples = read_into(bytes, columns, can_be, &mut faults).unwrap_or_default();
    match faults.into_unreadable() {
        None if samples.is_empty() => Err(Unreadable::of(columns.nothing())),
        None => Ok(samples),
        Some(unreadable) => Err(unreadable),
    }
}

fn read_into(
    bytes: &[u8],
    columns: Columns,
    can_be: impl Fn(Numbers) -> bool,
    faults: &mut Faults,
) -> Option<Vec<(f64, Numbers)>> {
    let text = faults.take(text(bytes))?;
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    let Some((line, head)) = lines.next() else {
        faults.add("the file is empty", columns.example());
        return None;
    };
    let head = faults.take(cells(line, head))?;
    let (time, numbers) = (columns.time_among(&head, line, faults), columns.numbers_among(&head, line, faults));
    let (time, numbers) = (time?, numbers?);
    let mut samples = Vec::new();
    let mut before = None;
    for (line, row) in lines {
        let Some(row) = faults.take(cells(line, row).and_then(|row| whole(line, row, head.len()))) else { continue };
        let Some(at) = faults.take(moment(line, &row[time], before)) else { continue };
        before = Some(at);
        let cells: Vec<Option<&str>> = numbers.iter().map(|place| place.map(|place| row[place].as_str())).collect();
        if let Some(numbers) = faults.take(columns.sample(line, &cells, &can_be)).flatten() {
            samples.push((at, numbers));
        }
    }
    Some(samples)
}

fn text(bytes: &[u8]) -> Result<&str, Fault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count();
        Fault::new(format!("line {line} is no text in UTF-8"), "save the table as CSV in UTF-8")
    })?;
    Ok(text.trim_start_matches('\u{feff}'))
}

/// The cells of a line, without blanks and quotes around them.
fn cells(line: usize, row: &str) -> Result<Vec<String>, Fault> {
    if row.matches(',').count() >= COLUMNS_MAX {
        let help = "leave out columns that nothing reads";
        return Err(Fault::new(format!("line {line} has more than {COLUMNS_MAX} cells"), help));
    }
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    let mut parts = row.split('"').enumerate().peekable();
    while let Some((i, part)) = parts.next() {
        // Parts behind an odd number of quotes stand within them, and two quotes within them are one of the cell's own.
        is_quoted = i % 2 == 1;
        let is_own = !is_quoted && part.is_empty() && i > 0 && parts.peek().is_some();
        if is_own {
            cells.last_mut().into_iter().for_each(|cell| cell.push('"'));
        }
        // What stands beside the quotes of a cell is blank: `1"0"` is no ten.
        let beside = [(i > 0).then(|| part.split(',').next()), parts.peek().map(|_| part.rsplit(',').next())];
        if !is_quoted && !is_own && beside.into_iter().flatten().flatten().any(|text| !text.trim().is_empty()) {
            let help = "write a cell without quotes, or all of it within them";
            return Err(Fault::new(format!("line {line} has a quote within a cell"), help));
        }
        let mut pieces = if is_quoted { vec![part] } else { part.split(',').collect() }.into_iter();
        if let (Some(cell), Some(first)) = (cells.last_mut(), pieces.next()) {
            cell.push_str(first);
        }
        cells.extend(pieces.map(str::to_string));
    }
    if is_quoted {
        return Err(Fault::new(format!("line {line} has a quote that does not close"), "close it on the same line"));
    }
    cells.iter_mut().for_each(|cell| *cell = cell.trim().to_string());
    Ok(cells)
}

/// A row, if it has as many cells as the head.
fn whole(line: usize, row: Vec<String>, columns: usize) -> Result<Vec<String>, Fault> {
    if row.len() == columns {
        return Ok(row);
    }
    let message = format!("line {line} has {}, and the head {columns}", counted(row.len() as u64, "cell"));
    Err(Fault::new(message, "give each row a cell for each column; where nothing was sensed it is empty"))
}

/// The time of a row, which is later than the one before.
fn moment(line: usize, cell: &str, before: Option<f64>) -> Result<f64, Fault> {
    let is_time = |at: &f64| (0.0..=TIME_MAX_S).contains(at);
    let Some(at) = cell.parse().ok().filter(is_time) else {
        let message = format!("line {line}: `{}` is no time of a run", shortened(cell));
        return Err(Fault::new(message, "write seconds from the beginning of the run, such as `12.5`"));
    };
    match before {
        Some(before) if at <= before => {
            let message = format!("line {line}: {at} s is not later than {before} s of the row before");
            Err(Fault::new(message, "sort the rows by their times, and leave out those that stand twice"))
        }
        Some(before) if at - before < APART_MIN_S * (1.0 - ROUNDING) => {
            let message = format!("line {line}: {at} s is less than {APART_MIN_S} s later than the row before");
            Err(Fault::new(message, "leave out some of the rows: nothing is sampled faster than 1000 Hz"))
        }
        _ => Ok(at),
    }
}

impl Columns<'_> {
    /// A head that has them all, for who has none.
    fn example(&self) -> String {
        let heads: Vec<&str> = std::iter::once(self.time).chain(self.numbers.iter().map(|c| c.head.as_str())).collect();
        format!("begin it with a head such as `{}`, as `record {}` writes it", heads.join(","), self.name)
    }

    fn nothing(&self) -> Fault {
        let numbers = if self.numbers.len() == 1 { "a number" } else { "its numbers" };
        let help = format!("give it rows, each with a time and {numbers}, or leave the clause out");
        Fault::new(format!("no row holds a sample of `{}`", self.name), help)
    }

    fn time_among(&self, head: &[String], line: usize, faults: &mut Faults) -> Option<usize> {
        faults.take(place(head, self.time, line).and_then(|place| {
            let help = "give each row its time in seconds from the beginning of the run";
            place.ok_or_else(|| Fault::new(format!("line {line} names no column `{}`", self.time), help))
        }))
    }

    /// Where each of the columns stands that the table has, if it has all that it needs.
    fn numbers_among(&self, head: &[String], line: usize, faults: &mut Faults) -> Option<Vec<Option<usize>>> {
        let places: Vec<_> = self.numbers.iter().map(|column| faults.take(column.among(head, line))).collect();
        places.into_iter().collect()
    }

    /// The sample of a row, if there is one in it, of the cells of the columns that the table has.
    fn sample(
        &self,
        line: usize,
        cells: &[Option<&str>],
        can_be: impl Fn(Numbers) -> bool,
    ) -> Result<Option<Numbers>, Fault> {
        let mut numbers = Numbers::default();
        for ((column, cell), number) in self.numbers.iter().zip(cells).zip(&mut numbers) {
            *number = match cell {
                None => column.otherwise.unwrap_or_default(),
                Some("") => 0.0,
                Some(cell) => cell.parse().map_err(|_| no_number(line, cell))?,
            };
        }
        if !self.is_told(line, cells)? {
            return Ok(None);
        }
        if can_be(numbers) {
            return Ok(Some(numbers));
        }
        let told: Vec<String> = cells.iter().flatten().map(|cell| shortened(cell)).collect();
        let (name, help) = match self.numbers {
            [column] => (&*column.head, "correct it, or leave the cell empty: then no sample comes"),
            _ => (self.name, "correct it, or leave its cells empty: then no sample comes"),
        };
        Err(Fault::new(format!("line {line}: no `{name}` is {}", told.join(", ")), help))
    }

    /// Whether there is a sample in the cells of a row: those that stand together are all filled, or all empty.
    fn is_told(&self, line: usize, cells: &[Option<&str>]) -> Result<bool, Fault> {
        let mut is_told = true;
        for is_standing in [true, false] {
            let together = self.numbers.iter().zip(cells).filter(|(column, _)| column.is_standing == is_standing);
            let together = together.filter_map(|(column, cell)| Some((&column.head, (*cell)?)));
            let (empty, filled): (Vec<_>, Vec<_>) = together.partition(|(_, cell)| cell.is_empty());
            is_told &= empty.is_empty();
            if let (Some((empty, _)), Some((filled, _))) = (empty.first(), filled.first()) {
                let message = format!("line {line} has `{filled}`, and no `{empty}`");
                let help = "give both, or leave the cells of both empty: then no sample comes";
                return Err(Fault::new(message, help));
            }
        }
        Ok(is_told)
    }
}

impl Column {
    /// Where it stands in a table; nowhere, if a table may do without it.
    fn among(&self, head: &[String], line: usize) -> Result<Option<usize>, Fault> {
        let own = &self.head;
        if let Some(place) = place(head, own, line)? {
            return Ok(Some(place));
        }
        let name = own.split(" (").next();
        match head.iter().find(|other| other.split(['(', ' ']).next() == name) {
            Some(other) => {
                let message = format!("line {line}: `{}` is not in the unit of `{own}`", shortened(other));
                Err(Fault::new(message, format!("convert its numbers, and call it `{own}`")))
            }
            None if self.otherwise.is_some() => Ok(None),
            None => {
                let message = format!("line {line} names no column `{own}`");
                let others = listed(head.iter().map(String::as_str));
                Err(Fault::new(message, format!("call it so; the file has {others}")))
            }
        }
    }
}

fn no_number(line: usize, cell: &str) -> Fault {
    let help = "write it with a point, such as `12.5`, or leave the cell empty: then no sample comes";
    Fault::new(format!("line {line}: `{}` is no number", shortened(cell)), help)
}

/// Where a column stands, if it is there.
fn place(head: &[String], name: &str, line: usize) -> Result<Option<usize>, Fault> {
    let mut places = head.iter().enumerate().filter(|(_, cell)| *cell == name).map(|(place, _)| place);
    let first = places.next();
    match places.next() {
        None => Ok(first),
        Some(_) => Err(Fault::new(format!("line {line} names `{name}` twice"), "leave one of the columns out")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(head: &str) -> Column {
        Column { head: head.to_string(), otherwise: None, is_standing: false }
    }

    /// What is told of a reading, or of what is wrong.
    fn told<T>(
        read: Result<Vec<(f64, Numbers)>, Unreadable>,
        of: fn((f64, Numbers)) -> T,
    ) -> Result<Vec<T>, Vec<String>> {
        let messages = |wrong: Unreadable| wrong.faults.into_iter().map(|fault| fault.message).collect();
        read.map(|samples| samples.into_iter().map(of).collect()).map_err(messages)
    }

    fn read(text: &str) -> Result<Vec<(f64, f64)>, Vec<String>> {
        let columns = Columns { time: "time (s)", name: "temperature", numbers: &[column("temperature (degC)")] };
        let samples = super::read(text.as_bytes(), columns, |[x, ..]| (-5.0..=50.0).contains(&x));
        told(samples, |(time, [x, ..])| (time, x))
    }

    /// Places, with a sigma of 7 m where the table has none.
    fn read_places(text: &str) -> Result<Vec<[f64; 4]>, Vec<String>> {
        let place = |head| Column { is_standing: true, ..column(head) };
        let sigma = Column { otherwise: Some(7.0), ..column("position.sigma (m)") };
        let numbers = [place("north (m)"), place("east (m)"), sigma];
        let columns = Columns { time: "time (s)", name: "position", numbers: &numbers };
        told(super::read(text.as_bytes(), columns, |[n, ..]| n < 1e5), |(time, [n, e, sigma, _])| [time, n, e, sigma])
    }

    #[test]
    fn one_column_is_read_whatever_stands_beside_it() {
        let text = "\u{feff}time (s), \"remark, \"\"ours\"\"\",temperature (degC)\r\n0.0,\"a, b\",12.5\r\n\r\n0.1,,\r\n2,\"\",1.3e1\r\n";
        assert_eq!(read(text).unwrap(), [(0.0, 12.5), (2.0, 13.0)]);
        assert_eq!(cells(1, "\"a, \"\"b\"\"\",,\"\", c ").unwrap(), ["a, \"b\"", "", "", "c"]);
        assert_eq!(read("temperature (degC),time (s)\n7,0.001\n8,0.002").unwrap(), [(0.001, 7.0), (0.002, 8.0)]);
    }

    #[test]
    fn all_that_is_wrong_is_told_with_its_line() {
        let rows = |rows: &str| read(&format!("time (s),temperature (degC)\n{rows}")).unwrap_err();
        assert_eq!(rows("0,1\n0,1"), ["line 3: 0 s is not later than 0 s of the row before"]);
        assert_eq!(rows("1,1\n\n1.0005,1"), ["line 4: 1.0005 s is less than 0.001 s later than the row before"]);
        assert_eq!(
            rows("-1,1\n,1\nnan,1\n1.7e9,1\n1,1"),
            [
                "line 2: `-1` is no time of a run; line 3: `` is no time of a run; line 4: `nan` is no time of a run; and 1 more such"
            ]
        );
        assert_eq!(
            rows("0,400\n1,inf"),
            ["line 2: no `temperature (degC)` is 400; line 3: no `temperature (degC)` is inf"]
        );
        assert_eq!(
            rows("0,mild\n1\n2,\"3"),
            [
                "line 2: `mild` is no number",
                "line 3 has 1 cell, and the head 2",
                "line 4 has a quote that does not close"
            ]
        );
        let quotes =
            "line 2 has a quote within a cell; line 3 has a quote within a cell; line 4 has a quote within a cell";
        assert_eq!(rows("0,1\"0\"\n1,\"1\"0\n\"2\"\"\"3,1\n"), [quotes]);
        assert_eq!(read("time (s),\"a \"\"b\"\"\",temperature (degC)\n 0 ,\"\", \"7\" \n").unwrap(), [(0.0, 7.0)]);
        assert_eq!(rows(&",".repeat(2000)), ["line 2 has more than 1000 cells"]);
        assert_eq!(rows("0,\n1,"), ["no row holds a sample of `temperature`"]);
    }

    #[test]
    fn a_head_has_both_columns_each_once_and_in_its_unit() {
        assert_eq!(read("").unwrap_err(), ["the file is empty"]);
        let head = |head: &str| read(&format!("{head}\n0,1,1\n")).unwrap_err();
        assert_eq!(head("time (min),temperature (degC),x"), ["line 1 names no column `time (s)`"]);
        assert_eq!(
            head("time (s),temperature (K),x"),
            ["line 1: `temperature (K)` is not in the unit of `temperature (degC)`"]
        );
        assert_eq!(
            head("time (s),temperature,x"),
            ["line 1: `temperature` is not in the unit of `temperature (degC)`"]
        );
        assert_eq!(head("time (s),salinity (psu),x"), ["line 1 names no column `temperature (degC)`"]);
        assert_eq!(head("time (s),temperature (degC),temperature (degC)"), ["line 1 names `temperature (degC)` twice"]);
        assert_eq!(
            head("time;temperature"),
            ["line 1 names no column `time (s)`", "line 1 names no column `temperature (degC)`"]
        );
    }

    #[test]
    fn a_sample_has_all_of_its_numbers() {
        let places = |rows: &str| read_places(&format!("time (s),north (m),east (m),position.sigma (m)\n{rows}"));
        // A place that stands there without a sigma of its own is that of an earlier sample; one that is old stands there no more.
        assert_eq!(places("1,2,3,4\n2,2,3,\n3,,,\n4,,,5\n5,6,7,8").unwrap(), [[1., 2., 3., 4.], [5., 6., 7., 8.]]);
        assert_eq!(
            places("1,2,,4\n2,,3,\n3,1e6,0,1\n4,x,0,").unwrap_err(),
            [
                "line 2 has `north (m)`, and no `east (m)`; line 3 has `east (m)`, and no `north (m)`",
                "line 4: no `position` is 1e6, 0, 1",
                "line 5: `x` is no number"
            ]
        );
        assert_eq!(places("1,2,3,").unwrap_err(), ["no row holds a sample of `position`"]);
        assert_eq!(read_places("east (m),time (s),north (m)\n3,1,2\n").unwrap(), [[1., 2., 3., 7.]]);
        let head = |head: &str| read_places(&format!("time (s),{head}\n1,2,3,4\n")).unwrap_err();
        assert_eq!(
            head("latitude (deg),longitude (deg),depth (m)"),
            ["line 1 names no column `north (m)`; line 1 names no column `east (m)`"]
        );
        assert_eq!(
            head("north (m),east (m),position.sigma (km)"),
            ["line 1: `position.sigma (km)` is not in the unit of `position.sigma (m)`"]
        );
    }

    /// Whatever the bytes are, reading them ends in samples or in what is wrong.
    #[test]
    fn no_bytes_are_too_strange() {
        let numbers = [column("temperature (degC)"), Column { otherwise: Some(0.0), ..column("more") }];
        let columns = Columns { time: "time (s)", name: "temperature", numbers: &numbers };
        let whole = b"time (s),temperature (degC),more\n0.0,\"12.5\",1\n1.0,13,2\n";
        for at in 0..whole.len() {
            for byte in [0, b'"', b',', b'\n', b'-', 0xff] {
                let mut bytes = whole.to_vec();
                bytes[at] = byte;
                let _ = super::read(&bytes, columns, |_| true);
                let _ = super::read(&bytes[..at], columns, |_| true);
            }
        }
    }
}
