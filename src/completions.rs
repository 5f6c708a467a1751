//! `albacore completions`: what a shell wants to know to complete a command line.

use crate::{Arguments, exit::Exit, output};
use clap::CommandFactory;
use clap_complete::Shell;

/// Print the completions of a shell.
#[derive(clap::Args)]
pub struct Completions {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    /// Prints them.
    pub fn run(&self) -> Exit {
        // Into memory first: a pipe that is closed is no crash.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Arguments::command(), "albacore", &mut script);
        output::print(&String::from_utf8_lossy(&script));
        Exit::Well
    }
}
