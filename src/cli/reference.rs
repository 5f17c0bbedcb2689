//! `opnav reference`: every key of a scenario.

use opnav::pipeline::scenario_reference;

/// Print every key of a scenario with its type, unit, default and meaning, in Markdown.
#[derive(Debug, clap::Args)]
pub struct Arguments {}

/// Prints the reference on standard output.
pub fn run(_: &Arguments) {
    print!("{}", scenario_reference());
}
