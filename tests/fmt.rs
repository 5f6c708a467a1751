//! The formatter: what it makes of scripts, that it changes nothing but their looks, and the verb.
//!
//! Ten thousand broken, joined and spoilt scripts are formatted in every run.

#![expect(clippy::unwrap_used, reason = "a test whose scripts cannot be read has failed")]

use albacore_lang::diagnostic::{Diagnostic, Severity};
use albacore_lang::fmt::format;
use albacore_lang::source::FileId;
use albacore_lang::syntax::parse;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const FILE: FileId = FileId(0);

/// So many spoilt scripts, or as many as `SPOILT=N` says: 10,000 take 40 s on two cores.
const SPOILT: u64 = 1_000;
/// Scripts up to this size are spoilt.
const SPOILT_BYTES_MAX: usize = 6_000;

fn albacore(arguments: &[&str], folder: &Path, input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_albacore"))
        .arg("fmt")
        .args(arguments)
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn layouts() {
    insta::glob!("fmt/*.alb", |path| {
        let text = std::fs::read_to_string(path).unwrap();
        let output = albacore(&["-"], Path::new("."), &text);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        keeps(&path.display().to_string(), &text);
        insta::assert_snapshot!(String::from_utf8(output.stdout).unwrap());
    });
}

/// The scripts of the repository, and those in its reference.
fn scripts() -> Vec<(String, String)> {
    fn gather(folder: &Path, paths: &mut Vec<PathBuf>) {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            match path.is_dir() {
                true => gather(&path, paths),
                false => paths.extend(Some(path).filter(|path| path.extension().is_some_and(|e| e == "alb"))),
            }
        }
    }
    let mut paths = Vec::new();
    ["stdlib", "missions", "tests"].iter().for_each(|folder| gather(Path::new(folder), &mut paths));
    paths.sort();
    let read = |path: &PathBuf| (path.display().to_string(), std::fs::read_to_string(path).unwrap());
    let mut scripts: Vec<(String, String)> = paths.iter().map(read).collect();
    let page = std::fs::read_to_string("docs/language.md").unwrap();
    for (i, block) in page.split("\n```alb").skip(1).enumerate() {
        let (marks, text) = block.split_once('\n').unwrap();
        let (text, _) = text.split_once("\n```").unwrap();
        let text =
            if marks.contains("statements") { format!("mission m {{\n{text}\n}}\n") } else { format!("{text}\n") };
        scripts.push((format!("docs/language.md, example {}", i + 1), text));
    }
    assert!(scripts.len() > 120, "{}", scripts.len());
    scripts
}

/// A tree without the places of its nodes.
fn tree(text: &str) -> String {
    let tree = format!("{:?}", parse(FILE, text).file);
    let mut parts = tree.split("Span {");
    let first = parts.next().unwrap().to_string();
    parts.fold(first, |tree, part| tree + part.split_once('}').unwrap().1)
}

fn comments(text: &str) -> Vec<&str> {
    parse(FILE, text).concrete.comments().map(|c| text[c.start as usize..c.end as usize].trim_end()).collect()
}

/// Formats a text, and holds the result against it. Gives whether the text can be read.
#[track_caller]
fn keeps(name: &str, text: &str) -> bool {
    let Ok(formatted) = format(FILE, text) else {
        assert!(!parse(FILE, text).findings.is_empty());
        return false;
    };
    // What can be read may be warned of, before and after alike.
    let findings = parse(FILE, &formatted).findings;
    let said = |findings: &[Diagnostic]| findings.iter().map(|f| (f.severity, f.message.clone())).collect::<Vec<_>>();
    assert_eq!(said(&findings), said(&parse(FILE, text).findings), "{name}\n{text}\n----\n{formatted}");
    assert!(
        findings.iter().all(|f| f.severity == Severity::Warning),
        "{name}: {findings:?}\n{text}\n----\n{formatted}"
    );
    assert_eq!(tree(text), tree(&formatted), "{name}\n{text}\n----\n{formatted}");
    assert_eq!(comments(text), comments(&formatted), "{name}\n{text}\n----\n{formatted}");
    let again = format(FILE, &formatted).unwrap();
    assert!(again == formatted, "{name} is not stable\n{text}\n---- once\n{formatted}\n---- twice\n{again}");
    assert!(formatted.lines().all(|line| line == line.trim_end()), "{name}: blanks at the end of a line\n{formatted}");
    true
}

#[test]
fn every_script_keeps_its_tree_and_its_comments() {
    let read = scripts().iter().filter(|(name, text)| keeps(name, text)).count();
    assert!(read > 100, "{read}");
}

/// Numbers that depend on nothing but a count: SplitMix64.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % end.max(1) as u64) as usize
    }

    fn one_of<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.below(of.len())]
    }
}

/// Words, signs and what is blank between them; comments and texts are one piece each.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '°' | '.');
        let length = match first {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '"' => rest[1..].find(['"', '\n']).map_or(rest.len(), |at| at + 2),
            '\n' => 1,
            c if c.is_whitespace() => rest.find(|c: char| !c.is_whitespace() || c == '\n').unwrap_or(rest.len()),
            c if word(c) => rest.find(|c| !word(c)).unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        pieces.push(&rest[..length]);
        rest = &rest[length..];
    }
    pieces
}

/// Spoils a script in some places. What makes it unreadable is mostly taken back, for then there is nothing to be seen.
fn spoilt(text: &str, numbers: &mut Numbers) -> String {
    let mut text = text.to_string();
    for _ in 0..=numbers.below(12) {
        let next = spoilt_once(&text, numbers);
        let read = parse(FILE, &next).findings.is_empty();
        if read || numbers.below(40) == 0 {
            text = next;
        }
    }
    text
}

fn spoilt_once(text: &str, numbers: &mut Numbers) -> String {
    let mut pieces = pieces(text);
    for _ in 0..=numbers.below(3) {
        if pieces.is_empty() {
            break;
        }
        let at = numbers.below(pieces.len());
        let blank = pieces[at].trim().is_empty();
        match numbers.below(24) {
            0..=5 if blank => pieces[at] = numbers.one_of(&["", " ", "   ", "\t", "\r\n", "\n", "\n\n\n\n", "\n  \n"]),
            0..=5 => pieces.insert(at, numbers.one_of(&[" ", "    ", "\n", "\n\n", ";"])),
            6..=9 if pieces[at] == "\n" => {
                pieces[at] = numbers.one_of(&[" ", "; ", " // beside\n", "\n// alone\n", "\n\n"])
            }
            6..=9 => pieces
                .insert(at, numbers.one_of(&[" // in between\n", "\n// alone\n", "\n\n  //\n\n", " // a\n // b\n"])),
            10..=14 => {
                let after_sign = pieces.iter().skip(at).position(|p| matches!(*p, "," | "=" | "+" | "(" | "{" | "and"));
                let sign = at + after_sign.unwrap_or(0) + 1;
                let what = numbers.one_of(&["\n", "\n\n", "  ", " // after\n", "\n// under\n", "\n        "]);
                pieces.insert(sign.min(pieces.len()), what);
            }
            15 => drop(pieces.remove(at)),
            16 => pieces.insert(at, pieces[at]),
            17 => {
                let other = numbers.below(pieces.len());
                pieces.swap(at, other);
            }
            // Long names, which have to go elsewhere.
            18..=21 => {
                let names: Vec<usize> = (0..pieces.len())
                    .filter(|&i| pieces[i].len() > 2 && pieces[i].chars().all(|c| c.is_ascii_lowercase() || c == '_'))
                    .collect();
                let Some(&of) = names.get(numbers.below(names.len())) else { continue };
                let name = pieces[of];
                if parse(FILE, &format!("const {name} = 1")).findings.is_empty() {
                    let long = numbers.one_of(&[
                        "a",
                        "a_name_of_some_length",
                        "a_name_so_long_that_nobody_would_ever_write_it",
                    ]);
                    (at..pieces.len().min(at + 60))
                        .filter(|&i| pieces[i] == name)
                        .collect::<Vec<_>>()
                        .iter()
                        .for_each(|&i| pieces[i] = long);
                }
            }
            _ => {
                let end = pieces.len().min(at + 30);
                pieces[at..end].iter_mut().filter(|piece| **piece == "\n").for_each(|piece| *piece = " ");
            }
        }
    }
    pieces.concat()
}

/// Spoils one script after the other; tells how many of them can be read.
fn spoil(count: u64) -> u64 {
    let scripts: Vec<(String, String)> = scripts()
        .into_iter()
        .filter(|(_, text)| text.len() < SPOILT_BYTES_MAX && parse(FILE, text).findings.is_empty())
        .collect();
    let cores = std::thread::available_parallelism().unwrap().get() as u64;
    let scripts = &scripts;
    let read = |first: u64| {
        let numbered = (first..count).step_by(cores as usize).map(|i| {
            let mut numbers = Numbers(i.wrapping_mul(0x2545_f491_4f6c_dd1d));
            let (name, text) = &scripts[numbers.below(scripts.len())];
            u64::from(keeps(&format!("{name}, number {i}"), &spoilt(text, &mut numbers)))
        });
        numbered.sum::<u64>()
    };
    std::thread::scope(|scope| {
        let parts: Vec<_> = (0..cores).map(|first| scope.spawn(move || read(first))).collect();
        parts.into_iter().map(|part| part.join().unwrap()).sum()
    })
}

#[test]
fn spoilt_scripts_keep_their_trees_and_their_comments() {
    let count = std::env::var("SPOILT").ok().and_then(|n| n.parse().ok()).unwrap_or(SPOILT);
    let read = spoil(count);
    assert!(read > count / 2, "only {read} of {count} can be read");
}

/// What takes time in the square of these sizes does not end today.
#[test]
fn long_lines_and_deep_nesting_are_formatted() {
    let many = 2_000;
    let list = format!("const x = [{}]\n", "1 m,  2 m, ".repeat(many));
    let texts = [
        list.clone(),
        format!("{list}{list}"),
        format!("mission m {{ {} }}\n", "wait for 1 s; ".repeat(many)),
        format!("mission m {{\n{}}}\n", "  log \"a\"   // b\n".repeat(many)),
        format!("const x = f({}a{})\n", "[f(".repeat(30), ", b)]".repeat(30)),
        format!("const x = {}1\n", "a_long_name + ".repeat(100)),
        format!("mission m {{\n{}}}\n", "  a ->  b on c   do { log \"x\" }\n".repeat(many)),
        format!("fn f() -> Int {{ {}1{} }}\n", "if a { ".repeat(60), " } else { 2 }".repeat(60)),
    ];
    for text in texts {
        let formatted = format(FILE, &text).unwrap_or_else(|found| panic!("{}…: {:?}", &text[..40], found.first()));
        assert!(format(FILE, &formatted).is_ok_and(|again| again == formatted), "{}…", &text[..40]);
    }
}

/// An empty folder of a test's own.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fmt-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("deep/er")).unwrap();
    folder
}

#[test]
fn files_and_folders_are_written_only_if_they_change() {
    let folder = empty("write");
    let well = "const a = 1\n";
    std::fs::write(folder.join("well.alb"), well).unwrap();
    std::fs::write(folder.join("deep/er/other.alb"), "const  a=1").unwrap();
    std::fs::write(folder.join("deep/text.txt"), "const  a=1").unwrap();
    let modified = std::fs::metadata(folder.join("well.alb")).unwrap().modified().unwrap();
    let output = albacore(&[], &folder, "");
    assert_eq!((output.status.code(), output.stdout, output.stderr), (Some(0), Vec::new(), Vec::new()));
    assert_eq!(std::fs::read_to_string(folder.join("deep/er/other.alb")).unwrap(), well);
    assert_eq!(std::fs::read_to_string(folder.join("deep/text.txt")).unwrap(), "const  a=1");
    assert_eq!(std::fs::metadata(folder.join("well.alb")).unwrap().modified().unwrap(), modified);
    assert_eq!(std::fs::read_dir(folder.join("deep/er")).unwrap().count(), 1);
}

#[test]
fn what_cannot_be_read_is_told_and_left_alone() {
    let folder = empty("wrong");
    std::fs::write(folder.join("a.alb"), "const  a = (1\n").unwrap();
    std::fs::write(folder.join("b.alb"), "const  b = 1\n").unwrap();
    let output = albacore(&["."], &folder, "");
    assert_eq!(output.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&output.stderr).contains("a.alb:1"), "{output:?}");
    assert_eq!(std::fs::read_to_string(folder.join("a.alb")).unwrap(), "const  a = (1\n");
    assert_eq!(std::fs::read_to_string(folder.join("b.alb")).unwrap(), "const b = 1\n");
    assert_eq!(albacore(&["c.alb", "b.alb"], &folder, "").status.code(), Some(2));
    let output = albacore(&["-"], &folder, "const a = (1\n");
    assert_eq!((output.status.code(), output.stdout), (Some(3), Vec::new()));
}

#[test]
fn check_lists_what_would_change() {
    let folder = empty("check");
    std::fs::write(folder.join("a.alb"), "const b = 1\nconst  a = 1\n").unwrap();
    std::fs::write(folder.join("b.alb"), "const b = 1\n").unwrap();
    let output = albacore(&["--check", "b.alb", "a.alb"], &folder, "");
    assert_eq!(output.status.code(), Some(1));
    insta::assert_snapshot!(String::from_utf8(output.stdout).unwrap());
    assert_eq!(std::fs::read_to_string(folder.join("a.alb")).unwrap(), "const b = 1\nconst  a = 1\n");
    assert_eq!(albacore(&["--check", "b.alb"], &folder, "").status.code(), Some(0));
    assert_eq!(albacore(&["--check", "-"], &folder, "const  a = 1\n").status.code(), Some(1));
}

#[cfg(unix)]
#[test]
fn links_and_rights_stay() {
    use std::os::unix::fs::PermissionsExt;
    let folder = empty("links");
    let file = folder.join("deep/a.alb");
    std::fs::write(&file, "const  a = 1\n").unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink("deep/a.alb", folder.join("link.alb")).unwrap();
    assert_eq!(albacore(&["link.alb"], &folder, "").status.code(), Some(0));
    assert!(std::fs::symlink_metadata(folder.join("link.alb")).unwrap().is_symlink());
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "const a = 1\n");
    assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
}
