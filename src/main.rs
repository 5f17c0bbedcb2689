//! The command line: one file a subcommand in `cli/`; everything else is the library.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
