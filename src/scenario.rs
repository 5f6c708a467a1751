//! `albacore scenario show`: the values of a scenario, and its map.

use crate::campaign::seeds;
use crate::exit::Exit;
use crate::made::{Comment, Made};
use crate::output::Lines;
use crate::plan::{refused, scenario_script};
use crate::{disk, message};
use albacore_session::{Shown, ValueSource};
use std::path::{Path, PathBuf};

/// Show a scenario.
#[derive(clap::Args)]
pub struct Scenario {
    #[command(subcommand)]
    action: Action,
}

#[derive(clap::Subcommand)]
enum Action {
    /// Draw the scenario as it is when a run begins, and list the value of every parameter, defaults included.
    Show(Show),
}

#[derive(clap::Args)]
struct Show {
    /// The scenario: one that every script knows, or one of a script.
    #[arg(value_name = "SCENARIO | SCRIPT.alb[#SCENARIO]")]
    scenario: String,
    /// The seed of the picture.
    #[arg(long, default_value_t = 1, value_parser = seeds::one, allow_negative_numbers = true)]
    seed: u64,
    /// Change a parameter: `duck_2003.step=2s`.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The picture's file [default: albacore-runs/SCENARIO-SEED/scenario.svg].
    #[arg(long, value_name = "FILE.svg", conflicts_with = "no_out")]
    out: Option<PathBuf>,
    /// Write no picture.
    #[arg(long)]
    no_out: bool,
}

/// Columns of a listing: the parameter's name, and its value.
const NAME: usize = 18;
const VALUE: usize = 40;

impl Scenario {
    /// Does what is asked.
    pub fn run(&self) -> Exit {
        match &self.action {
            Action::Show(show) => show.run(),
        }
    }
}

impl Show {
    fn run(&self) -> Exit {
        let shown = scenario_script(&self.scenario, &self.set).and_then(|(script, file, name)| {
            Shown::new(&script, file, name, self.seed).map_err(|error| refused(&error))
        });
        let shown = match shown {
            Ok(shown) => shown,
            Err(exit) => return exit,
        };
        listing(&shown).print();
        if self.no_out { Exit::Well } else { self.write(&shown) }
    }

    fn write(&self, shown: &Shown) -> Exit {
        let usual = || Path::new("albacore-runs").join(format!("{}-{}", shown.name, self.seed)).join("scenario.svg");
        let path = self.out.clone().unwrap_or_else(usual);
        // A folder that somebody names is there, or mistyped.
        let folder = if self.out.is_none() { path.parent() } else { None };
        let made = folder.map_or(Ok(()), std::fs::create_dir_all);
        let picture = Made::new(shown.svg.clone(), Comment::Markup);
        match made.and_then(|()| disk::remake(&path, &picture)) {
            Ok(()) => {
                let mut lines = Lines::default();
                lines.add(&format!("picture {}", path.display()));
                lines.print();
                Exit::Well
            }
            Err(error) => {
                let help = "choose another file with `--out`";
                message::error(&disk::not_written(&path, &error), Some(help));
                Exit::Failed
            }
        }
    }
}

/// All numbers, clause by clause.
fn listing(shown: &Shown) -> Lines {
    let mut lines = Lines::default();
    let like = match shown.bases.as_slice() {
        [] => String::new(),
        bases => format!("  (like {})", bases.join(", which is like ")),
    };
    lines.add(&format!("scenario {}{like}", shown.name));
    for clause in &shown.clauses {
        let unsaid = match clause.source {
            ValueSource::Said => "",
            ValueSource::Default => "  (not said)",
            ValueSource::Record => "  (of the record)",
        };
        lines.add("");
        lines.add(&format!("{}{unsaid}", clause.name));
        for (name, value, source) in &clause.values {
            let mark = match source {
                ValueSource::Said => "",
                ValueSource::Default => "default",
                ValueSource::Record => "record",
            };
            for (i, line) in value.lines().enumerate() {
                let name = if i == 0 { name } else { "" };
                lines.add(format!("  {name:NAME$}{line:VALUE$}{mark}").trim_end());
            }
        }
    }
    lines.add("");
    lines.add(&format!("none of: {}", shown.absent.join(", ")));
    if let Some(filaments) = shown.filaments {
        lines.add(&format!("{filaments} filaments when the run begins"));
    }
    lines
}
