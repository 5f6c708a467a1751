//! What somebody does to one of a table's files, and what is said and done about it.

use crate::{ABORTING, command, empty, script, stderr, table};
use std::path::Path;

/// Does something to the text of a file, or removes it.
type Deed = fn(&[u8]) -> Option<Vec<u8>>;

/// What somebody does to one of a table's files.
const DEEDS: [(&str, Deed); 10] = [
    ("a short line appended", |text| Some([text, b"mine\n"].concat())),
    ("a long line appended", |text| Some([text, b"mine, and more of it\n"].concat())),
    ("the last line again", |text| Some([text, text.split_inclusive(|b| *b == b'\n').next_back().unwrap()].concat())),
    ("a line put between", |text| {
        let at = text.iter().position(|b| *b == b'\n').unwrap() + 1;
        Some([&text[..at], b"mine\n", &text[at..]].concat())
    }),
    ("a byte altered", |text| {
        // Of an origin in a digest: the names of scripts are as long as the way to them, and count for nothing.
        let mark = b"\"digest\": \"";
        let digest = text.windows(mark.len()).rposition(|word| word == mark).map(|at| at + mark.len());
        let (mut text, at) = (text.to_vec(), digest.unwrap_or(3 * text.len() / 5));
        text[at] = if text[at] == b'1' { b'2' } else { b'1' };
        Some(text)
    }),
    ("cut", |text| Some(text[..text.len() / 2].to_vec())),
    ("removed", |_| None),
    ("emptied", |_| Some(Vec::new())),
    ("the first line overwritten", |text| {
        let mut text = text.to_vec();
        text[..8].copy_from_slice(b"my notes");
        Some(text)
    }),
    ("all of it overwritten", |_| Some(b"my notes\nof today\n".to_vec())),
];

/// What a campaign that goes on says of it.
enum Says {
    /// It goes on, says so, and keeps what it found under these names.
    Mends(&'static str, &'static [&'static str]),
    /// It does not, and says how it could: with the file as it was, or with another.
    Refuses(&'static str),
}

/// Whatever was done to a table, its sums or its origin: it is told in one message, no byte of it is lost, the fix that is offered works,
/// and the table is then what it would have been.
#[test]
fn whatever_was_done_to_the_files_of_a_table_is_told_kept_and_mended() {
    use Says::{Mends, Refuses};
    let folder = empty("deeds");
    let mission = script(&folder, "aborting.alb", ABORTING);
    let whole = table(&mission, "1..8", &folder.join("whole.csv"), &[]);
    table(&mission, "1..5", &folder.join("five.csv"), &[]);
    let five = ["", ".sums", ".origin"].map(|suffix| std::fs::read(folder.join(format!("five.csv{suffix}"))).unwrap());
    let lines = "`t.csv` or its `.sums` was changed since it was written: line";
    let both = &["t.csv.found", "t.csv.found.sums"];
    let origin = Mends("`t.csv.origin` was changed since it was written", &["t.csv.found.origin"]);
    let unread = Refuses("`t.csv.origin`, which tells what it was made from, cannot be read");
    for (suffix, file) in ["", ".sums", ".origin"].into_iter().zip(&five) {
        for (deed, change) in DEEDS {
            let says = match (suffix, deed) {
                ("", "removed" | "emptied") => &Mends(lines, &["t.csv.found.sums"]),
                (".sums", "emptied") => &Mends(lines, &["t.csv.found"]),
                (".sums", "removed") => &Refuses("`t.csv` has no `.sums` beside it"),
                ("" | ".sums", _) => &Mends(lines, both),
                (_, "removed") => &Refuses("`t.csv` has no `.origin` beside it"),
                _ => &unread,
            };
            let (case, at) = (format!("{suffix} {deed}"), empty("deed"));
            let out = at.join("t.csv");
            for (suffix, bytes) in ["", ".sums", ".origin"].into_iter().zip(&five) {
                std::fs::write(at.join(format!("t.csv{suffix}")), bytes).unwrap();
            }
            let (path, changed) = (at.join(format!("t.csv{suffix}")), change(file));
            match &changed {
                Some(bytes) => std::fs::write(&path, bytes).unwrap(),
                None => std::fs::remove_file(&path).unwrap(),
            }
            is_told(&case, &mission, &out, says, &whole);
            if let Refuses(_) = says {
                // Nothing was touched, and both fixes work.
                assert_eq!(std::fs::read(&path).ok(), changed, "{case}");
                assert_eq!(table(&mission, "1..8", &at.join("anew.csv"), &[]), whole, "{case}");
                std::fs::write(&path, file).unwrap();
                assert_eq!(table(&mission, "1..8", &out, &["--resume"]), whole, "{case}");
            }
            let copies = |name: &str| name.contains(".found") && name.ends_with(suffix);
            let kept = std::fs::read_dir(&at).unwrap().map(|file| file.unwrap().path());
            let mut kept = kept.filter(|file| copies(&file.file_name().unwrap().to_string_lossy()));
            let is_kept = kept.any(|file| Some(std::fs::read(file).unwrap()) == changed);
            let is_none = changed.as_ref().is_none_or(Vec::is_empty);
            assert!(is_kept || is_none || matches!(says, Refuses(_)), "{case}: what was there is lost");
            // Then all is well.
            let output = command(&mission, "1..8", &out, &["--resume"]).output().unwrap();
            assert!(output.status.success() && !stderr(&output).contains("warning: "), "{case}: {}", stderr(&output));
        }
    }
    // An origin that says the same in other words, and one that says something else.
    let text = String::from_utf8(five[2].clone()).unwrap();
    for (case, text, says) in [
        ("laid out otherwise", text.replace("  ", " "), &origin),
        ("with a note", text.replacen('{', "{ \"note\": \"mine\",", 1), &origin),
        ("with another seed", text.replace("\"first_seed\": 1", "\"first_seed\": 2"), &unread),
        ("without its sum", text.replace("sum", "Sum"), &unread),
    ] {
        let out = empty("deed").join("t.csv");
        for (suffix, bytes) in ["", ".sums", ".origin"].into_iter().zip([&five[0], &five[1], text.as_bytes()]) {
            std::fs::write(out.with_extension(format!("csv{suffix}")), bytes).unwrap();
        }
        is_told(case, &mission, &out, says, &whole);
        if let Mends(..) = says {
            assert_eq!(std::fs::read_to_string(out.with_extension("csv.found.origin")).unwrap(), text);
            assert_eq!(std::fs::read(out.with_extension("csv.origin")).unwrap(), five[2]);
            // Where the table is gone too, and what is kept already is not kept twice.
            ["csv", "csv.sums"].iter().for_each(|of| std::fs::remove_file(out.with_extension(of)).unwrap());
            std::fs::write(out.with_extension("csv.origin"), &text).unwrap();
            is_told(case, &mission, &out, says, &whole);
        }
    }
}

/// Goes on with a table, and holds what is said to what was to be said.
#[track_caller]
fn is_told(case: &str, mission: &str, out: &Path, says: &Says, whole: &str) {
    let output = command(mission, "1..8", out, &["--resume"]).output().unwrap();
    let folder = out.parent().unwrap();
    let said = stderr(&output).replace(&format!("{}/", folder.display()), "");
    match says {
        Says::Mends(what, copies) => {
            assert_eq!(output.status.code(), Some(0), "{case}: {said}");
            assert_eq!(said.matches("warning: ").count(), 1, "{case}: {said}");
            assert!(said.contains(what), "{case}: {said}");
            assert_eq!(std::fs::read_to_string(out).unwrap(), whole, "{case}");
            let names = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
            let mut kept: Vec<String> = names.filter(|name| name.contains(".found")).collect();
            kept.sort();
            assert_eq!(kept, *copies, "{case}");
            assert!(copies.iter().all(|copy| said.contains(&format!("`{copy}`"))), "{case}: {said}");
        }
        Says::Refuses(what) => {
            assert_eq!(output.status.code(), Some(2), "{case}: {said}");
            assert!(said.contains(what), "{case}: {said}");
            assert!(said.contains("put that back as it was, or begin anew with another `--out`"), "{case}: {said}");
        }
    }
}
