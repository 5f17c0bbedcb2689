//! Time of the detector for one picture of 1024².

use criterion::{Criterion, criterion_group, criterion_main};
use opnav::geometry::Camera;
use opnav::render::{Detector, RenderedFrame};
use opnav::scene::{FixedPatternConfig, SensorConfig, ShutterConfig, VignettingConfig};

const SIDE_PX: u32 = 1024;

/// Gentle waves of light, lit everywhere.
fn frame() -> RenderedFrame {
    let pixels = (SIDE_PX * SIDE_PX) as usize;
    let radiance = |index: usize| {
        let (u, v) = ((index % SIDE_PX as usize) as f32, (index / SIDE_PX as usize) as f32);
        0.12 + 0.1 * (0.05 * u).sin() * (0.03 * v).cos()
    };
    RenderedFrame {
        width_px: SIDE_PX,
        height_px: SIDE_PX,
        radiance: (0..pixels).map(radiance).collect(),
        depth_m: vec![1.0; pixels],
        mask: vec![RenderedFrame::BODY | RenderedFrame::LIT; pixels],
        surface: None,
    }
}

/// Every stage switched on.
fn everything() -> SensorConfig {
    SensorConfig {
        bits: 12,
        black_level_dn: 64.0,
        dark_current_electrons_s: 50.0,
        defocus_radius_px: 1.5,
        shutter: ShutterConfig { exposure_time_s: 0.1, ..ShutterConfig::default() },
        vignetting: VignettingConfig { cosine_fourth: true, radial: [-0.1, 0.0, 0.0] },
        fixed_pattern: FixedPatternConfig {
            response_sigma: 0.01,
            offset_sigma_electrons: 5.0,
            hot_pixel_fraction: 1e-3,
            hot_pixel_electrons_s: 1e4,
        },
        ..SensorConfig::default()
    }
}

fn sensor(criterion: &mut Criterion) {
    let (frame, camera) = (frame(), Camera::from_fov(SIDE_PX, SIDE_PX, 1.0));
    let quiet = SensorConfig { noise: false, ..SensorConfig::default() };
    let mut group = criterion.benchmark_group("sensor");
    for (name, config) in [("default", SensorConfig::default()), ("without noise", quiet), ("everything", everything())]
    {
        let detector = Detector::new(&camera, &config, 1, 0);
        group.bench_function(name, |bencher| bencher.iter(|| detector.expose(&frame, 0)));
    }
    group.finish();
}

criterion_group!(benches, sensor);
criterion_main!(benches);
