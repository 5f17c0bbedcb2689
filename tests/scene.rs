//! Tests of the room `scene`.

mod attachment;
mod body;
mod camera;
mod descent;
mod elevation;
mod light;
mod photometry;
mod scenario;
mod sensor;
mod stars;
mod terrain;
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
