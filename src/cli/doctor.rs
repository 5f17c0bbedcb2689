//! `opnav doctor`: what was found, and what to do about what was not.

use opnav::pipeline::{Diagnosis, diagnose};
use std::process::ExitCode;

/// Say what was found on this machine (adapters, drivers, OpenCV) and what to do about what was not.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Prints the diagnosis; exit 1 if something is missing.
pub fn run(arguments: &Arguments) -> ExitCode {
    let diagnosis = diagnose();
    if arguments.json {
        println!("{}", serde_json::to_string_pretty(&diagnosis).expect("a diagnosis is plain data"));
    } else {
        print(&diagnosis);
    }
    if diagnosis.is_healthy() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn print(diagnosis: &Diagnosis) {
    println!("opnav    {}", diagnosis.opnav_version);
    println!("OpenCV   {}", diagnosis.opencv_version.as_deref().unwrap_or("not in this build: the feature `vision`"));
    println!("threads  {}", diagnosis.threads);
    #[cfg(not(feature = "render"))]
    println!("adapter  not in this build: the feature `render`");
    #[cfg(feature = "render")]
    for adapter in &diagnosis.adapters {
        let chosen = if diagnosis.default_adapter.as_ref() == Some(&adapter.name) { "  (default)" } else { "" };
        println!("adapter  {} [{}, {}] {}{chosen}", adapter.name, adapter.backend, adapter.device_type, adapter.driver);
    }
    for advice in &diagnosis.advice {
        println!("missing  {advice}");
    }
    if diagnosis.is_healthy() {
        println!("All that opnav needs is here.");
    }
}
