//! The tutorial: what it says is typed, and prints what it says. `TUTORIAL=accept cargo test --test scripts tutorial::` writes what is
//! printed into it; `…` is kept for what differs from run to run.

#![expect(clippy::unwrap_used, reason = "a test that cannot write its own files has failed")]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const PAGE: &str = "docs/tutorial.md";

/// A folder in which it is followed.
struct Session {
    folder: PathBuf,
}

impl Session {
    fn new() -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tutorial");
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Session { folder }
    }

    /// What a command prints, both outputs in the order in which they came.
    fn run(&mut self, command: &str, typed: &[&str]) -> String {
        let words = words(command);
        if let ["cd", folder] = words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
            self.folder.push(folder);
            return String::new();
        }
        assert_eq!(words[0], "albacore", "only that is run: {command}");
        let out = self.folder.join(".printed");
        let both = std::fs::File::create(&out).unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_albacore"));
        child.args(&words[1..]).current_dir(&self.folder).env("NO_COLOR", "1").env("COLUMNS", "100");
        child.stdin(Stdio::piped()).stdout(both.try_clone().unwrap()).stderr(both);
        let mut child = child.spawn().unwrap();
        let mut input = child.stdin.take().unwrap();
        typed.iter().for_each(|line| writeln!(input, "{line}").unwrap());
        drop(input);
        child.wait().unwrap();
        let printed = std::fs::read_to_string(&out).unwrap();
        std::fs::remove_file(out).unwrap();
        printed
    }

    /// Changes a file as a difference says.
    fn change(&self, file: &str, lines: &[&str]) {
        let side = |mark: char| -> String {
            let kept = lines.iter().filter(|line| line.starts_with([' ', mark]) || line.is_empty());
            kept.map(|line| format!("{}\n", line.get(1..).unwrap_or_default())).collect()
        };
        let path = self.folder.join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        let (old, new) = (side('-'), side('+'));
        assert_eq!(text.matches(&old).count(), 1, "{file} has not once:\n{old}\n{text}");
        std::fs::write(path, text.replacen(&old, &new, 1)).unwrap();
    }
}

/// The words of a command; those in quotes are one.
fn words(command: &str) -> Vec<String> {
    let parts = command.split('"').enumerate();
    let words = parts.flat_map(|(at, part)| match at % 2 {
        0 => part.split_whitespace().map(String::from).collect::<Vec<_>>(),
        _ => vec![part.to_string()],
    });
    words.collect()
}

/// Whether a line is as it is told; `…` stands for anything.
fn is_line(told: &str, printed: &str) -> bool {
    let mut parts = told.split('…');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = printed.strip_prefix(first) else { return false };
    let mut last = "";
    for part in parts {
        last = part;
        let Some((_, after)) = rest.split_once(part) else { return false };
        rest = after;
    }
    rest.is_empty() || !told.contains('…') && rest.is_empty() || told.ends_with('…') && last.is_empty()
}

/// Whether all lines are as they are told; a line that is `…` stands for any number of them.
fn are_lines(told: &[&str], printed: &[&str]) -> bool {
    match (told.split_first(), printed.split_first()) {
        (None, None) => true,
        (Some((&"…", rest)), _) => (0..=printed.len()).any(|skipped| are_lines(rest, &printed[skipped..])),
        (Some((first, told)), Some((line, printed))) => is_line(first, line) && are_lines(told, printed),
        _ => false,
    }
}

/// What differs from run to run, left out.
fn masked(line: &str) -> String {
    let line = match line.split_once("of the vehicle's time in ") {
        Some((before, after)) => {
            let rest = after.split_once(" s").map_or("", |(_, rest)| rest);
            format!("{before}of the vehicle's time in … s{rest}")
        }
        None => line.to_string(),
    };
    match line.split_once(" s  ").filter(|_| line.starts_with("at ")) {
        Some((before, after)) if after.get(8..9) == Some("Z") => format!("{before} s  …{}", &after[9..]),
        _ => line,
    }
}

#[test]
fn what_the_tutorial_says_is_what_is_printed() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let accept = std::env::var("TUTORIAL").is_ok_and(|what| what == "accept");
    let (mut session, mut written, mut commands) = (Session::new(), String::new(), 0);
    let mut lines = page.lines().peekable();
    let mut file = None;
    while let Some(line) = lines.next() {
        written += &format!("{line}\n");
        if let Some(named) = line.strip_prefix("<!-- file: ") {
            file = named.strip_suffix(" -->");
        }
        let is_console = line == "```console";
        if !is_console && line != "```diff" {
            continue;
        }
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        if !is_console {
            session.change(file.take().unwrap(), &block);
            written += &format!("{}\n```\n", block.join("\n"));
            continue;
        }
        let begins: Vec<usize> = (0..block.len()).filter(|at| block[*at].starts_with("$ ")).collect();
        for (which, begin) in begins.iter().enumerate() {
            let end = begins.get(which + 1).copied().unwrap_or(block.len());
            let command = &block[*begin][2..];
            let (typed, told): (Vec<&str>, Vec<&str>) =
                block[begin + 1..end].iter().partition(|line| line.starts_with("> "));
            let typed: Vec<&str> = typed.into_iter().map(|line| &line[2..]).collect();
            let printed = session.run(command, &typed);
            let printed: Vec<&str> = printed.lines().collect();
            commands += 1;
            if are_lines(&told, &printed) {
                block[*begin..end].iter().for_each(|line| written += &format!("{line}\n"));
            } else if accept {
                written += &format!("$ {command}\n");
                typed.iter().for_each(|line| written += &format!("> {line}\n"));
                printed.iter().for_each(|line| written += &format!("{}\n", masked(line)));
            } else {
                panic!("`{command}` prints\n{}\nand the page says\n{}", printed.join("\n"), told.join("\n"));
            }
        }
        written += "```\n";
    }
    assert!(commands > 15, "{commands}");
    if accept {
        std::fs::write(PAGE, written).unwrap();
    }
}
