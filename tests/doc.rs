//! `albacore doc`: the pages of the standard library are those that are checked in, all of it is told, and links lead somewhere.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use albacore_session::{Source, doc, standard_modules};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What `albacore doc --out docs/stdlib` makes.
const PAGES: &str = "docs/stdlib";

/// An empty folder of a test's own, with scripts.
fn folder(name: &str, scripts: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("doc-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for (file, text) in scripts {
        std::fs::write(folder.join(file), text).unwrap();
    }
    folder
}

/// What `albacore doc` ends with, prints and says.
fn doc_in(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_albacore"));
    command.arg("doc").args(arguments).current_dir(folder).env("NO_COLOR", "1").stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// The files of a folder, by name.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let named = |entry: std::io::Result<std::fs::DirEntry>| {
        let path = entry.unwrap().path();
        (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(&path).unwrap())
    };
    std::fs::read_dir(folder).unwrap().map(named).collect()
}

/// All that stands between two marks.
fn between<'a>(text: &'a str, open: &str, close: char) -> Vec<&'a str> {
    text.split(open).skip(1).filter_map(|rest| rest.split(close).next()).collect()
}

#[test]
fn the_pages_of_the_standard_library_are_what_doc_gives() {
    let folder = folder("checked_in", &[]);
    assert_eq!(doc_in(&folder, &["--out", "pages"]), (Some(0), String::new(), String::new()));
    let (made, kept) = (files(&folder.join("pages")), files(Path::new(PAGES)));
    assert_eq!(made.keys().collect::<Vec<_>>(), kept.keys().collect::<Vec<_>>());
    for (name, text) in made {
        assert!(kept[&name] == text, "{name} is not what `albacore doc --out {PAGES}` gives");
    }
}

#[test]
fn the_standard_library_says_what_everything_is() {
    for name in standard_modules() {
        let file = format!("stdlib/{name}.alb");
        let text = std::fs::read_to_string(&file).unwrap();
        let page = doc::page(&Source { name: file.as_str().into(), text: text.as_str().into() }).unwrap();
        assert!(!page.text.is_empty(), "{file} says nothing of itself");
        let silent: Vec<&str> =
            page.declarations.iter().filter(|d| d.text.is_empty()).map(|d| d.name.as_str()).collect();
        assert!(silent.is_empty(), "{file} says nothing of {}", silent.join(", "));
        let stray: Vec<&str> = page.stray.iter().map(|s| &text[s.start as usize..s.end as usize]).collect();
        assert!(stray.is_empty(), "{file}: these belong to nothing: {}", stray.join(", "));
    }
}

#[test]
fn every_link_of_the_pages_leads_somewhere() {
    let folder = folder("links", &[]);
    assert_eq!(doc_in(&folder, &["--format", "html", "--out", "pages"]).0, Some(0));
    let pages = files(&folder.join("pages"));
    let mut between_pages = 0;
    for (name, text) in &pages {
        for link in between(text, "href=\"", '"') {
            let (page, anchor) = link.split_once('#').unwrap_or((link, ""));
            let to = if page.is_empty() { name } else { page };
            let found = pages.get(to).is_some_and(|p| anchor.is_empty() || p.contains(&format!("id=\"{anchor}\"")));
            assert!(found, "{name} leads to {link}");
            between_pages += usize::from(!page.is_empty());
        }
    }
    assert!(between_pages > 30, "{between_pages} links from page to page");
    // The same links in Markdown, whose anchors a forge makes of the headings.
    for (name, text) in files(Path::new(PAGES)) {
        for link in between(&text, "](", ')') {
            let (page, anchor) = link.split_once('#').unwrap_or((link, ""));
            let to = if page.is_empty() { text.clone() } else { files(Path::new(PAGES))[page].clone() };
            let mut anchors =
                to.lines().filter_map(|l| l.strip_prefix("## ")).map(|h| h.to_lowercase().replace(' ', "-"));
            assert!(anchor.is_empty() || anchors.any(|a| a == anchor), "{name} leads to {link}");
        }
    }
}

/// Some names have two meanings: a sensor, which `fault(…)` takes, and the input that comes of it.
#[test]
fn a_name_leads_to_what_is_meant_where_it_stands() {
    let folder = folder("meant", &[]);
    assert_eq!(doc_in(&folder, &["--format", "html", "--out", "pages"]).0, Some(0));
    let pages = files(&folder.join("pages"));
    for (page, link) in [
        ("instruments", "from which <a href=\"inputs.html#input-altitude\"><code>altitude</code></a> and"),
        ("instruments", "from which <a href=\"inputs.html#input-speed\"><code>speed</code></a> and"),
        ("instruments", "<code>up</code></a>, <a href=\"#clause-down\"><code>down</code></a> or"),
        ("faults", "which: <a href=\"#clause-position\"><code>position</code></a>,"),
        ("faults", "Of <a href=\"#clause-heading\"><code>heading</code></a>:"),
        ("faults", "of a <a href=\"craft.html#clause-fossen\"><code>fossen</code></a>"),
        ("inputs", "<a href=\"#input-chemical\"><code>chemical</code></a>"),
    ] {
        assert!(pages[&format!("{page}.html")].contains(link), "{page}: {link}");
    }
    let to_sensors: Vec<&String> =
        pages.iter().filter(|(_, text)| text.contains("faults.html#clause-")).map(|(name, _)| name).collect();
    assert!(to_sensors.is_empty(), "nothing but a fault speaks of sensors: {to_sensors:?}");
}

/// A script whose comments would do things to a page, and two tables.
const SCRIPT: &str = r#"
//! A <b>page</b> <script>alert(1)</script> of `tour`, and [a link](javascript:x).

/// Where to go; or `nowhere`, a | b.
record Stop { at: Point, long: Bool }

/// <img src="http://example.com/x.png"> ![](http://example.com/y.png)
strategy tour(to: Stop, patience: Duration = 1 min in 1 s..1 h) -> Stop {
    with depth 3 m, speed 1 m/s
    signal near = distance(to.at, position) < 5 m and depth > 2 m
    behavior go { goto to.at }
    behavior wait_there { hold }        // a while
    start go
    go -> wait_there on done or near
    wait_there -> finish to on after patience
}

/// Belongs to nothing.

fn twice(n: Int) -> Int { 2 * n }
"#;

#[test]
fn a_page_is_self_contained_and_does_what_no_comment_says() {
    let folder = folder("page", &[("page.alb", SCRIPT)]);
    let (code, html, said) = doc_in(&folder, &["page.alb", "--format", "html"]);
    assert_eq!(code, Some(0), "{said}");
    assert_eq!(said, "page.alb:18: this comment is on no page: it stands right above nothing\n");
    for never in ["<script", "<img", "<b>", "javascript:", "<link", "index.html"] {
        assert!(!html.contains(never), "{never} stands in the page");
    }
    assert_eq!(between(&html, "<figure>\n<svg ", '>').len(), 1);
    // The type, the input and the table's own function are linked where they are on the page.
    assert!(html.contains("Finishes with <a href=\"#record-stop\"><code>Stop</code></a>."), "{html}");
    assert!(html.contains("<a href=\"#strategy-tour\"><code>tour</code></a>"), "{html}");
    let (code, markdown, _) = doc_in(&folder, &["./page.alb"]);
    assert_eq!(code, Some(0));
    assert!(markdown.contains("| `patience` | `Duration` | `1 min` | `1 s..1 h` |\n"), "{markdown}");
    assert!(markdown.contains("| `wait_there` | a while |\n"), "{markdown}");
    assert!(markdown.contains("`nowhere`, a \\| b."), "{markdown}");
    assert!(!markdown.contains("<figure>") && !markdown.contains("```diagram"), "{markdown}");
}

#[test]
fn what_cannot_be_told_is_said_and_nothing_is_written() {
    let folder = folder("refused", &[("wrong.alb", "mission {"), ("right.alb", "/// One.\nconst one = 1\n")]);
    assert_eq!(doc_in(&folder, &[".", "--out", "pages"]).0, Some(3));
    assert!(!folder.join("pages").exists());
    let (code, out, said) = doc_in(&folder, &["--format", "html"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(said.contains("`--out`"), "{said}");
    let (code, _, said) = doc_in(&folder, &["ctp"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("did you mean `cpt`?"), "{said}");
    std::fs::remove_file(folder.join("wrong.alb")).unwrap();
    assert_eq!(doc_in(&folder, &[".", "--out", "pages"]), (Some(0), String::new(), String::new()));
    assert_eq!(files(&folder.join("pages")).keys().collect::<Vec<_>>(), ["index.md", "right.md"]);
    // A script among the pages is no folder to write into.
    let (code, _, said) = doc_in(&folder, &["right.alb", "--out", "right.alb"]);
    assert_eq!(code, Some(4));
    assert!(said.contains("cannot be written"), "{said}");
}

#[test]
fn one_page_that_cannot_be_written_keeps_all_as_they_are() {
    let script = |what: &str| format!("/// {what}.\nconst one = 1\n");
    let (a, b) = (script("Old"), script("Old"));
    let folder = folder("all-or-none", &[("a.alb", &a), ("b.alb", &b)]);
    assert_eq!(doc_in(&folder, &[".", "--out", "pages"]).0, Some(0));
    for name in ["a.alb", "b.alb"] {
        std::fs::write(folder.join(name), script("New")).unwrap();
    }
    std::fs::remove_file(folder.join("pages/b.md")).unwrap();
    std::fs::create_dir(folder.join("pages/b.md")).unwrap();
    let (code, _, said) = doc_in(&folder, &[".", "--out", "pages"]);
    assert!(code == Some(4) && said.contains("b.md"), "{code:?} {said}");
    assert!(std::fs::read_to_string(folder.join("pages/a.md")).unwrap().contains("Old"));
}
