//! Navigate a descent by the files of a folder: pictures, inertial measurements, and the pixel to land at.
//!
//!     cargo run --example 02_land_from_a_folder [FOLDER]
//!
//! Without a folder, a small descent to Mars is rendered into a temporary one. `opnav land` does the same with files as a
//! result, with a gyroscope's help in matching, and with a map if there is one.

use opnav::dataset::truth::read_lander_states;
use opnav::dataset::{CameraSource, ImageSequence, read_designated, read_imu, read_initial_state};
use opnav::navigation::landing::{LandingConfig, LandingInput, image_rotations, navigate};
use opnav::pipeline::{Silent, SynthesizeRequest, synthesize};
use opnav::settings::Layers;
use opnav::vision::{FrontEndConfig, TrackInputs, drift_per_image_px, track_sequence};
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let made = tempfile::tempdir()?;
    let folder = match std::env::args().nth(1) {
        Some(folder) => PathBuf::from(folder),
        None => render_small_descent(made.path())?,
    };

    // What the spacecraft has: a camera with its mounting, an IMU, where it believes to be, and a pixel to land at.
    let sequence = ImageSequence::open(&folder, &CameraSource::Folder)?;
    let (imu_noise, imu) = read_imu(&sequence.root)?;
    let designated = Some(read_designated(&sequence.root)?);
    let initial = read_initial_state(&sequence.root)?;

    // Pictures become observations...
    let inputs = TrackInputs { frames: 0..sequence.frames.len(), designated, ..TrackInputs::default() };
    let seen = track_sequence(&sequence, &FrontEndConfig::default(), &inputs, &|_| ())?;
    println!("{} pictures, {} observations of features", seen.frames.len(), seen.observations.len());

    // ... and the filter sees nothing but these.
    let lander_from_camera = sequence.sensor.spacecraft_from_camera;
    let frame_times_ns: Vec<i64> = seen.frames.iter().map(|frame| frame.t_ns).collect();
    let input = LandingInput {
        imu,
        imu_noise,
        camera: sequence.sensor.camera,
        lander_from_camera,
        rotations: image_rotations(&seen.rotations, &frame_times_ns, &lander_from_camera),
        observations: seen.observations,
        frame_times_ns,
        initial,
        known: Vec::new(),
    };
    let mut config =
        LandingConfig { designated_drift_px: drift_per_image_px(&seen.designated), ..LandingConfig::from_pixels() };
    config.designated_sigma_px =
        seen.designated.first().map_or(config.designated_sigma_px, |first| first.step_sigma_px);
    let flight = navigate(&input, &config, &|_| ())?;

    // The truth, where there is one, is for the reader's eyes only.
    let truth = read_lander_states(&sequence.root).unwrap_or_default();
    println!("{:>8} {:>12} {:>8} {:>12} {:>10}", "t in s", "height in m", "1σ", "true height", "speed m/s");
    for epoch in flight.epochs.iter().step_by(4).chain(flight.epochs.last()) {
        let true_m = truth.iter().find(|state| state.t_ns == epoch.t_ns).map(|s| s.site_from_lander.translation.z);
        let (t_s, height_m) = (epoch.t_ns as f64 * 1e-9, epoch.site_from_lander.translation.z);
        let true_m = true_m.map_or("unknown".into(), |height_m| format!("{height_m:.2}"));
        let (sigma_m, speed_m_s) = (epoch.sigma()[2], epoch.lander_velocity_in_site_m_s.norm());
        println!("{t_s:8.1} {height_m:12.2} {sigma_m:8.2} {true_m:>12} {speed_m_s:10.3}");
    }
    Ok(())
}

/// A descent from 6.6 km to 15 m in 40 small pictures.
fn render_small_descent(into: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let scenario = into.join("descent.toml");
    std::fs::write(
        &scenario,
        "camera = { width_px = 256, height_px = 256 }\n[descent.schedule.constant-scale]\ncount = 40\n",
    )?;
    let out = into.join("descent");
    let (layers, frames, resume, adapter) = (Layers::default(), None, false, None);
    synthesize(&SynthesizeRequest { scenario, out: out.clone(), layers, frames, resume, adapter }, &Silent)?;
    Ok(out)
}
