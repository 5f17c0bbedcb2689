//! `opnav reference`: every key of a scenario and every setting of a command.

use clap::ValueEnum;
use opnav::pipeline::{scenario_reference, settings_reference};

/// Print every key of a scenario and every setting of the other commands with type, unit, default, range and meaning, in
/// Markdown.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// One part of it.
    #[arg(value_enum)]
    part: Option<Part>,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum Part {
    /// The keys of a scenario, which `render`, `map` and `bench` read.
    Scenario,
    /// The settings of `track`, `land`, `tumble`, `montecarlo` and `demo`.
    Settings,
}

/// Prints the reference on standard output.
pub fn run(arguments: &Arguments) {
    if arguments.part != Some(Part::Settings) {
        print!("{}", scenario_reference());
    }
    if arguments.part.is_none() {
        println!();
    }
    if arguments.part != Some(Part::Scenario) {
        print!("{}", settings_reference());
    }
}
