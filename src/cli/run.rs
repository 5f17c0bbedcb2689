//! The command line as a whole: which subcommand, how errors end.

#[cfg(all(feature = "render", feature = "vision", feature = "report"))]
use super::demo;
#[cfg(all(feature = "scene", feature = "report"))]
use super::montecarlo;
use super::progress::Terminal;
#[cfg(any(feature = "scene", feature = "vision"))]
use super::reference;
#[cfg(feature = "report")]
use super::report;
#[cfg(feature = "render")]
use super::{bench, map, render};
use super::{doctor, evaluate, export, missing};
#[cfg(feature = "vision")]
use super::{land, track, tumble};
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
    #[cfg(all(feature = "render", feature = "vision", feature = "report"))]
    Demo(demo::Arguments),
    #[cfg(feature = "render")]
    Render(render::Arguments),
    #[cfg(feature = "vision")]
    Track(track::Arguments),
    #[cfg(feature = "vision")]
    Land(Box<land::Arguments>),
    #[cfg(feature = "render")]
    Map(map::Arguments),
    #[cfg(all(feature = "scene", feature = "report"))]
    Montecarlo(montecarlo::Arguments),
    #[cfg(feature = "vision")]
    Tumble(tumble::Arguments),
    Evaluate(evaluate::Arguments),
    #[cfg(feature = "report")]
    Report(report::Arguments),
    #[cfg(feature = "render")]
    Bench(bench::Arguments),
    Export(export::Arguments),
    #[cfg(any(feature = "scene", feature = "vision"))]
    Reference(reference::Arguments),
}

/// Parses the command line and runs it: exit 0 done, 1 could not do it, 2 wrong usage.
pub fn run() -> ExitCode {
    let line = match CommandLine::try_parse() {
        Ok(line) => line,
        Err(error) => return refuse(&error),
    };
    let terminal = Terminal::new(line.quiet);
    match dispatch(line.command, &terminal) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Says what is wrong with the command line, or prints the help that was asked for.
fn refuse(error: &clap::Error) -> ExitCode {
    match missing::cure(error) {
        Some(cure) => {
            eprintln!("error: {cure}");
            ExitCode::from(2)
        }
        None => error.exit(),
    }
}

fn dispatch(command: Command, terminal: &Terminal) -> Result<ExitCode, PipelineError> {
    match command {
        Command::Doctor(arguments) => return Ok(doctor::run(&arguments)),
        #[cfg(all(feature = "render", feature = "vision", feature = "report"))]
        Command::Demo(arguments) => demo::run(&arguments, terminal)?,
        #[cfg(feature = "render")]
        Command::Render(arguments) => render::run(&arguments, terminal)?,
        #[cfg(feature = "vision")]
        Command::Track(arguments) => track::run(&arguments, terminal)?,
        #[cfg(feature = "vision")]
        Command::Land(arguments) => land::run(&arguments, terminal)?,
        #[cfg(feature = "render")]
        Command::Map(arguments) => map::run(&arguments, terminal)?,
        #[cfg(all(feature = "scene", feature = "report"))]
        Command::Montecarlo(arguments) => montecarlo::run(&arguments, terminal)?,
        #[cfg(feature = "vision")]
        Command::Tumble(arguments) => tumble::run(&arguments, terminal)?,
        Command::Evaluate(arguments) => evaluate::run(&arguments, terminal)?,
        #[cfg(feature = "report")]
        Command::Report(arguments) => report::run(&arguments, terminal)?,
        #[cfg(feature = "render")]
        Command::Bench(arguments) => bench::run(&arguments, terminal)?,
        Command::Export(arguments) => export::run(&arguments, terminal)?,
        #[cfg(any(feature = "scene", feature = "vision"))]
        Command::Reference(arguments) => reference::run(&arguments),
    }
    Ok(ExitCode::SUCCESS)
}
