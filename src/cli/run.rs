//! The command line as a whole: which subcommand, how errors end.

use super::progress::Terminal;
use super::{bench, demo, doctor, evaluate, export, land, map, montecarlo, reference, render, report, track, tumble};
use clap::{Parser, Subcommand};
use opnav::pipeline::PipelineError;
use std::process::ExitCode;

/// Optical navigation in deep space: render image sequences with exact truth, track them, navigate by them.
#[derive(Debug, Parser)]
#[command(name = "opnav", version, propagate_version = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
    /// Print errors and nothing else.
    #[arg(long, global = true)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    Doctor(doctor::Arguments),
    Demo(demo::Arguments),
    Render(render::Arguments),
    Track(track::Arguments),
    Land(Box<land::Arguments>),
    Map(map::Arguments),
    Montecarlo(montecarlo::Arguments),
    Tumble(tumble::Arguments),
    Evaluate(evaluate::Arguments),
    Report(report::Arguments),
    Bench(bench::Arguments),
    Export(export::Arguments),
    Reference(reference::Arguments),
}

/// Parses the command line and runs it: exit 0 done, 1 could not do it, 2 wrong usage.
pub fn run() -> ExitCode {
    let line = CommandLine::parse();
    let terminal = Terminal::new(line.quiet);
    match dispatch(line.command, &terminal) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn dispatch(command: Command, terminal: &Terminal) -> Result<ExitCode, PipelineError> {
    match command {
        Command::Doctor(arguments) => return Ok(doctor::run(&arguments)),
        Command::Demo(arguments) => demo::run(&arguments, terminal)?,
        Command::Render(arguments) => render::run(&arguments, terminal)?,
        Command::Track(arguments) => track::run(&arguments, terminal)?,
        Command::Land(arguments) => land::run(&arguments, terminal)?,
        Command::Map(arguments) => map::run(&arguments, terminal)?,
        Command::Montecarlo(arguments) => montecarlo::run(&arguments, terminal)?,
        Command::Tumble(arguments) => tumble::run(&arguments, terminal)?,
        Command::Evaluate(arguments) => evaluate::run(&arguments, terminal)?,
        Command::Report(arguments) => report::run(&arguments, terminal)?,
        Command::Bench(arguments) => bench::run(&arguments, terminal)?,
        Command::Export(arguments) => export::run(&arguments, terminal)?,
        Command::Reference(arguments) => reference::run(&arguments),
    }
    Ok(ExitCode::SUCCESS)
}
