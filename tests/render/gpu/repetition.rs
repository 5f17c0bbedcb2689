//! The same view gives the same bytes.

use crate::render::{gpu, lobed, look_at, look_down, render};
use nalgebra::Vector3;
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, RenderedFrame, Renderer, World};
use opnav::scene::{BodySurface, SmallBody, Terrain, TerrainConfig};

#[test]
fn images_are_reproducible_whatever_came_before() {
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let camera = Camera::from_fov(192, 160, 1.5);
    let view = look_down(&terrain, [40.0, -20.0], 300.0);
    let new = || Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    let bytes = |frame: RenderedFrame| {
        let bits = |v: &[f32]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        (bits(&frame.radiance), bits(&frame.depth_m), frame.mask)
    };
    let first = bytes(new().render(&view).expect("a picture"));
    let mut used = new();
    for height_m in [3000.0, 900.0, 20.0] {
        used.render(&look_down(&terrain, [100.0, 50.0], height_m)).expect("a picture");
    }
    assert!(first == bytes(used.render(&view).expect("a picture")), "the pool's history shows");
    assert!(first == bytes(used.render(&view).expect("a picture")), "a second time");

    let body = SmallBody { mesh: lobed(40), surface: BodySurface::default() };
    let view = look_at(Vector3::new(900.0, 900.0, 0.0), Vector3::zeros(), Vector3::z(), Vector3::x());
    let once = || bytes(render(World::Body(&body), &camera, &RenderConfig::default(), &view));
    assert!(once() == once());
}
