//! Matches by ORB and by SIFT against the true flow of rendered ground.

use super::localisation::{WRONG_PX, features};
use super::rendered::{RenderedPair, descent};
use crate::accuracy_bar::{Bar, Extent, check};
use crate::render::gpu;
use image::GrayImage;
use nalgebra::Vector2;
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, Renderer, World};
use opnav::scene::{Terrain, TerrainConfig};
use opnav::vision::*;

const HEIGHTS_M: [f64; 3] = [1500.0, 100.0, 30.0];
const NOISE_DN: f64 = 2.0;
/// Least share of right matches, and how far SIFT's may lie below ORB's: a few matches of a picture.
const LEAST_SHARE: f64 = 0.9;
const SHARE_MARGIN: f64 = 0.005;

/// A step towards the ground with a roll, and how many times ORB's right matches SIFT must find.
struct Step {
    nearer: f64,
    roll_deg: f64,
    orientation: Orientation,
    gain: f64,
}

const STEPS: [Step; 3] = [
    Step { nearer: 0.03, roll_deg: 2.0, orientation: Orientation::Upright, gain: 1.0 },
    Step { nearer: 0.2, roll_deg: 5.0, orientation: Orientation::Upright, gain: 2.0 },
    Step { nearer: 0.1, roll_deg: 40.0, orientation: Orientation::Centroid, gain: 1.1 },
];

/// Right and all matches whose truth is known.
#[derive(Clone, Copy, Default)]
struct Count {
    right: f64,
    all: f64,
}

/// Matches of a pair's features, described in one way, `shift_px` off the truth.
fn count(
    (pair, pictures): (&RenderedPair, &[GrayImage; 2]),
    found: &[Vec<Feature>; 2],
    (descriptor, orientation): (DescriptorKind, Orientation),
    shift_px: Vector2<f64>,
) -> Count {
    let config = MatcherConfig { descriptor, ..MatcherConfig::default() };
    let rows = [0, 1].map(|i| describe_features(&pictures[i], &found[i], orientation, &config).expect("descriptors"));
    let described = [0, 1].map(|i| Described { features: &found[i], descriptors: &rows[i] });
    let mut count = Count::default();
    for m in match_features(described[0], described[1], &config).expect("matches") {
        let Some(there) = pair.carried(&found[0][m.from].pixel_px) else { continue };
        count.all += 1.0;
        count.right += f64::from((there + shift_px - found[1][m.to].pixel_px).norm() < WRONG_PX);
    }
    count
}

fn figures(step: &Step, [orb, sift]: [Count; 2]) -> Vec<Bar> {
    let what = format!("{:.0} % nearer, {:.0}° roll", 100.0 * step.nearer, step.roll_deg);
    let (orb_share, sift_share) = (orb.right / orb.all, sift.right / sift.all);
    let bound = (orb_share - SHARE_MARGIN).max(LEAST_SHARE);
    vec![
        Bar::stated(format!("ORB, {what}: right matches"), orb.right, ""),
        Bar::at_least(format!("SIFT, {what}: right matches over ORB's"), sift.right / orb.right, step.gain, ""),
        Bar::at_least(format!("ORB, {what}: right, of those found"), orb_share, LEAST_SHARE, ""),
        Bar::at_least(format!("SIFT, {what}: right, of those found"), sift_share, bound, ""),
    ]
}

fn measure(heights_m: &[f64], shift_px: Vector2<f64>) -> Vec<Bar> {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let camera = Camera::from_fov(1024, 1024, 90f64.to_radians());
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("a renderer");
    let mut bars = Vec::new();
    for step in &STEPS {
        let mut counts = [Count::default(); 2];
        for height_m in heights_m {
            let views = descent(&terrain, [40.0, -70.0], *height_m, (step.nearer, step.roll_deg.to_radians()));
            let pair = RenderedPair::new(&mut renderer, &camera, views);
            let pictures = pair.pictures(NOISE_DN, 1);
            let found = pictures.each_ref().map(features);
            let both = [DescriptorKind::Orb, DescriptorKind::Sift]
                .map(|kind| count((&pair, &pictures), &found, (kind, step.orientation), shift_px));
            for (sum, one) in counts.iter_mut().zip(both) {
                (sum.right, sum.all) = (sum.right + one.right, sum.all + one.all);
            }
        }
        bars.extend(figures(step, counts));
    }
    bars
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    match extent {
        Extent::Small => measure(&HEIGHTS_M[1..2], Vector2::zeros()),
        Extent::Full => measure(&HEIGHTS_M, Vector2::zeros()),
    }
}

#[test]
fn sift_matches_no_worse_than_orb() {
    check(&bars(Extent::Small));
}

#[test]
fn matches_of_other_points_are_noticed() {
    let shifted = measure(&HEIGHTS_M[1..2], Vector2::new(4.0, 0.0));
    assert!(shifted.iter().filter(|bar| !bar.holds()).count() >= STEPS.len(), "{shifted:#?}");
}
