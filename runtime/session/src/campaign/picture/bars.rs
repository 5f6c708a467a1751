//! Bars: how the runs ended, and what they finished with.

use super::{CASES_MAX, CasePicture};
use albacore_svg::{PALETTE, Svg, px, shortened};
use std::collections::BTreeMap;

/// So many words are told by name; the others are one bar.
const ROWS_MAX: usize = 7;
/// What the others are called.
const OTHERS: &str = "others";
/// The height of a bar, of one among several, and what lies between words, in pixels.
const BAR: f64 = 13.0;
const THIN_BAR: f64 = 9.0;
const BETWEEN: f64 = 7.0;
/// Room for a title, and for the words at the left, in pixels.
const TITLE: f64 = 24.0;
const WORDS: f64 = 118.0;
/// Room for counts at the right, in pixels.
const COUNTS: f64 = 52.0;

/// A group of bars: what of, and for each word how many of each case.
struct Group {
    title: &'static str,
    rows: Vec<(String, Vec<usize>)>,
}

/// All groups.
pub struct Bars {
    groups: Vec<Group>,
    most: usize,
    thickness: f64,
}

impl Bars {
    /// Those of some cases.
    pub fn new(cases: &[CasePicture]) -> Self {
        let thickness = if cases.len() > 1 { THIN_BAR } else { BAR };
        let groups = [
            group("how the runs ended", cases, |case| &case.outcomes),
            group("what they finished with", cases, |case| &case.results),
        ];
        let groups: Vec<Group> = groups.into_iter().filter(|group| !group.rows.is_empty()).collect();
        Bars { groups, most: cases.iter().map(|case| case.runs).max().unwrap_or(1).max(1), thickness }
    }

    fn row(&self, counts: &[usize]) -> f64 {
        self.thickness * counts.len() as f64 + BETWEEN
    }

    /// How high they are, in pixels.
    pub fn height(&self) -> f64 {
        let group = |group: &Group| TITLE + group.rows.iter().map(|(_, counts)| self.row(counts)).sum::<f64>() + 8.0;
        self.groups.iter().map(group).sum()
    }

    /// Draws them with their upper left corner there, so wide.
    pub fn draw(&self, svg: &mut Svg, (left, top): (f64, f64), width: f64) {
        let mut y = top;
        let length = width - WORDS - COUNTS;
        for group in &self.groups {
            svg.text((left, y + 4.0), "font-size=\"13\" font-weight=\"bold\" fill=\"#1a1a1a\"", group.title);
            y += TITLE - 10.0;
            for (word, counts) in &group.rows {
                let middle = y + self.thickness * counts.len() as f64 / 2.0;
                let word = shortened(word, WORDS - 8.0, 12.0);
                let at = (left + WORDS - 8.0, middle + 4.0);
                svg.text(at, "font-size=\"12\" text-anchor=\"end\" fill=\"#222\"", &word);
                for (case, count) in counts.iter().enumerate() {
                    let long = length * *count as f64 / self.most as f64;
                    let (x, bar) = (left + WORDS, y + self.thickness * case as f64);
                    if *count > 0 {
                        let (w, h) = (px(long.max(1.0)), px(self.thickness - 1.0));
                        let colour = PALETTE[case % CASES_MAX];
                        svg.raw(&format!(
                            "<rect x=\"{}\" y=\"{}\" width=\"{w}\" height=\"{h}\" fill=\"{colour}\"/>",
                            px(x),
                            px(bar)
                        ));
                    }
                    let size = if counts.len() > 1 { 9.0 } else { 11.0 };
                    let at = (x + long + 4.0, bar + self.thickness / 2.0 + size * 0.3);
                    svg.text(at, &format!("font-size=\"{size}\" fill=\"#444\""), &count.to_string());
                }
                y += self.row(counts);
            }
            y += 18.0;
        }
    }
}

/// The words of all cases, the most frequent first.
fn group(title: &'static str, cases: &[CasePicture], of: fn(&CasePicture) -> &BTreeMap<String, usize>) -> Group {
    let mut words: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (case, counts) in cases.iter().map(of).enumerate() {
        for (word, count) in counts {
            words.entry(word).or_insert_with(|| vec![0; cases.len()])[case] += count;
        }
    }
    let mut rows: Vec<(String, Vec<usize>)> =
        words.into_iter().map(|(word, counts)| (word.replace('_', " "), counts)).collect();
    rows.sort_by_key(|(_, counts)| std::cmp::Reverse(counts.iter().sum::<usize>()));
    if rows.len() > ROWS_MAX {
        let mut others = vec![0; cases.len()];
        for (_, counts) in rows.split_off(ROWS_MAX - 1) {
            others.iter_mut().zip(counts).for_each(|(all, count)| *all += count);
        }
        rows.push((OTHERS.to_string(), others));
    }
    Group { title, rows }
}

#[cfg(test)]
mod tests {
    use super::{Bars, CasePicture, ROWS_MAX};
    use albacore_svg::text_width;

    #[test]
    fn many_words_are_few_bars() {
        let outcomes = (0..40).map(|i| (format!("ended_{i}"), i)).collect();
        let bars = Bars::new(&[CasePicture { runs: 780, outcomes, ..CasePicture::default() }]);
        let rows = &bars.groups[0].rows;
        assert_eq!((rows.len(), rows[0].0.as_str(), rows[ROWS_MAX - 1].0.as_str()), (ROWS_MAX, "ended 39", "others"));
        assert_eq!(rows.iter().flat_map(|(_, counts)| counts).sum::<usize>(), 780);
        // The longest count has its room.
        assert!(text_width("1000000", 11.0) < super::COUNTS);
    }
}
