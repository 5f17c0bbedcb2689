//! SIFT descriptors beside ORB's: at which features there are some, and what they match.

use crate::vision::texture::picture;
use image::{GrayImage, Luma, imageops};
use nalgebra::{Matrix2, Vector2};
use opnav::vision::*;

const SIDE: u32 = 320;
const PATCH_PX: f64 = 21.0;

fn ground() -> GrayImage {
    picture(SIDE, SIDE, 0.0, 1, |p| p)
}

fn features(picture: &GrayImage) -> Vec<Feature> {
    detect_features(picture, None, &DetectorConfig { max_features: 300, ..DetectorConfig::default() })
        .expect("features")
}

fn at(u_px: f64, v_px: f64) -> Feature {
    Feature {
        pixel_px: Vector2::new(u_px, v_px),
        sigma_px: 0.1,
        covariance_px2: Matrix2::identity() * 0.01,
        response: 1.0,
    }
}

/// By SIFT with a patch of a side.
fn by_sift(patch_px: f64) -> MatcherConfig {
    let mut config = MatcherConfig { descriptor: DescriptorKind::Sift, ..MatcherConfig::default() };
    config.sift.patch_px = patch_px;
    config
}

/// Which of the features have a descriptor.
fn described(picture: &GrayImage, features: &[Feature], orientation: Orientation) -> Vec<bool> {
    let set = describe_features(picture, features, orientation, &by_sift(PATCH_PX)).expect("descriptors");
    (0..features.len()).map(|feature| set.of_feature(feature).is_some()).collect()
}

/// A feature where a quarter turn to the right takes it.
fn turned(feature: &Feature) -> Feature {
    at(f64::from(SIDE - 1) - feature.pixel_px.y, feature.pixel_px.x)
}

/// Matches of a picture's features with the same features in another picture of it: how many, and how many of the same.
fn same(
    from: (&GrayImage, &[Feature]),
    to: (&GrayImage, &[Feature]),
    orientation: Orientation,
    patch_px: f64,
) -> (usize, usize) {
    let config = by_sift(patch_px);
    let [a, b] = [from, to]
        .map(|(picture, features)| describe_features(picture, features, orientation, &config).expect("descriptors"));
    let (from, to) = (Described { features: from.1, descriptors: &a }, Described { features: to.1, descriptors: &b });
    let found = match_features(from, to, &config).expect("matches");
    let mut taken: Vec<usize> = found.iter().map(|m| m.to).collect();
    taken.sort_unstable();
    taken.dedup();
    assert_eq!(taken.len(), found.len(), "each at most once on either side");
    (found.len(), found.iter().filter(|m| m.from == m.to).count())
}

#[test]
fn a_turned_and_brightened_image_matches_itself() {
    let plain = ground();
    let here = features(&plain);
    let mut bright = imageops::rotate90(&plain);
    bright.pixels_mut().for_each(|p| p.0[0] = (0.6 * f64::from(p.0[0]) + 90.0) as u8);
    let there: Vec<Feature> = here.iter().map(turned).collect();
    let (found, right) = same((&plain, &here), (&bright, &there), Orientation::Centroid, PATCH_PX);
    assert!(here.len() == 300 && right == found && right > 270, "{right} of {found}, {} features", here.len());
    let (_, upright) = same((&plain, &here), (&bright, &there), Orientation::Upright, PATCH_PX);
    assert!(upright < 10, "{upright} match upright, though the picture is turned");
    let (_, mirrored) =
        same((&plain, &here), (&imageops::flip_vertical(&bright), &there), Orientation::Centroid, PATCH_PX);
    assert!(mirrored < 10, "{mirrored} match in the mirror image");
}

#[test]
fn distances_are_lengths_and_the_ratio_is_theirs() {
    let set = |firsts: &[u8], rest: u8| {
        let mut set = DescriptorSet::new(128);
        let rows = firsts.iter().map(|first| std::array::from_fn(|i| if i == 0 { *first } else { rest }));
        rows.enumerate().for_each(|(feature, row): (usize, [u8; 128])| set.push(feature, &row));
        set
    };
    let features = [at(50.0, 50.0), at(90.0, 90.0)];
    let (from, to) = (set(&[0], 0), set(&[80, 100], 0));
    let found = |max_ratio: f64, max_distance: f64| {
        let mut config = by_sift(PATCH_PX);
        (config.sift.max_ratio, config.sift.max_distance) = (max_ratio, max_distance);
        let (from, to) = (
            Described { features: &features[..1], descriptors: &from },
            Described { features: &features, descriptors: &to },
        );
        match_features(from, to, &config).expect("matches")
    };
    // 80 over 100 is 0.8; of the squares it would be 0.64.
    assert_eq!(found(0.81, 200.0), [IndexMatch { from: 0, to: 0, distance: 80.0 }]);
    assert!(found(0.79, 200.0).is_empty());
    assert!(found(0.81, 79.0).is_empty());
    assert_eq!(found(0.81, 80.0).len(), 1);
    for implementation in [Implementation::Opencv, Implementation::Fused] {
        let mut config = MatcherConfig { implementation, ..by_sift(PATCH_PX) };
        config.sift.max_distance = 3000.0;
        let (from, to) = (
            Described { features: &features[..1], descriptors: &set(&[255], 255) },
            Described { features: &features[..1], descriptors: &set(&[0], 0) },
        );
        let found = match_features(from, to, &config).expect("matches");
        assert_eq!(found, [IndexMatch { from: 0, to: 0, distance: 255.0 * 128f64.sqrt() }], "{implementation:?}");
    }
}

#[test]
fn edges_flat_ground_and_nothing_at_all_are_no_errors() {
    let plain = ground();
    for orientation in [Orientation::Upright, Orientation::Centroid] {
        assert!(described(&plain, &[], orientation).is_empty());
        let last = f64::from(SIDE - 1);
        let edge =
            [at(0.0, 0.0), at(7.9, 100.0), at(100.0, last - 6.9), at(last, last), at(-5.0, 40.0), at(f64::NAN, 9.0)];
        assert_eq!(described(&plain, &edge, orientation), [false; 6]);
        let near = [at(8.0, 100.0), at(last - 8.0, last - 8.0), at(3.0, 3.0), at(100.0, 8.0)];
        assert_eq!(described(&plain, &near, orientation), [true, true, false, true]);
        assert_eq!(described(&GrayImage::from_pixel(64, 64, Luma([90])), &[at(32.0, 32.0)], orientation), [false]);
        assert_eq!(described(&GrayImage::new(5, 5), &[at(2.0, 2.0)], orientation), [false]);
        assert_eq!(described(&ground(), &[at(160.0, 160.0)], orientation), [true]);
    }
}

#[test]
fn the_patch_has_least_and_greatest_sides() {
    let plain = ground();
    let here = features(&plain);
    for patch_px in [8.0, 21.0, 128.0] {
        let (found, right) = same((&plain, &here), (&plain, &here), Orientation::Upright, patch_px);
        assert!(right == found && right > 250, "{right} of {found} with {patch_px} px");
    }
    for patch_px in [0.0, 7.9, 128.1, f64::NAN, -30.0, f64::INFINITY] {
        let error = describe_features(&plain, &here, Orientation::Upright, &by_sift(patch_px)).expect_err("refused");
        assert!(error.to_string().contains("from 8 to 128"), "{error}");
        let mut config = FrontEndConfig::default();
        config.matcher.sift.patch_px = patch_px;
        let error = config.validate().expect_err("refused");
        assert!(error.to_string().contains("matcher.sift.patch_px"), "{error}");
    }
    let mut config = FrontEndConfig::default();
    config.matcher.sift.max_ratio = 1.5;
    assert!(config.validate().expect_err("refused").to_string().contains("matcher.sift.max_ratio"));
}
