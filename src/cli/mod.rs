//! One file per subcommand: parse, call a pipeline, print.

mod arguments;
mod bench;
mod demo;
mod doctor;
mod evaluate;
mod export;
mod land;
mod map;
mod progress;
mod reference;
mod render;
mod report;
mod run;
mod track;
mod tumble;

pub use run::run;
