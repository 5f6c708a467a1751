//! `albacore new`: a project that runs, and whose tests pass.

use crate::exit::Exit;
use crate::{kept, message, output, test};
use albacore_session::{Script, Source};
use std::io;
use std::path::Path;

/// The word in the template that stands for the project's name.
const PLACEHOLDER: &str = "first_dive";

/// A name is no longer, so that the lines that it stands in are not too long either.
const NAME_MAX: usize = 40;

/// The files of a project. They are a project themselves, and stand here as such.
const TEMPLATE: [(&str, &str); 4] = [
    ("albacore.toml", include_str!("new/albacore.toml")),
    ("missions/first_dive.alb", include_str!("new/first_dive.alb")),
    ("README.md", include_str!("new/README.md")),
    (".gitignore", include_str!("new/gitignore")),
];

/// Begin a project: a mission with its world and its test.
#[derive(clap::Args)]
pub struct New {
    /// The folder to make, which is the mission's name too: letters, digits and `_`.
    name: String,
}

/// Why there is no project.
struct Refusal {
    exit: Exit,
    message: String,
    help: Option<String>,
}

impl New {
    /// Makes the folder, whole or not at all.
    pub fn run(&self) -> Exit {
        match self.make() {
            Ok(()) => {
                let name = &self.name;
                output::print(&format!(
                    "`{name}/` holds a mission, its world and its test, in `missions/{name}.alb`; next:\n\n  \
                     cd {name}\n  albacore test\n  albacore run missions/{name}.alb\n"
                ));
                Exit::Well
            }
            Err(refusal) => {
                message::error(&refusal.message, refusal.help.as_deref());
                refusal.exit
            }
        }
    }

    fn make(&self) -> Result<(), Refusal> {
        self.is_good_name()?;
        let folder = Path::new(&self.name);
        // A link that leads nowhere is there too.
        if folder.symlink_metadata().is_ok() {
            return Err(usage(format!("`{}` is there already", self.name), "choose another name, or remove it"));
        }
        // Made under another name first, so that nothing is ever half there.
        let part = format!(".{}.part", self.name);
        std::fs::create_dir(&part).map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => {
                usage(format!("`{part}` is there already"), "it is left of an attempt that was cut off: remove it")
            }
            _ => unwritable(&self.name, &error),
        })?;
        let made = self
            .fill(Path::new(&part))
            .and_then(|()| std::fs::rename(&part, folder).map_err(|error| unwritable(&self.name, &error)));
        if made.is_err() {
            // What cannot be removed either is told of at the next attempt.
            let _ = std::fs::remove_dir_all(&part);
        }
        made
    }

    /// A name that the checker takes too: some words mean something to every script.
    fn is_good_name(&self) -> Result<(), Refusal> {
        let name = &self.name;
        if name.chars().count() > NAME_MAX {
            return Err(usage(format!("this name is longer than {NAME_MAX} characters"), "choose a shorter one"));
        }
        let is_word = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
            && name.starts_with(|c: char| c.is_ascii_alphabetic());
        if !is_word {
            let better: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
            let better = better.trim_matches(|c: char| c == '_' || c.is_ascii_digit());
            let rule = "a name is letters, digits and `_`, and begins with a letter";
            let help = if better.is_empty() { rule.to_string() } else { format!("{rule}: `{better}`") };
            return Err(usage(format!("`{name}` is no good name for a mission"), &help));
        }
        let named = |text: &str| Source { name: format!("{name}.alb").into(), text: self.named(text).into() };
        let findings = TEMPLATE.iter().filter(|(path, _)| path.ends_with(".alb")).flat_map(|(_, text)| {
            let script: Script = albacore_session::load_text(named(text));
            script.findings
        });
        match findings.into_iter().next() {
            None => Ok(()),
            Some(finding) => {
                let message = format!("`{name}` is no good name for a mission: {}", finding.message);
                Err(usage(message, "choose a word that means nothing else in a script"))
            }
        }
    }

    /// Writes the files, and the trace that the mission's test compares: it names the mission, so it is made here.
    fn fill(&self, folder: &Path) -> Result<(), Refusal> {
        let failed = |error: io::Error| unwritable(&self.name, &error);
        for (path, text) in TEMPLATE {
            let path = folder.join(self.named(path));
            path.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(failed)?;
            kept::whole(&path, &self.named(text)).map_err(failed)?;
            if path.extension().is_some_and(|e| e == "alb") {
                self.accept(&path)?;
            }
        }
        Ok(())
    }

    fn accept(&self, path: &Path) -> Result<(), Refusal> {
        let broken = |what: String| Refusal { exit: Exit::Failed, message: what, help: None };
        let script = albacore_session::load(path, None, &[]).map_err(|error| broken(error.message))?;
        for test in script.tests() {
            let not_run = || broken(format!("the tests of `{}` cannot be run", self.name));
            let result = test.map_err(|_| not_run())?;
            let result = albacore_session::run_test(&script, &result).map_err(|_| not_run())?;
            for (seed, trace) in &result.traces {
                let file = test::snapshot_file(path, &result.name, *seed);
                let written = file.parent().map_or(Ok(()), std::fs::create_dir_all);
                let written = written.and_then(|()| kept::whole(&file, trace));
                written.map_err(|error| unwritable(&self.name, &error))?;
            }
        }
        Ok(())
    }

    fn named(&self, text: &str) -> String {
        text.replace(PLACEHOLDER, &self.name)
    }
}

fn usage(message: String, help: &str) -> Refusal {
    Refusal { exit: Exit::Usage, message, help: Some(help.into()) }
}

fn unwritable(name: &str, error: &io::Error) -> Refusal {
    let message = format!("the folder `{name}` cannot be written: {error}");
    Refusal { exit: Exit::Failed, message, help: None }
}
