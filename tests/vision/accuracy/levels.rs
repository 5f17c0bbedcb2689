//! What the ground looks like must not move as its level of detail changes: patches of pictures drawn with vertices of
//! different spacing lie at the same pixels.

use super::rendered::{RenderedPair, descent};
use crate::accuracy_bar::{Bar, Extent, check};
use crate::render::gpu;
use crate::vision::pair::bearings::median;
use image::GrayImage;
use nalgebra::Vector2;
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, Renderer, World};
use opnav::scene::{Terrain, TerrainConfig};
use opnav::vision::{KltConfig, track_patches};

const EDGE_PX: u32 = 640;

fn picture(terrain: &Terrain, height_m: f64, vertex_spacing_px: f64) -> GrayImage {
    let camera = Camera::from_fov(EDGE_PX, EDGE_PX, 60f64.to_radians());
    let config = RenderConfig { vertex_spacing_px, ..RenderConfig::default() };
    let mut renderer = Renderer::new(&gpu(), World::Terrain(terrain), &camera, &config).expect("a renderer");
    let views = descent(terrain, [40.0, -70.0], height_m, (0.0, 0.0));
    let [picture, _] = RenderedPair::new(&mut renderer, &camera, views).pictures(0.0, 1);
    picture
}

/// Median length in px by which patches of two pictures are apart.
fn apart_px(from: &GrayImage, to: &GrayImage) -> f64 {
    let places = (30..EDGE_PX - 30).step_by(30);
    let at: Vec<Vector2<f64>> =
        places.clone().flat_map(|v| places.clone().map(move |u| Vector2::new(f64::from(u), f64::from(v)))).collect();
    let config = KltConfig { half_px: 15, ..KltConfig::default() };
    let found = track_patches((from, to), &at, &|p| Some(*p), &config).expect("shrunk pictures");
    median(at.iter().zip(found).filter_map(|(a, f)| Some((f?.pixel_px - a).norm())).collect())
}

fn measure(heights_m: &[f64]) -> Vec<Bar> {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let mut bars = Vec::new();
    for height_m in heights_m {
        let usual = picture(&terrain, *height_m, RenderConfig::default().vertex_spacing_px);
        for (spacing_px, bound_px) in [(0.55, 0.2), (2.2, 0.3)] {
            let what = format!("patches from {height_m} m, vertices {spacing_px} px apart instead of 1.1");
            bars.push(Bar::at_most(what, apart_px(&usual, &picture(&terrain, *height_m, spacing_px)), bound_px, "px"));
        }
    }
    bars
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    match extent {
        Extent::Small => measure(&[5000.0]),
        Extent::Full => measure(&[5000.0, 1500.0, 400.0, 100.0, 30.0, 10.0]),
    }
}

#[test]
fn the_ground_keeps_its_place_as_its_level_of_detail_changes() {
    check(&bars(Extent::Small));
}

#[test]
fn half_a_pixel_is_noticed() {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let usual = picture(&terrain, 5000.0, 1.1);
    let grey = |u: u32, v: u32| u16::from(usual.get_pixel(u.min(EDGE_PX - 1), v).0[0]);
    let half = GrayImage::from_fn(EDGE_PX, EDGE_PX, |u, v| image::Luma([((grey(u, v) + grey(u + 1, v)) / 2) as u8]));
    let moved_px = apart_px(&usual, &half);
    assert!((moved_px - 0.5).abs() < 0.1, "{moved_px} px");
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
