//! Tests of the room `scene`.

mod attachment;
mod bodies;
mod body_albedo;
mod body_boulders;
mod body_formats;
mod body_large;
mod body_motion;
mod cameras;
mod descent;
mod elevation_files;
mod elevation_model;
mod elevation_scenarios;
mod meshes;
mod photometry;
mod scenarios;
mod sensors;
mod several_cameras;
mod stars;
mod sunlight;
mod tumbling;

use opnav::scene::{DescentScene, Scenario, Scene, SceneError, TumblingScene};
use std::path::Path;

fn datasets() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/datasets"))
}

fn scenario(text: &str) -> Result<Scenario, SceneError> {
    Scenario::parse(text, Path::new("test.toml"), &[])
}

fn descent(text: &str) -> DescentScene {
    match scenario(text).unwrap().build(datasets()).unwrap() {
        Scene::Descent(scene) => *scene,
        _ => panic!("not a descent"),
    }
}

fn tumbling(text: &str) -> TumblingScene {
    match scenario(text).unwrap().build(datasets()).unwrap() {
        Scene::Tumbling(scene) => *scene,
        _ => panic!("not a tumbling body"),
    }
}
