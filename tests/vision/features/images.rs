//! Detection on synthetic images, and how well what is found is located.

use crate::vision::pair::bearings::median;
use crate::vision::texture::*;
use image::{GrayImage, Luma};
use nalgebra::{Matrix3, Vector2};
use opnav::vision::*;

const SIDE: u32 = 384;

pub fn pair(h: &Matrix3<f64>, noise_dn: f64) -> (GrayImage, GrayImage) {
    let inverse = h.try_inverse().unwrap();
    (picture(SIDE, SIDE, noise_dn, 1, |p| p), picture(SIDE, SIDE, noise_dn, 2, |p| apply(&inverse, p)))
}

fn features(picture: &GrayImage) -> Vec<Feature> {
    detect_features(picture, None, &DetectorConfig { max_features: 400, ..DetectorConfig::default() }).unwrap()
}

pub fn matched(
    a: &GrayImage,
    b: &GrayImage,
    orientation: Orientation,
) -> (Vec<Feature>, Vec<Feature>, Vec<IndexMatch>) {
    let (fa, fb) = (features(a), features(b));
    let config = MatcherConfig::default();
    let describe = |picture, features| describe_features(picture, features, orientation, &config).unwrap();
    let (da, db) = (describe(a, &fa), describe(b, &fb));
    let from = Described { features: &fa, descriptors: &da };
    let to = Described { features: &fb, descriptors: &db };
    let found = match_features(from, to, &config).unwrap();
    (fa, fb, found)
}

/// Errors in px of matches within 3 px of the truth, their predicted σ, and the share of the matches that are.
fn localisation(h: &Matrix3<f64>, noise_dn: f64, whole: bool) -> (Vec<f64>, Vec<f64>, f64) {
    let (a, b) = pair(h, noise_dn);
    let (fa, fb, found) = matched(&a, &b, Orientation::Upright);
    assert!(found.len() > 100, "{} matches", found.len());
    let place = |f: &Feature| if whole { f.pixel_px.map(f64::round) } else { f.pixel_px };
    let all: Vec<(f64, f64)> = found
        .iter()
        .map(|m| {
            let error = (apply(h, place(&fa[m.from])) - place(&fb[m.to])).norm();
            (error, fa[m.from].sigma_px.hypot(fb[m.to].sigma_px))
        })
        .collect();
    let right: Vec<&(f64, f64)> = all.iter().filter(|e| e.0 < 3.0).collect();
    let share = right.len() as f64 / all.len() as f64;
    (right.iter().map(|e| e.0).collect(), right.iter().map(|e| e.1).collect(), share)
}

#[test]
fn corners_are_located_to_a_fraction_of_a_pixel() {
    let h = similarity(1.03, 2.0, Vector2::new(190.0, 190.0));
    let (fine, _, share) = localisation(&h, 0.0, false);
    let (whole, _, _) = localisation(&h, 0.0, true);
    assert!(share > 0.9, "{share} of the matches are right");
    let (fine, whole) = (median(fine), median(whole));
    assert!(fine < 0.2 && whole > 0.35, "median error {fine} px, {whole} px in whole pixels");
}

#[test]
fn predicted_sigma_grows_with_noise_as_the_error_does() {
    let h = similarity(1.03, 2.0, Vector2::new(190.0, 190.0));
    for noise_dn in [0.0, 3.0, 5.0] {
        let (errors, sigma, _) = localisation(&h, noise_dn, false);
        // The median length of a normal error in two coordinates is 1.177σ.
        let ratio = median(errors) / (1.177 * median(sigma));
        assert!((0.5..1.6).contains(&ratio), "noise {noise_dn}: error over prediction {ratio}");
    }
}

#[test]
fn noise_is_estimated_from_the_image() {
    for noise_dn in [2.0, 5.0] {
        let estimate = noise_sigma_dn(&picture(SIDE, SIDE, noise_dn, 3, |p| p));
        assert!((0.8..1.6).contains(&(estimate / noise_dn)), "{estimate} for {noise_dn}");
    }
}

#[test]
fn dim_ground_gets_its_share_of_features() {
    let mut dim = picture(SIDE, SIDE, 0.5, 1, |p| p);
    for (u, _, pixel) in dim.enumerate_pixels_mut() {
        if u < SIDE / 2 {
            pixel.0[0] = 20 + pixel.0[0] / 3;
        }
    }
    let found = features(&dim);
    let left = found.iter().filter(|f| f.pixel_px.x < f64::from(SIDE) / 2.0 - 5.0).count();
    assert!(left * 3 > found.len(), "{left} of {} in the dim half", found.len());
    let close = |a: &Feature| found.iter().filter(|b| (a.pixel_px - b.pixel_px).norm() < 3.0).count() > 1;
    assert!(!found.iter().any(close));
}

#[test]
fn a_mask_is_kept_to_and_must_fit() {
    let whole = picture(SIDE, SIDE, 0.0, 1, |p| p);
    let mask = GrayImage::from_fn(SIDE, SIDE, |u, _| Luma([if u < 150 { 255 } else { 0 }]));
    let found = detect_features(&whole, Some(&mask), &DetectorConfig::default()).unwrap();
    assert!(found.len() > 30 && found.iter().all(|f| f.pixel_px.x < 151.5));
    let small = GrayImage::new(10, 10);
    let error = detect_features(&whole, Some(&small), &DetectorConfig::default()).unwrap_err();
    assert!(error.to_string().contains("10x10"));
}

#[test]
fn empty_sky_and_bare_noise_have_no_features() {
    assert!(features(&GrayImage::new(SIDE, SIDE)).is_empty());
    let flat = picture(SIDE, SIDE, 3.0, 9, |_| Vector2::new(11.0, 13.0));
    let found = features(&flat).len();
    assert!(found < 40, "{found} features in noise");
}
