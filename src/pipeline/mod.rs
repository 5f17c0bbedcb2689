//! One file per story: corridors that join the rooms and hold no mathematics.
//!
//! Each story is there as soon as the rooms that it joins are. Without any feature: [`evaluate_result`], [`export`] and
//! [`diagnose`]; with `vision`: tracking, landing and tumbling; with `render`: data sets, maps and their timing; with
//! `report`: the page; with `report` and `scene`: campaigns; the demonstration takes all of them.

#[cfg(feature = "render")]
mod bench_render;
#[cfg(all(feature = "render", feature = "vision", feature = "report"))]
mod demonstrate;
mod doctor;
mod error;
mod evaluate;
mod export;
#[cfg(any(feature = "render", feature = "vision"))]
mod frame_range;
#[cfg(feature = "vision")]
mod front_end_files;
#[cfg(feature = "vision")]
mod land;
#[cfg(feature = "render")]
mod map;
#[cfg(feature = "vision")]
mod mask;
#[cfg(all(feature = "scene", feature = "report"))]
mod montecarlo;
#[cfg(feature = "report")]
mod page;
mod progress;
#[cfg(any(feature = "scene", feature = "vision"))]
mod reference;
#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
mod settings;
mod summary;
#[cfg(feature = "render")]
mod synthesize;
#[cfg(feature = "vision")]
mod track;
#[cfg(feature = "vision")]
mod tumble;

#[cfg(feature = "scene")]
pub use crate::campaign::{CampaignOptions, FieldOfView};
pub use crate::dataset::{CameraSource, FrameTimes};
pub use crate::navigation::landing::{BiasPrior, FilterKind, ImageRotationUse, LandingConfig, LandmarkStart};
pub use crate::navigation::landmark::Selector;
pub use crate::navigation::tumbling::{Estimator, TumblingConfig};
#[cfg(feature = "render")]
pub use crate::render::StageTime;
#[cfg(feature = "scene")]
pub use crate::scene::SurveyLevel;
#[cfg(feature = "vision")]
pub use crate::vision::{DescriptorKind, DetectorKind, FrontEndConfig, FrontEndMode};
#[cfg(feature = "render")]
pub use bench_render::{BenchRenderRequest, RenderTimes, bench_render};
#[cfg(all(feature = "render", feature = "vision", feature = "report"))]
pub use demonstrate::{DemoOutcome, demonstrate};
pub use doctor::{Diagnosis, diagnose};
pub use error::PipelineError;
pub use evaluate::evaluate_result;
pub use export::{ExportFormat, ExportRequest, export};
#[cfg(feature = "vision")]
pub use land::{LandRequest, land};
#[cfg(feature = "render")]
pub use map::{MapRequest, make_map};
#[cfg(all(feature = "scene", feature = "report"))]
pub use montecarlo::{MonteCarloOutcome, MonteCarloRequest, montecarlo_landing};
#[cfg(feature = "report")]
pub use page::write_page;
pub use progress::{Progress, Silent};
#[cfg(feature = "scene")]
pub use reference::scenario_reference;
#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
pub use reference::settings_reference;
#[cfg(all(feature = "scene", feature = "report"))]
pub use settings::MonteCarloSettings;
#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
pub use settings::command_settings;
#[cfg(feature = "vision")]
pub use settings::{DemoSettings, InputSettings, LandInput, LandSettings, TrackSettings, TumbleSettings};
pub use summary::{Summary, UnusedFrame};
#[cfg(feature = "render")]
pub use synthesize::{SynthesizeRequest, Synthesized, synthesize};
#[cfg(feature = "vision")]
pub use track::{TrackRequest, track};
#[cfg(feature = "vision")]
pub use tumble::{TumbleRequest, tumble};
