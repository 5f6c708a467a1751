//! `albacore new`: a project that runs and passes its tests at once.

mod name;

use crate::disk::{PartFolder, not_written, whole};
use crate::exit::Exit;
use crate::test::snapshot_file;
use crate::{interruption, message, output};
use albacore_session::{Faults, Script, Source, Sources, run_test};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// Start a project: a folder with a mission that runs, and its test.
#[derive(clap::Args)]
pub struct New {
    /// The folder to make; its mission and script are called like it, with `_` for `-`.
    #[arg(value_name = "NAME")]
    folder: PathBuf,
}

/// Why there is no new project, and how there can be one.
struct Refusal {
    exit: Exit,
    message: String,
    help: String,
}

impl Refusal {
    fn usage(message: String, help: String) -> Self {
        Refusal { exit: Exit::Usage, message, help }
    }

    fn taken(mission: &str) -> Self {
        let message = format!("`{mission}` cannot be the name of a mission: it means something else already");
        Refusal::usage(message, format!("try `{mission}_survey`"))
    }

    fn unwritable(folder: &Path, error: &io::Error) -> Self {
        let message = not_written(folder, error);
        Refusal { exit: Exit::Failed, message, help: "choose a folder where you may write, on a disk with room".into() }
    }
}

impl New {
    /// Makes the folder, and says what to do with it.
    pub fn run(&self) -> Exit {
        match make(&self.folder) {
            Ok(mission) => {
                let folder = self.folder.display();
                output::print(&format!(
                    "made `{folder}`: a mission, its world and its test, in {mission}.alb\n\n\
                     \x20   cd {folder}\n\
                     \x20   albacore run {mission}.alb\n\
                     \x20   albacore test\n\n\
                     README.md tells what else there is.\n"
                ));
                Exit::Well
            }
            Err(refusal) => {
                message::error(&refusal.message, Some(&refusal.help));
                refusal.exit
            }
        }
    }
}

/// Makes a project and gives the name of its mission. The folder is there whole or not at all.
fn make(folder: &Path) -> Result<String, Refusal> {
    let mission = name::mission(folder)?;
    if folder.symlink_metadata().is_ok() {
        let message = format!("there is already something called `{}`", folder.display());
        return Err(Refusal::usage(message, "choose another name, or move that away first".into()));
    }
    if let Some(parent) = folder.parent().filter(|p| !p.as_os_str().is_empty() && !p.is_dir()) {
        let message = format!("there is no folder `{}`", parent.display());
        return Err(Refusal::usage(message, "make it first, or give a name without a folder".into()));
    }
    let unwritable = |error: io::Error| Refusal::unwritable(folder, &error);
    let interrupted = interruption::flag();
    let part = PartFolder::beside(folder).map_err(unwritable)?;
    if !fill(part.path(), &mission).map_err(unwritable)? {
        return Err(Refusal::taken(&mission));
    }
    if interrupted.load(Ordering::Relaxed) {
        let help = "nothing was made; the same command begins anew".into();
        return Err(Refusal { exit: Exit::NotWell, message: "interrupted".into(), help });
    }
    part.become_folder(folder).map_err(unwritable)?;
    Ok(mission)
}

/// Writes the files of a project into an empty folder, and tells whether its script is sound. It is not when the mission's
/// name means something already, in the language or in the script: the checker knows.
fn fill(folder: &Path, mission: &str) -> io::Result<bool> {
    let named = |template: &str| template.replace("NAME", mission);
    let path = folder.join(format!("{mission}.alb"));
    whole(&folder.join("albacore.toml"), &named(include_str!("new/albacore.toml")))?;
    whole(&folder.join("README.md"), &named(include_str!("new/README.md")))?;
    whole(&folder.join(".gitignore"), include_str!("new/gitignore"))?;
    whole(&path, &laid_out(&named(include_str!("new/mission.alb"))))?;
    match albacore_session::load(&path, None, &[]) {
        Ok(script) if script.findings.is_empty() && albacore_session::findings(&script).is_empty() => {
            accept(&script, &path).map(|()| true)
        }
        _ => Ok(false),
    }
}

/// A long name may end a line elsewhere. What cannot be read is left as it is, for the checker to tell.
fn laid_out(text: &str) -> String {
    let file = Sources::default().add(Source { name: "mission.alb".into(), text: text.into() });
    albacore_session::format(file, text).unwrap_or_else(|_| text.to_string())
}

/// Writes the snapshots of a script's tests. They are made here and are no templates, for they hold the mission's name and
/// are aligned by it.
fn accept(script: &Script, path: &Path) -> io::Result<()> {
    for test in script.tests().into_iter().flatten() {
        // A test that cannot be run has no snapshot; `albacore test` tells why.
        let Ok(result) = run_test(script, &test, &Faults::default()) else { continue };
        // Nor has one that fails: what is not as expected is no pattern.
        if !result.failures.is_empty() {
            continue;
        }
        for (run, trace) in &result.traces {
            let file = snapshot_file(path, &result, run);
            file.parent().map_or(Ok(()), fs::create_dir_all)?;
            whole(&file, trace)?;
        }
    }
    Ok(())
}
