//! `albacore completions`: what a shell must know to complete verbs and options.

use crate::exit::Exit;
use crate::output;
use clap::Command;
use clap_complete::Shell;

/// Print a script with which a shell completes verbs and options.
#[derive(clap::Args)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    /// Prints the script for a command line. It is made in memory first: the generator takes a closed pipe for a crash.
    pub fn run(&self, mut command: Command) -> Exit {
        let mut script = Vec::new();
        let name = command.get_name().to_string();
        clap_complete::generate(self.shell, &mut command, name, &mut script);
        output::print_raw(&String::from_utf8_lossy(&script));
        Exit::Well
    }
}
