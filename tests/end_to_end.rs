//! From pixels to the state, both missions, through the command line's own stories; and the truth wall.

use opnav::evaluation::Metrics;
use opnav::pipeline::{
    CameraSource, Estimator, FrontEndConfig, FrontEndMode, LandRequest, LandingConfig, Silent, SynthesizeRequest,
    TumbleRequest, TumblingConfig, evaluate_result, land, synthesize, tumble,
};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn dataset(scenario: &str, seed: u64, folder: &Path) -> PathBuf {
    let out = folder.join("images");
    let request = SynthesizeRequest {
        scenario: Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(scenario),
        out: out.clone(),
        overrides: vec![format!("seed={seed}")],
        frames: None,
        resume: false,
        adapter: None,
    };
    synthesize(&request, &Silent).expect("the scenario renders");
    out
}

fn navigate_descent(images: &Path, out: &Path) {
    let request = LandRequest {
        folder: images.into(),
        out: out.into(),
        config: LandingConfig::from_pixels(),
        front_end: FrontEndConfig::default(),
    };
    land(&request, &Silent).expect("the descent is navigated");
}

fn estimate_tumbling(images: &Path, out: &Path) {
    let request = TumbleRequest {
        folder: images.into(),
        out: out.into(),
        camera: CameraSource::Folder,
        frames: None,
        config: TumblingConfig { estimator: Estimator::Shooting, ..TumblingConfig::default() },
        front_end: FrontEndConfig { mode: FrontEndMode::FixedCenter, ..FrontEndConfig::default() },
    };
    tumble(&request, &Silent).expect("the motion is estimated");
}

fn value(metrics: &Metrics, name: &str) -> f64 {
    metrics.figure(name).unwrap_or_else(|| panic!("no figure '{name}' in {metrics:?}"))
}
