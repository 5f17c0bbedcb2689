//! Matches of synthetic images: turned, mirrored, predicted.

use crate::vision::features::images::{matched, pair};
use crate::vision::texture::*;
use nalgebra::Vector2;
use opnav::vision::*;

#[test]
fn a_quarter_turn_needs_the_centroid_orientation_and_a_mirror_image_matches_nothing() {
    let h = similarity(1.0, 90.0, Vector2::new(191.5, 191.5));
    let (a, b) = pair(&h, 0.0);
    let right = |orientation| {
        let (fa, fb, found) = matched(&a, &b, orientation);
        found.iter().filter(|m| (apply(&h, fa[m.from].pixel_px) - fb[m.to].pixel_px).norm() < 3.0).count()
    };
    let (turned, upright) = (right(Orientation::Centroid), right(Orientation::Upright));
    assert!(turned > 100 && upright < 10, "{turned} with orientation, {upright} without");
    let (_, _, found) = matched(&a, &image::imageops::flip_horizontal(&a), Orientation::Centroid);
    assert!(found.len() < 20, "{} matches with the mirror image", found.len());
}

#[test]
fn a_prediction_finds_more_matches_and_no_worse_ones() {
    let h = similarity(1.05, 5.0, Vector2::new(190.0, 190.0));
    let (a, b) = pair(&h, 4.0);
    let (fa, fb, free) = matched(&a, &b, Orientation::Upright);
    let config = MatcherConfig { guided_radius_px: 8.0, ..MatcherConfig::default() };
    let describe = |picture, features| describe_features(picture, features, Orientation::Upright, &config).unwrap();
    let (da, db) = (describe(&a, &fa), describe(&b, &fb));
    let (from, to) = (Described { features: &fa, descriptors: &da }, Described { features: &fb, descriptors: &db });
    let guided = match_features_guided(from, to, &|p| Some(apply(&h, *p)), &config).unwrap();
    let right = |found: &[IndexMatch]| {
        found.iter().filter(|m| (apply(&h, fa[m.from].pixel_px) - fb[m.to].pixel_px).norm() < 2.0).count()
    };
    let (more, fewer) = (right(&guided), right(&free));
    assert!(more > fewer && more * 100 > guided.len() * 85, "{more} of {} with, {fewer} without", guided.len());
}
