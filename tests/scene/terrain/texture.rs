//! Texture in the pictures of the reference descent, from the first to the last.

use opnav::render::{Detector, Gpu, RenderConfig, Renderer, World};
use opnav::scene::{DescentScene, Scenario, Scene};
use opnav::vision::{DetectorConfig, Feature, detect_features};
use std::path::Path;

/// Fewest features in a picture.
const LEAST_FEATURES: usize = 800;
/// Fewest features in each cell of a grid of 8 by 8.
const LEAST_IN_CELL: usize = 4;

fn reference_descent() -> DescentScene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/mars_descent.toml");
    let scene = Scenario::read(&path, &[]).and_then(|s| s.build(path.parent().expect("a folder")));
    match scene.expect("the reference scenario builds") {
        Scene::Descent(scene) => *scene,
        _ => panic!("the reference scenario is a descent"),
    }
}

/// Number of features of each of some pictures, and the fewest in a cell.
fn features(share_of_descent: &[f64]) -> Vec<(f64, usize, usize)> {
    let scene = reference_descent();
    let camera = &scene.cameras[0];
    let gpu = Gpu::new(None).expect("a graphics adapter");
    let mut renderer =
        Renderer::new(&gpu, World::Terrain(&scene.terrain), &camera.sensor.camera, &RenderConfig::default())
            .expect("a renderer");
    let detector = Detector::new(&camera.sensor.camera, &camera.detector, 1, 0);
    let counts = |share: &f64| {
        let view = &camera.views[(share * (camera.views.len() - 1) as f64).round() as usize];
        let frame = renderer.render(view).expect("a picture");
        let picture = detector.expose(&frame, view.t_ns).to_image().expect("a picture").to_luma8();
        let found = detect_features(&picture, None, &DetectorConfig::default()).expect("features");
        let height_m = view.reference_from_camera.translation.vector.z;
        let fewest = fewest_in_cell(&found, [picture.width(), picture.height()]);
        println!("height {height_m:8.1} m: {:5} features, at least {fewest:3} in each cell", found.len());
        (height_m, found.len(), fewest)
    };
    share_of_descent.iter().map(counts).collect()
}

fn fewest_in_cell(found: &[Feature], [width, height]: [u32; 2]) -> usize {
    const CELLS: usize = 8;
    let mut counts = [0; CELLS * CELLS];
    let cell = |at: f64, edge: u32| ((at / f64::from(edge) * CELLS as f64) as usize).min(CELLS - 1);
    for feature in found {
        counts[cell(feature.pixel_px.y, height) * CELLS + cell(feature.pixel_px.x, width)] += 1;
    }
    counts.into_iter().min().unwrap_or(0)
}

fn hold(found: &[(f64, usize, usize)]) {
    for (height_m, count, fewest) in found {
        assert!(*count >= LEAST_FEATURES, "{count} features from {height_m:.0} m");
        assert!(*fewest >= LEAST_IN_CELL, "{fewest} features in a cell of the picture from {height_m:.0} m");
    }
}

#[test]
fn the_first_and_the_last_image_of_the_descent_have_texture() {
    hold(&features(&[0.0, 1.0]));
}

#[test]
#[ignore = "a minute: renders twenty pictures of the reference descent"]
fn accuracy_texture_of_the_descent() {
    hold(&features(&(0..20).map(|k| f64::from(k) / 19.0).collect::<Vec<_>>()));
}
