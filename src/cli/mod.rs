//! One file a subcommand: its arguments, a call of a story in `opnav::pipeline`, and what is printed. `run` joins them and
//! says how errors end, `missing` what a build without some feature leaves out; `progress` draws bars; arguments that
//! several share stand in files of their own. Nothing uses this folder, and it names no other room than the stories and the
//! report.

#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
mod arguments;
#[cfg(feature = "render")]
mod bench;
#[cfg(all(feature = "render", feature = "vision", feature = "report"))]
mod demo;
mod doctor;
mod evaluate;
mod export;
#[cfg(any(feature = "render", feature = "vision"))]
mod frame_range;
#[cfg(feature = "vision")]
mod input_arguments;
#[cfg(feature = "vision")]
mod land;
#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
mod landing_options;
#[cfg(feature = "render")]
mod map;
mod missing;
#[cfg(all(feature = "scene", feature = "report"))]
mod montecarlo;
mod progress;
#[cfg(any(feature = "scene", feature = "vision"))]
mod reference;
#[cfg(feature = "render")]
mod render;
#[cfg(feature = "report")]
mod report;
mod run;
#[cfg(any(feature = "render", feature = "vision", all(feature = "scene", feature = "report")))]
mod settings_arguments;
#[cfg(feature = "vision")]
mod track;
#[cfg(feature = "vision")]
mod tumble;

pub use run::run;
