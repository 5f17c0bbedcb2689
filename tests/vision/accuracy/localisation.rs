//! Corners found anew, and patches followed, against the true flow of rendered ground.

use super::rendered::{RenderedPair, descent};
use crate::accuracy_bar::{Bar, Extent, check};
use crate::render::gpu;
use crate::vision::pair::bearings::median;
use image::GrayImage;
use nalgebra::{Matrix2, Vector2};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, Renderer, World};
use opnav::scene::{Terrain, TerrainConfig};
use opnav::vision::*;

/// A step towards the ground, with the bounds in px of the median error at each noise.
struct Step {
    nearer: f64,
    roll_deg: f64,
    corners_px: Option<[f64; 3]>,
    patches_px: [f64; 3],
}

const STEPS: [Step; 2] = [
    Step { nearer: 0.03, roll_deg: 2.0, corners_px: Some([0.09, 0.16, 0.34]), patches_px: [0.06, 0.07, 0.09] },
    Step { nearer: 0.05, roll_deg: 10.0, corners_px: None, patches_px: [0.09, 0.09, 0.12] },
];
const NOISE_DN: [f64; 3] = [0.0, 2.0, 5.0];
const HEIGHTS_M: [f64; 5] = [5000.0, 1500.0, 400.0, 100.0, 30.0];
/// A match further off than this is a wrong match, px.
pub const WRONG_PX: f64 = 3.0;

/// An error in px, and the covariance that was predicted for it in px².
type Error = (Vector2<f64>, Matrix2<f64>);

pub fn features(picture: &GrayImage) -> Vec<Feature> {
    features_by(picture, DetectorKind::default())
}

fn features_by(picture: &GrayImage, kind: DetectorKind) -> Vec<Feature> {
    detect_features(picture, None, &DetectorConfig { kind, ..DetectorConfig::default() }).expect("features")
}

/// Matched corners against the truth.
fn corner_errors(pair: &RenderedPair, pictures: &[GrayImage; 2], kind: DetectorKind) -> Vec<Error> {
    let found = pictures.each_ref().map(|picture| features_by(picture, kind));
    let config = MatcherConfig::default();
    let bits =
        [0, 1].map(|i| describe_features(&pictures[i], &found[i], Orientation::Upright, &config).expect("descriptors"));
    let described = [0, 1].map(|i| Described { features: &found[i], descriptors: &bits[i] });
    let error = |m: &IndexMatch| {
        let (from, to) = (&found[0][m.from], &found[1][m.to]);
        Some((to.pixel_px - pair.carried(&from.pixel_px)?, from.covariance_px2 + to.covariance_px2))
    };
    match_features(described[0], described[1], &config).expect("matches").iter().filter_map(error).collect()
}

/// Followed patches against the truth; what is known beforehand is the motion over level ground.
fn patch_errors(pair: &RenderedPair, pictures: &[GrayImage; 2]) -> Vec<Error> {
    let points_px: Vec<Vector2<f64>> = features(&pictures[0]).iter().map(|f| f.pixel_px).collect();
    let predict = |pixel: &Vector2<f64>| pair.carried_over_level_ground(pixel);
    let followed = track_patches((&pictures[0], &pictures[1]), &points_px, &predict, &KltConfig::default());
    let both = points_px.iter().zip(followed.expect("shrunk pictures"));
    let error = |(from, to): (&Vector2<f64>, Option<KltPoint>)| {
        let to = to?;
        Some((to.pixel_px - pair.carried(from)?, to.covariance_px2))
    };
    both.filter_map(error).collect()
}

/// How well errors are predicted: their median squared length in σ over that of normal errors, and the share beyond
/// what 99 % of normal errors keep to.
fn consistency(errors: &[Error]) -> (f64, f64) {
    let squares: Vec<f64> = errors.iter().map(|(e, c)| e.dot(&(c.try_inverse().expect("a covariance") * e))).collect();
    let beyond = squares.iter().filter(|s| **s > 9.21).count() as f64 / squares.len() as f64;
    (median(squares) / (2.0 * std::f64::consts::LN_2), beyond)
}

/// Figures of one way to locate points.
fn figures(what: &str, errors: Vec<Error>, bound_px: Option<f64>) -> Vec<Bar> {
    let all = errors.len() as f64;
    let right: Vec<Error> = errors.into_iter().filter(|(e, _)| e.norm() < WRONG_PX).collect();
    let error_px = median(right.iter().map(|(e, _)| e.norm()).collect());
    let (typical, beyond) = consistency(&right);
    let figure = |name: &str| format!("{what}: {name}");
    vec![
        match bound_px {
            Some(bound_px) => Bar::at_most(figure("median error"), error_px, bound_px, "px"),
            None => Bar::stated(figure("median error"), error_px, "px"),
        },
        Bar::at_least(figure("right, of those found"), right.len() as f64 / all, 0.95, ""),
        Bar::stated(figure("number"), all, ""),
        Bar::at_least(figure("median squared error over prediction"), typical, 0.5, ""),
        Bar::at_most(figure("median squared error over prediction"), typical, 2.0, ""),
        Bar::stated(figure("beyond 99 % of normal errors"), beyond, ""),
    ]
}

fn measure(heights_m: &[f64], noises: &[usize], shift_px: Vector2<f64>) -> Vec<Bar> {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let camera = Camera::from_fov(1024, 1024, 90f64.to_radians());
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("a renderer");
    let mut bars = Vec::new();
    for step in STEPS {
        let mut pair = |height_m: &f64| {
            let views = descent(&terrain, [40.0, -70.0], *height_m, (step.nearer, step.roll_deg.to_radians()));
            RenderedPair::new(&mut renderer, &camera, views)
        };
        let pairs: Vec<RenderedPair> = heights_m.iter().map(&mut pair).collect();
        for noise in noises {
            let what = |way: &str| {
                let (nearer, roll_deg, noise_dn) = (100.0 * step.nearer, step.roll_deg, NOISE_DN[*noise]);
                format!("{way}, {nearer:.0} % nearer, {roll_deg:.0}° roll, noise {noise_dn:.0}")
            };
            let errors = |way: &dyn Fn(&RenderedPair, &[GrayImage; 2]) -> Vec<Error>| -> Vec<Error> {
                let all = pairs.iter().flat_map(|p| way(p, &p.pictures(NOISE_DN[*noise], 1)));
                all.map(|(e, c)| (e + shift_px, c)).collect()
            };
            let bound_px = step.corners_px.map(|b| b[*noise]);
            for kind in DetectorKind::ALL {
                let way = if *kind == DetectorKind::Harris { "corners" } else { &format!("{} corners", kind.word()) };
                let found = errors(&|pair, pictures| corner_errors(pair, pictures, *kind));
                bars.extend(figures(&what(way), found, bound_px.filter(|_| *kind == DetectorKind::Harris)));
            }
            bars.extend(figures(&what("patches"), errors(&patch_errors), Some(step.patches_px[*noise])));
        }
    }
    bars
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    match extent {
        Extent::Small => measure(&[5000.0, 30.0], &[1], Vector2::zeros()),
        Extent::Full => measure(&HEIGHTS_M, &[0, 1, 2], Vector2::zeros()),
    }
}

#[test]
fn corners_and_patches_keep_to_the_true_flow() {
    check(&bars(Extent::Small));
}

#[test]
fn a_tenth_of_a_pixel_is_noticed() {
    let shifted = measure(&[400.0], &[1], Vector2::new(0.1, 0.1));
    assert!(shifted.iter().any(|bar| !bar.holds()), "{shifted:#?}");
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
