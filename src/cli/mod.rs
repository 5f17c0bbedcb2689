//! One file per subcommand: parse, call a pipeline, print.

mod arguments;
mod bench;
mod demo;
mod doctor;
mod evaluate;
mod export;
mod land;
mod landing_options;
mod map;
mod montecarlo;
mod progress;
mod reference;
mod render;
mod report;
mod run;
mod settings_arguments;
mod track;
mod tumble;

pub use run::run;
