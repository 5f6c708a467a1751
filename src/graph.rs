//! `albacore graph`: the switching diagram of a strategy.

use crate::exit::Exit;
use crate::made::{Comment, Made};
use crate::{disk, message, output, plan};
use albacore_session::diagram::{self, Diagram};
use std::path::PathBuf;

/// Draw the switching diagram of a strategy.
#[derive(clap::Args)]
pub struct Graph {
    /// The script: a path, or a module of the standard library by its bare name (`cpt`; a file of that name is `./cpt`).
    #[arg(value_name = "SCRIPT.alb")]
    script: PathBuf,
    /// The strategy, or the mission that has a table: `cpt_2005`, or `cpt.cpt_2005` of a script that imports it; else the
    /// only one in the script.
    name: Option<String>,
    /// How it is drawn.
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    format: Format,
    /// The file to write; else standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// A picture.
    Svg,
    /// For Graphviz.
    Dot,
    /// For Mermaid, in Markdown.
    Mermaid,
}

impl Graph {
    /// Draws it.
    pub fn run(&self) -> Exit {
        let script = match plan::script_or_module(&self.script) {
            Ok(script) => script,
            Err(exit) => return exit,
        };
        match script.diagram(self.name.as_deref()) {
            Ok(diagram) => match self.format.of(&diagram) {
                Some(text) => self.write(text),
                None => {
                    let (name, lines) = (&diagram.name, diagram.edges.len());
                    let help =
                        "`--format dot` leaves the drawing to Graphviz; fewer rules, or a table in parts, can be read";
                    message::error(
                        &format!("the diagram of `{name}` is too large to be drawn: {lines} lines"),
                        Some(help),
                    );
                    Exit::Usage
                }
            },
            Err(none) => {
                message::error(&none.message, none.help.as_deref());
                Exit::Usage
            }
        }
    }

    fn write(&self, text: String) -> Exit {
        let Some(path) = &self.out else {
            output::print_raw(&text);
            return Exit::Well;
        };
        match disk::remake(path, &Made::new(text, self.format.comment())) {
            Ok(()) => Exit::Well,
            Err(error) => {
                let help = "choose another file with `--out`";
                message::error(&disk::not_written(path, &error), Some(help));
                Exit::Failed
            }
        }
    }
}

impl Format {
    /// The text; none for a picture that is too large.
    fn of(self, diagram: &Diagram) -> Option<String> {
        match self {
            Format::Svg => diagram::svg(diagram),
            Format::Dot => Some(diagram::dot(diagram)),
            Format::Mermaid => Some(diagram::mermaid(diagram)),
        }
    }

    fn comment(self) -> Comment {
        match self {
            Format::Svg => Comment::Markup,
            Format::Dot => Comment::Slashes,
            Format::Mermaid => Comment::Percents,
        }
    }
}
