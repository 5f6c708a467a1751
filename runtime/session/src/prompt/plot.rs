//! `plot`: what expressions were over time, as far back as is remembered, in the terminal or as a picture.

use super::{Answer, Line, Listener, Prompt, Say, wrong};
use albacore_lang::prompt::{Drive, Named};
use albacore_program::{Shape, number};
use albacore_svg::Svg;
use albacore_vehicle::seconds;

/// Dots of a plot in a terminal: two by four in a letter.
const WIDTH: usize = 120;
const HEIGHT: usize = 24;
/// So many dots of time are there, with so many samples in each at most.
const SAMPLES_MAX: u64 = 2400;
/// So many expressions are plotted at once.
const PLOTS_MAX: usize = 8;

/// An expression over time.
struct Series {
    label: String,
    shape: Shape,
    /// Ticks, and the value in each where it had one.
    samples: Vec<(u64, f64)>,
}

/// An expression, ready to be computed at any moment.
struct Expression {
    label: String,
    drive: Drive,
    /// What could be named where it was read.
    known: Vec<Named>,
}

impl Prompt {
    pub(super) fn plot(&mut self, text: &str, file: Option<&str>, say: &mut Listener) -> Answer {
        let mut expressions = Vec::new();
        for part in parts(text) {
            match self.expression(part, say) {
                Some(expression) => expressions.push(expression),
                None => return Answer::Wrong,
            }
        }
        if expressions.is_empty() || expressions.len() > PLOTS_MAX {
            return wrong(&format!("from 1 to {PLOTS_MAX} expressions are plotted at once"), say);
        }
        let series = match self.series(&expressions) {
            Ok(series) => series,
            Err(what) => return wrong(&what, say),
        };
        match file {
            Some(file) => say(Say::File(file, &picture(&series, self.span()))),
            None => series.iter().flat_map(|series| drawn(series, self.span())).for_each(|line| say(Say::Text(&line))),
        }
        Answer::Done
    }

    /// The ticks that are plotted.
    fn span(&self) -> (u64, u64) {
        (self.past.earliest(), self.now.tick)
    }

    fn expression(&mut self, text: &str, say: &mut Listener) -> Option<Expression> {
        let (known, origin) = (self.known(), self.origin());
        let read = self.loaded.lines.read(&*self.loaded.files, text, &known, origin);
        let drive = match read.line {
            Some(Line::Value(drive)) => drive,
            _ if !read.findings.is_empty() => {
                say(Say::Findings(&read.findings, self.loaded.lines.sources()));
                return None;
            }
            _ => {
                say(Say::Error("this is no expression", Some("for example `plot chemical, depth + altitude`")));
                return None;
            }
        };
        let is_number = drive.value.as_ref().is_some_and(|value| is_plotted(&value.shape));
        if !is_number {
            let help = "plot a number of it, such as `position.north`";
            say(Say::Error(&format!("`{text}` is no single number"), Some(help)));
            return None;
        }
        Some(Expression { label: text.to_string(), drive, known })
    }

    /// Goes through all that is remembered once more, and computes the expressions now and then.
    fn series(&self, expressions: &[Expression]) -> Result<Vec<Series>, String> {
        let (first, last) = self.span();
        let every = ((last - first) / SAMPLES_MAX).max(1);
        let mut moment = self.past.before(first).ok_or("nothing is remembered")?;
        let new = |expression: &Expression| {
            let shape = expression.drive.value.as_ref().map_or(Shape::Bool, |value| value.shape.clone());
            Series { label: expression.label.clone(), shape, samples: Vec::new() }
        };
        let mut series: Vec<Series> = expressions.iter().map(new).collect();
        loop {
            if (moment.tick - first).is_multiple_of(every) {
                let mission = moment.task.as_ref().filter(|task| task.is_mission());
                let mut known = mission.map_or_else(Vec::new, |task| self.names_of(&task.machine));
                known.extend_from_slice(moment.names());
                known.extend_from_slice(self.now.names());
                for (expression, series) in expressions.iter().zip(&mut series) {
                    let at = |named: &Named| known.iter().find(|known| known.name == named.name).cloned();
                    let there: Vec<Named> =
                        expression.known.iter().map(|named| at(named).unwrap_or_else(|| named.clone())).collect();
                    let value = self.value_in(&moment, &expression.drive, &there).ok();
                    let word = value.and_then(|(_, value)| value.words.first().copied());
                    series.samples.extend(word.filter(|word| word.is_finite()).map(|word| (moment.tick, word)));
                }
            }
            if moment.tick >= last || moment.is_over {
                return Ok(series);
            }
            self.past.go_on(&mut moment).map_err(|error| error.to_string())?;
            // What was begun then, or got a value, follows from no earlier moment.
            if let Some(pinned) = self.past.pinned_at(moment.tick) {
                moment = pinned.clone();
            }
        }
    }
}

/// Expressions between commas that stand in no bracket.
fn parts(text: &str) -> Vec<&str> {
    let (mut depth, mut begin, mut parts) = (0_i32, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[begin..at]);
                begin = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[begin..]);
    parts.into_iter().map(str::trim).filter(|part| !part.is_empty()).collect()
}

fn is_plotted(shape: &Shape) -> bool {
    use Shape::{Altitude, Bool, Depth, Enum, Heading, Int, Quantity};
    matches!(shape, Bool | Int | Quantity(_) | Heading | Depth | Altitude | Enum(_))
}

impl Series {
    /// The least and the greatest value, apart from one another. What is deeper is drawn lower.
    fn range(&self) -> (f64, f64) {
        let least = self.samples.iter().map(|(_, value)| *value).fold(f64::INFINITY, f64::min);
        let most = self.samples.iter().map(|(_, value)| *value).fold(f64::NEG_INFINITY, f64::max);
        let (least, most) = if least < most { (least, most) } else { (least - 0.5, least + 0.5) };
        if matches!(self.shape, Shape::Depth) { (most, least) } else { (least, most) }
    }

    fn told(&self, value: f64) -> String {
        number::value(&self.shape, &[value])
    }
}

/// A series as lines of letters, each with two by four dots.
fn drawn(series: &Series, (first, last): (u64, u64)) -> Vec<String> {
    if series.samples.is_empty() {
        return vec![format!("{}: never known", series.label)];
    }
    let (low, high) = series.range();
    let mut dots = vec![[false; WIDTH]; HEIGHT];
    let row = |value: f64| {
        let share = (value - low) / (high - low);
        ((1.0 - share) * (HEIGHT - 1) as f64).round().clamp(0.0, (HEIGHT - 1) as f64) as usize
    };
    let column = |tick: u64| ((tick - first) as usize * (WIDTH - 1)) / ((last - first).max(1) as usize);
    // What stands between two samples that follow one another is drawn with them.
    let mut before: Option<(usize, usize)> = None;
    for (tick, value) in &series.samples {
        let (x, y) = (column(*tick), row(*value));
        let from = before.filter(|(column, _)| x <= column + 1).map_or(y, |(_, row)| row);
        (from.min(y)..=from.max(y)).for_each(|y| dots[y][x] = true);
        before = Some((x, y));
    }
    let (top, bottom) = (series.told(high), series.told(low));
    let margin = top.chars().count().max(bottom.chars().count()).max(8);
    let rows = HEIGHT / 4;
    let mut lines = vec![format!("{:margin$} {}", "", series.label)];
    for line in 0..rows {
        let label = if line == 0 {
            &*top
        } else if line + 1 == rows {
            &*bottom
        } else {
            ""
        };
        let letters: String = (0..WIDTH / 2).map(|letter| braille(&dots, line, letter)).collect();
        lines.push(format!("{label:>margin$} {}", letters.trim_end_matches('\u{2800}')));
    }
    let (from, to) = (format!("{:.0} s", seconds(first)), format!("{:.0} s", seconds(last)));
    lines.push(format!("{:margin$} {from:<width$}{to}", "", width = (WIDTH / 2).saturating_sub(to.chars().count())));
    lines
}

/// The letter of two by four dots.
fn braille(dots: &[[bool; WIDTH]], line: usize, letter: usize) -> char {
    const BITS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
    let mut bits = 0;
    for (down, pair) in BITS.iter().enumerate() {
        for (right, bit) in pair.iter().enumerate() {
            if dots[line * 4 + down][letter * 2 + right] {
                bits |= bit;
            }
        }
    }
    char::from_u32(0x2800 + bits).unwrap_or(' ')
}

/// All series as a picture, one below the other.
fn picture(series: &[Series], (first, last): (u64, u64)) -> String {
    const PAGE: f64 = 900.0;
    const ROOM: f64 = 170.0;
    const PANEL: f64 = 120.0;
    const LEFT: f64 = 90.0;
    const RIGHT: f64 = 20.0;
    const LABEL: &str = "font-size=\"12\" fill=\"#222\"";
    let mut svg = Svg::new(PAGE, ROOM * series.len() as f64 + 20.0);
    let x = |tick: u64| LEFT + (PAGE - LEFT - RIGHT) * (tick - first) as f64 / (last - first).max(1) as f64;
    for (at, series) in series.iter().enumerate() {
        let top = ROOM * at as f64 + 30.0;
        svg.text((LEFT, top - 8.0), "font-size=\"13\" font-weight=\"bold\" fill=\"#1a1a1a\"", &series.label);
        svg.line((LEFT, top + PANEL), (PAGE - RIGHT, top + PANEL), "stroke=\"#888\"");
        svg.line((LEFT, top), (LEFT, top + PANEL), "stroke=\"#888\"");
        for (tick, anchor) in [(first, "start"), (last, "end")] {
            let place = (x(tick), top + PANEL + 16.0);
            svg.text(place, &format!("{LABEL} text-anchor=\"{anchor}\""), &format!("{:.1} s", seconds(tick)));
        }
        if series.samples.is_empty() {
            svg.text((LEFT + 10.0, top + PANEL / 2.0), LABEL, "never known");
            continue;
        }
        let (low, high) = series.range();
        let y = |value: f64| top + PANEL * (1.0 - (value - low) / (high - low));
        for value in [low, high] {
            let place = (LEFT - 6.0, y(value) + 4.0);
            svg.text(place, &format!("{LABEL} text-anchor=\"end\""), &series.told(value));
        }
        let points: Vec<(f64, f64)> = series.samples.iter().map(|(tick, value)| (x(*tick), y(*value))).collect();
        svg.path(&points, false, "fill=\"none\" stroke=\"#0b5fa5\" stroke-width=\"1.2\"");
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_stand_between_commas() {
        assert_eq!(parts("chemical, max(depth, 3 m) , "), ["chemical", "max(depth, 3 m)"]);
    }

    #[test]
    fn a_rising_line_goes_from_one_corner_to_the_other() {
        let samples = (0..=100).map(|tick| (tick, tick as f64)).collect();
        let series = Series { label: "x".into(), shape: Shape::Int, samples };
        let lines = drawn(&series, (0, 100));
        assert_eq!(lines.len(), HEIGHT / 4 + 2);
        assert!(lines[1].trim_start().starts_with("100") && lines[1].ends_with(|c| c != '\u{2800}'), "{lines:?}");
        let first = lines[HEIGHT / 4].chars().find(|c| ('\u{2801}'..='\u{28ff}').contains(c));
        assert!(first.is_some(), "{lines:?}");
    }
}
