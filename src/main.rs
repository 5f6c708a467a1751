//! The command line: one file a verb. All that concerns terminals, files written and exit codes is here.

mod called;
mod campaign;
mod check;
mod clock;
mod completions;
mod diff;
mod disk;
mod doc;
mod exit;
mod explain;
mod export;
mod fmt;
mod graph;
mod interruption;
mod live;
mod live_page;
mod made;
mod message;
mod moment;
mod new;
mod output;
mod past;
mod plan;
mod repl;
mod replay;
mod report;
mod run;
mod run_folder;
mod scenario;
mod shell;
mod speaker;
mod synced;
mod test;
mod vehicle;
mod why;
mod zoom;

use albacore_session::seen::one_line;
use clap::{CommandFactory, Parser, Subcommand};
use exit::Exit;
use std::ffi::OsString;
use std::process::ExitCode;

/// A mission scripting language for autonomous underwater vehicles.
#[derive(Parser)]
#[command(name = "albacore", version, about, propagate_version = true)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Create a project: a folder with a mission that runs, and its test.
    New(new::New),
    /// Check a mission script and run it.
    Run(run::Run),
    /// Check scripts and print every error and warning.
    Check(check::Check),
    /// Format scripts.
    Fmt(fmt::Fmt),
    /// Run the tests of scripts.
    Test(test::Test),
    /// Drive a vehicle line by line: a simulated one, or one at the end of a link.
    Repl(repl::Repl),
    /// Run a mission again on what its vehicle sensed, as it was or with changes.
    ///
    /// The machine is fed with the samples of the journal: bit for bit the same, or, with another script or parameter, until it does otherwise.
    Replay(replay::ReplayRun),
    /// Explain what a run decided: every switch, hold and abort, or what held at a time.
    Why(why::Why),
    /// Tell how two runs differ: what was done otherwise, and when.
    Diff(diff::Diff),
    /// Write a run for other programs: as a table, on a map, or as a log.
    ///
    /// All is read from the journal; of one that is cut short what is whole is written, and the offset is told.
    Export(export::Export),
    /// Show a run as one page: a map with its plume, timelines, diagrams, and every switch with its reason.
    ///
    /// The page needs no network and nothing else: it can be sent, kept on a stick, and printed. A moment of it has an address: `report.html#t=420`.
    Report(report::RunReport),
    /// Run a mission with many seeds, on all cores, and write a table.
    ///
    /// The table has a row for each seed, in order: the same bytes on any number of cores and after any interruption. The exit
    /// code is 0 when every seed was run, whatever the outcomes, and 1 when interrupted.
    Campaign(campaign::Campaigns),
    /// Draw the switching diagram of a strategy.
    Graph(graph::Graph),
    /// Make reference pages of scripts, from their declarations and comments.
    Doc(doc::Doc),
    /// Explain the code of an error or a warning.
    Explain(explain::Explain),
    /// Show a scenario: the value of every parameter, and a map.
    Scenario(scenario::Scenario),
    /// Serve a simulated vehicle over a link.
    Vehicle(vehicle::Vehicle),
    /// Print a script with which a shell completes verbs and options.
    ///
    /// For bash: `albacore completions bash > ~/.local/share/bash-completion/completions/albacore`.
    Completions(completions::Completions),
}

/// The same error of the arguments as they are shown: of others it would leave out what a terminal obeys, and quote nothing.
fn repeated(error: clap::Error) -> clap::Error {
    let shown = std::env::args_os().map(|argument| one_line(&argument.to_string_lossy()).into());
    Arguments::try_parse_from::<_, OsString>(shown).err().filter(|again| again.kind() == error.kind()).unwrap_or(error)
}

fn main() -> ExitCode {
    interruption::unblock();
    interruption::survive_file_limits();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no errors; a closed pipe is no crash.
            let usage = error.use_stderr();
            // What it repeats of the arguments may be anything; its help is ours, and has its styles.
            if usage {
                message::write(&repeated(error).render().to_string());
            } else {
                output::told(error.print());
            }
            return ExitCode::from(output::exit(if usage { Exit::Usage } else { Exit::Well }));
        }
    };
    let exit = match arguments.verb {
        Verb::New(new) => new.run(),
        Verb::Run(run) => run.run(),
        Verb::Check(check) => check.run(),
        Verb::Fmt(fmt) => fmt.run(),
        Verb::Test(test) => test.run(),
        Verb::Repl(repl) => repl.run(),
        Verb::Replay(replay) => replay.run(),
        Verb::Why(why) => why.run(),
        Verb::Diff(diff) => diff.run(),
        Verb::Export(export) => export.run(),
        Verb::Report(report) => report.run(),
        Verb::Campaign(campaign) => campaign.run(),
        Verb::Graph(graph) => graph.run(),
        Verb::Doc(doc) => doc.run(),
        Verb::Explain(explain) => explain.run(),
        Verb::Scenario(scenario) => scenario.run(),
        Verb::Vehicle(vehicle) => vehicle.run(),
        Verb::Completions(completions) => completions.run(Arguments::command()),
    };
    ExitCode::from(output::exit(exit))
}
