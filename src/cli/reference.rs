//! `opnav reference`: every key of a scenario and every setting of a command.

use clap::ValueEnum;

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
    #[cfg(feature = "scene")]
    Scenario,
    /// The settings of `track`, `land`, `tumble`, `montecarlo` and `demo`.
    #[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
    Settings,
}

impl Part {
    fn text(self) -> String {
        match self {
            #[cfg(feature = "scene")]
            Part::Scenario => opnav::pipeline::scenario_reference(),
            #[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
            Part::Settings => opnav::pipeline::settings_reference(),
        }
    }
}

/// Prints the reference on standard output.
pub fn run(arguments: &Arguments) {
    let parts = arguments.part.as_ref().map_or(Part::value_variants(), std::slice::from_ref);
    print!("{}", parts.iter().map(|part| part.text()).collect::<Vec<_>>().join("\n"));
}
