//! The page of a run: its template filled with what a run's report holds. Scripts and styles are ours and are in it; texts of others come
//! in as data, or escaped.

use crate::doc::escaped;
use albacore_session::RunReport;
use albacore_session::report_data::{Head, ReportData, ReportedRow};

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("report.css");
/// The scripts in the order in which they are run: each is a block of its own, and they share the one object `report`.
const SCRIPTS: [&str; 7] = [
    include_str!("data.js"),
    include_str!("moment.js"),
    include_str!("map.js"),
    include_str!("layers.js"),
    include_str!("marks.js"),
    include_str!("timelines.js"),
    include_str!("lists.js"),
];
/// ... of a run that goes on one more ...
const LIVE: &str = include_str!("live.js");
/// ... and the last of all.
const START: &str = include_str!("start.js");

/// Lines of the trace that are listed for who has no scripts.
const LISTED_MAX: usize = 2000;
/// What they are about.
const LISTED: [&str; 10] = ["switch", "resume", "stale", "fresh", "hold", "abort", "timeout", "limit", "report", "end"];

/// The page as a file holds it.
pub fn of(run: &RunReport) -> serde_json::Result<String> {
    let script = SCRIPTS.concat() + START;
    filled(&run.data, &Parts { connect: "", plain: &plain(run), script: &script })
}

/// The page of a run that goes on, from which it asks for more.
pub fn live(beginning: &ReportData) -> serde_json::Result<String> {
    let plain = "<p>Scripts are off, and this page of a run that goes on is made by them. After the run `albacore report` makes one that \
                 shows a picture without.</p>\n";
    let script = SCRIPTS.concat() + LIVE + START;
    filled(beginning, &Parts { connect: "; connect-src 'self'", plain, script: &script })
}

/// What of a page is other while the run goes on.
struct Parts<'a> {
    /// What the page may ask for.
    connect: &'a str,
    /// What there is without scripts.
    plain: &'a str,
    script: &'a str,
}

fn filled(run: &ReportData, parts: &Parts) -> serde_json::Result<String> {
    let data = embedded(&serde_json::to_string(run)?);
    let mut page = String::with_capacity(TEMPLATE.len() + data.len() + parts.script.len() + parts.plain.len());
    // In one pass: what is filled in is not looked through for more to fill in.
    let mut rest = TEMPLATE;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        page.push_str(before);
        match name {
            "title" => page.push_str(&escaped(&title(&run.head))),
            "style" => page.push_str(STYLE),
            "warning" => page.push_str(&warning(&run.head)),
            "head" => page.push_str(&head(&run.head)),
            "reports" => page.push_str(&reports(&run.reports, run.more_reports)),
            "connect" => page.push_str(parts.connect),
            "plain" => page.push_str(parts.plain),
            "data" => page.push_str(&data),
            "script" => page.push_str(parts.script),
            _ => {}
        }
        rest = after;
    }
    page.push_str(rest);
    Ok(page)
}

/// JSON as it may stand in a script element: nothing in it ends that, or a line.
fn embedded(json: &str) -> String {
    json.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

/// The page in one line.
pub fn title(head: &Head) -> String {
    let world =
        if head.is_link { "on a link".to_string() } else { format!("in {}, seed {}", head.scenario, head.seed) };
    format!("{} {world}: {}", head.mission, head.outcome)
}

fn warning(head: &Head) -> String {
    let text = |cut: &String| {
        format!("<p class=\"warning\" role=\"alert\">This run is not shown to its end: {}.</p>\n", escaped(cut))
    };
    head.cut.as_ref().map(text).unwrap_or_default()
}

/// What was run and how it ended, as a list of terms.
pub fn head(head: &Head) -> String {
    let reason = if head.reason.is_empty() { String::new() } else { format!(": {}", head.reason) };
    let world = if head.is_link { "link" } else { "scenario" };
    let mut rows = vec![
        ("mission", head.mission.clone()),
        (world, head.scenario.clone()),
        ("outcome", format!("{}{reason}", head.outcome)),
        ("time", format!("{} ({:.1} s)", clock(head.time_s), head.time_s)),
        ("way over ground", format!("{:.0} m", head.path_m)),
        ("switches", head.switches.to_string()),
        ("holds", head.holds.to_string()),
    ];
    if !head.is_link {
        rows.insert(2, ("seed", head.seed.to_string()));
    }
    if !head.set.is_empty() {
        rows.push(("changed", head.set.join(", ")));
    }
    rows.extend(head.origin.clone().map(|origin| ("origin (0, 0)", origin)));
    rows.extend(head.first_tick.clone().map(|moment| ("clock at 0", moment)));
    match head.digest.as_str() {
        // It comes with the end.
        "" if head.cut.is_none() => {}
        "" => rows.push(("digest", "none: its end is not known".to_string())),
        digest => rows.push(("digest", digest.to_string())),
    }
    let row = |(term, text): &(&str, String)| format!("<div><dt>{term}</dt><dd>{}</dd></div>\n", escaped(text));
    rows.iter().map(row).collect()
}

/// Hours, minutes and seconds.
fn clock(time_s: f64) -> String {
    let whole = time_s as u64;
    let (hours, minutes, seconds) = (whole / 3600, whole / 60 % 60, whole % 60);
    if hours > 0 {
        format!("{hours} h {minutes:02} min {seconds:02} s")
    } else {
        format!("{minutes} min {seconds:02} s")
    }
}

/// The table of what was reported.
pub fn reports(rows: &[ReportedRow], more: u64) -> String {
    if rows.is_empty() {
        return "<p>Nothing was reported.</p>\n".to_string();
    }
    let has_place = rows.iter().any(|row| row.north.is_some());
    let has_error = rows.iter().any(|row| row.error.is_some());
    let has_globe = rows.iter().any(|row| row.globe.is_some());
    let heads = [
        (true, "report"),
        (true, "time, s"),
        (has_place, "north, m"),
        (has_place, "east, m"),
        (has_globe, "latitude, longitude"),
        (has_error, "error, m"),
        (true, "what"),
    ];
    let head: String = heads.iter().filter(|(is, _)| *is).map(|(_, text)| format!("<th>{text}</th>")).collect();
    let body: String = rows.iter().map(|row| reported(row, has_place, has_globe, has_error)).collect();
    let more = match more {
        0 => String::new(),
        more => format!("<p>{more} more reports are in the trace.</p>\n"),
    };
    format!(
        "<div class=\"wide\"><table id=\"reports\">\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n{more}"
    )
}

fn reported(row: &ReportedRow, has_place: bool, has_globe: bool, has_error: bool) -> String {
    // Adding a zero takes the sign from one.
    let number = |x: Option<f64>| x.map(|x| format!("{:.1}", (x * 10.0).round() / 10.0 + 0.0)).unwrap_or_default();
    let mut cells = vec![("", row.name.clone()), ("n", format!("{:.1}", row.t))];
    if has_place {
        cells.extend([("n", number(row.north)), ("n", number(row.east))]);
    }
    if has_globe {
        cells.push(("", row.globe.clone().unwrap_or_default()));
    }
    if has_error {
        let from = row.error_from.filter(|_| row.error.is_some()).map(|from| format!(" from {from}"));
        cells.push(("", format!("{}{}", number(row.error), from.unwrap_or_default())));
    }
    cells.push(("", row.told.clone()));
    let cell = |(class, text): &(&str, String)| match *class {
        "" => format!("<td>{}</td>", escaped(text)),
        class => format!("<td class=\"{class}\">{}</td>", escaped(text)),
    };
    format!("<tr data-t=\"{:.1}\">{}</tr>\n", row.t, cells.iter().map(cell).collect::<String>())
}

/// What there is for who has no scripts.
fn plain(run: &RunReport) -> String {
    format!(
        "<section>\n<p>Scripts are off: this is the picture of the whole run, and what it did. With scripts the page has a map in time, \
         timelines and diagrams.</p>\n<figure>\n{}</figure>\n<h2>What happened</h2>\n<div class=\"wide\"><table>\n\
         <thead><tr><th>time, s</th><th>what</th><th>which, where and why</th></tr></thead>\n<tbody>\n{}</tbody>\n</table></div>\n\
         </section>\n",
        run.picture,
        listed(run)
    )
}

/// The lines of the trace that tell most, for who has no scripts.
fn listed(run: &RunReport) -> String {
    let told = run.data.happenings.iter().filter(|line| LISTED.contains(&line.verb.as_str()));
    let row = |line: &albacore_session::report_data::Happening| {
        let time = line.tick as f64 / 10.0;
        format!(
            "<tr><td class=\"n\">{time:.1}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&line.verb),
            escaped(&line.text)
        )
    };
    told.take(LISTED_MAX).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::{LIVE, SCRIPTS, START, STYLE, TEMPLATE, clock, embedded};

    #[test]
    fn no_data_ends_its_element() {
        let text = embedded("{\"name\":\"</script><script>alert(1)</script>\u{2028}&<!--\"}");
        assert!(!text.contains(['<', '>', '&', '\u{2028}']), "{text}");
        let back: serde_json::Value = serde_json::from_str(&text).unwrap_or_default();
        assert_eq!(back["name"], "</script><script>alert(1)</script>\u{2028}&<!--");
    }

    /// What is ours does not end the element that it stands in, and has nothing that is filled in.
    #[test]
    fn our_own_parts_fit_into_the_page() {
        for part in SCRIPTS.iter().chain([&LIVE, &START, &STYLE]) {
            assert!(!part.contains("</") && !part.contains("{{") && !part.contains("<!--"));
        }
        assert_eq!(TEMPLATE.matches("{{").count(), 10);
    }

    #[test]
    fn a_time_is_told_in_hours() {
        assert_eq!([clock(59.9), clock(61.0), clock(7322.0)], ["0 min 59 s", "1 min 01 s", "2 h 02 min 02 s"]);
    }
}
