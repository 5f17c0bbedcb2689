//! One file per story: corridors that join the rooms and hold no mathematics.

mod bench_render;
mod demonstrate;
mod doctor;
mod error;
mod evaluate;
mod export;
mod front_end_files;
mod land;
mod map;
mod mask;
mod montecarlo;
mod page;
mod progress;
mod reference;
mod settings;
mod summary;
mod synthesize;
mod track;
mod tumble;

pub use crate::campaign::{CampaignOptions, FieldOfView};
pub use crate::dataset::{CameraSource, FrameTimes};
pub use crate::navigation::landing::{BiasPrior, FilterKind, ImageRotationUse, LandingConfig, LandmarkStart};
pub use crate::navigation::landmark::Selector;
pub use crate::navigation::tumbling::{Estimator, TumblingConfig};
pub use crate::render::StageTime;
pub use crate::scene::SurveyLevel;
pub use crate::vision::{DescriptorKind, DetectorKind, FrontEndConfig, FrontEndMode};
pub use bench_render::{BenchRenderRequest, RenderTimes, bench_render};
pub use demonstrate::{DemoOutcome, demonstrate};
pub use doctor::{Diagnosis, diagnose};
pub use error::PipelineError;
pub use evaluate::evaluate_result;
pub use export::{ExportFormat, ExportRequest, export};
pub use land::{LandRequest, land};
pub use map::{MapRequest, make_map};
pub use montecarlo::{MonteCarloOutcome, MonteCarloRequest, montecarlo_landing};
pub use page::write_page;
pub use progress::{Progress, Silent};
pub use reference::{scenario_reference, settings_reference};
pub use settings::{
    DemoSettings, InputSettings, LandInput, LandSettings, MonteCarloSettings, TrackSettings, TumbleSettings,
    command_settings,
};
pub use summary::{Summary, UnusedFrame};
pub use synthesize::{SynthesizeRequest, Synthesized, synthesize};
pub use track::{TrackRequest, track};
pub use tumble::{TumbleRequest, tumble};
