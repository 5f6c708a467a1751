//! A program behind limits that the shell sets: a file that may grow no further fails as a full disk does.

use std::path::Path;
use std::process::Command;

/// The same program in the same folder, after the shell has set what it is told: `ulimit -f 16`.
pub fn behind(setting: &str, program: &Command) -> Command {
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("{setting}; exec \"$0\" \"$@\"")]).arg(program.get_program()).args(program.get_args());
    shell.current_dir(program.get_current_dir().unwrap_or(Path::new(env!("CARGO_MANIFEST_DIR"))));
    shell
}
