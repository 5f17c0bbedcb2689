//! Every detector: the same places again after a turn, errors as predicted, nothing where nothing is; OpenCV's code and
//! our own find the same.

use crate::vision::pair::bearings::median;
use crate::vision::texture::*;
use image::{GrayImage, Luma};
use nalgebra::{Matrix3, Vector2};
use opnav::vision::*;

const SIDE: u32 = 384;
const MIDDLE_PX: Vector2<f64> = Vector2::new(191.5, 191.5);

fn usual(kind: DetectorKind) -> DetectorConfig {
    DetectorConfig { kind, max_features: 400, ..DetectorConfig::default() }
}

fn features(picture: &GrayImage, kind: DetectorKind) -> Vec<Feature> {
    detect_features(picture, None, &usual(kind)).expect("features")
}

fn pair(h: &Matrix3<f64>, noise_dn: f64) -> [GrayImage; 2] {
    let inverse = h.try_inverse().expect("a similarity");
    [picture(SIDE, SIDE, noise_dn, 1, |p| p), picture(SIDE, SIDE, noise_dn, 2, |p| apply(&inverse, p))]
}

/// Features of the first picture and the nearest one of the second to where `h` puts it, where it lies well inside.
fn nearest<'a>(a: &'a [Feature], b: &'a [Feature], h: &Matrix3<f64>) -> Vec<(&'a Feature, &'a Feature, Vector2<f64>)> {
    let inside = |p: &Vector2<f64>| (p - MIDDLE_PX).amax() < f64::from(SIDE) / 2.0 - 20.0;
    let off = |f: &Feature, to: &Vector2<f64>| (f.pixel_px - to).norm();
    a.iter()
        .map(|from| (from, apply(h, from.pixel_px)))
        .filter(|(_, place)| inside(place))
        .filter_map(|(from, place)| {
            let to = b.iter().min_by(|x, y| off(x, &place).total_cmp(&off(y, &place)))?;
            Some((from, to, to.pixel_px - place))
        })
        .collect()
}

/// Share of the first picture's features that the second has, too, within 1.5 px.
fn repeatability(a: &[Feature], b: &[Feature], h: &Matrix3<f64>) -> f64 {
    let all = nearest(a, b, h);
    all.iter().filter(|(_, _, off)| off.norm() < 1.5).count() as f64 / all.len() as f64
}

#[test]
fn turned_and_scaled_ground_has_its_features_again() {
    for kind in DetectorKind::ALL {
        for (scale, turn_deg, least) in [(1.0, 90.0, 0.65), (1.03, 2.0, 0.65), (1.05, 40.0, 0.55), (1.2, 10.0, 0.65)] {
            let h = similarity(scale, turn_deg, MIDDLE_PX);
            let [a, b] = pair(&h, 1.0).map(|p| features(&p, *kind));
            let again = repeatability(&a, &b, &h);
            assert!(a.len() == 400 && again > least, "{kind:?}, {scale}, {turn_deg}°: {again}");
            let elsewhere = repeatability(&a, &b, &similarity(scale, turn_deg + 25.0, MIDDLE_PX));
            assert!(elsewhere < 0.1, "{kind:?}: {elsewhere} where there is nothing");
        }
    }
}

/// Median squared error over what the covariances predict, times `factor`.
fn consistency(kind: DetectorKind, noise_dn: f64, factor: f64) -> f64 {
    let h = similarity(1.03, 2.0, MIDDLE_PX);
    let [a, b] = pair(&h, noise_dn).map(|p| features(&p, kind));
    let linear = h.fixed_view::<2, 2>(0, 0).into_owned();
    let squared = |(from, to, off): &(&Feature, &Feature, Vector2<f64>)| {
        let covariance_px2 = (linear * from.covariance_px2 * linear.transpose() + to.covariance_px2) * factor;
        off.dot(&(covariance_px2.try_inverse().expect("a covariance") * off))
    };
    let right: Vec<f64> = nearest(&a, &b, &h).iter().filter(|n| n.2.norm() < 1.5).map(squared).collect();
    assert!(right.len() > 150, "{} features again", right.len());
    median(right) / (2.0 * std::f64::consts::LN_2)
}

#[test]
fn errors_are_as_large_as_predicted() {
    for kind in DetectorKind::ALL {
        for noise_dn in [0.0, 2.0, 5.0] {
            let ratio = consistency(*kind, noise_dn, 1.0);
            assert!((0.3..2.0).contains(&ratio), "{kind:?}, noise {noise_dn}: {ratio}");
            for factor in [0.1, 8.0] {
                let ratio = consistency(*kind, noise_dn, factor);
                assert!(!(0.3..2.0).contains(&ratio), "a wrong covariance passes: {ratio}");
            }
        }
    }
}

#[test]
fn flat_and_saturated_images_have_no_features() {
    let burnt = picture(SIDE, SIDE, 0.0, 1, |p| p);
    let burnt = GrayImage::from_fn(SIDE, SIDE, |u, v| Luma([burnt.get_pixel(u, v).0[0].saturating_mul(2)]));
    let is_white = |f: &&Feature| {
        let (u, v) = (f.pixel_px.x.round() as u32, f.pixel_px.y.round() as u32);
        (v - 4..=v + 4).all(|v| (u - 4..=u + 4).all(|u| burnt.get_pixel(u, v).0[0] == 255))
    };
    for kind in DetectorKind::ALL {
        for level in [0, 90, 255] {
            assert!(features(&GrayImage::from_pixel(SIDE, SIDE, Luma([level])), *kind).is_empty(), "{kind:?}, {level}");
        }
        for side in [1, 5, 33] {
            assert!(features(&GrayImage::new(side, side), *kind).is_empty(), "{kind:?}, {side} px");
        }
        let found = features(&burnt, *kind);
        let in_white = found.iter().filter(is_white).count();
        assert!(found.len() > 100 && in_white == 0, "{kind:?}: {in_white} of {} in white", found.len());
        let noise = picture(SIDE, SIDE, 3.0, 9, |_| Vector2::new(11.0, 13.0));
        let found = features(&noise, *kind).len();
        assert!(found < 40, "{kind:?}: {found} features in noise");
    }
}

#[test]
fn masks_are_kept_to_by_all() {
    let whole = picture(SIDE, SIDE, 0.0, 1, |p| p);
    let mask = GrayImage::from_fn(SIDE, SIDE, |u, _| Luma([if u < 150 { 255 } else { 0 }]));
    for kind in DetectorKind::ALL {
        let found = detect_features(&whole, Some(&mask), &usual(*kind)).expect("features");
        assert!(found.len() > 30 && found.iter().all(|f| f.pixel_px.x < 151.5), "{kind:?}");
        let none = detect_features(&whole, Some(&GrayImage::new(SIDE, SIDE)), &usual(*kind)).expect("features");
        assert!(none.is_empty(), "{kind:?}");
        let error = detect_features(&whole, Some(&GrayImage::new(10, 10)), &usual(*kind)).expect_err("refused");
        assert!(error.to_string().contains("10x10"), "{kind:?}");
    }
}

/// Share of the features that both lists have within a thousandth of a pixel.
fn alike(a: &[Feature], b: &[Feature]) -> f64 {
    let all = nearest(a, b, &Matrix3::identity());
    let same = |(x, y, off): &&(&Feature, &Feature, Vector2<f64>)| {
        off.norm() < 1e-3 && (x.sigma_px / y.sigma_px - 1.0).abs() < 1e-2
    };
    all.iter().filter(same).count() as f64 / all.len() as f64
}

#[test]
fn opencv_and_our_own_code_find_the_same_features() {
    for (seed, noise_dn) in [(1, 0.0), (2, 3.0), (3, 6.0)] {
        let ground = picture(SIDE, SIDE, noise_dn, seed, |p| p);
        let found = |implementation: Implementation, harris_k: f64| {
            let config = DetectorConfig { implementation, harris_k, ..usual(DetectorKind::Harris) };
            detect_features(&ground, None, &config).expect("features")
        };
        let [opencv, fused] = [Implementation::Opencv, Implementation::Fused].map(|way| found(way, 0.04));
        let share = alike(&opencv, &fused);
        assert!(opencv.len() == fused.len() && share > 0.99, "noise {noise_dn}: {share} of {} alike", opencv.len());
        let other = alike(&opencv, &found(Implementation::Fused, 0.08));
        assert!(other < 0.9, "{other} alike with another response");
    }
}

#[test]
fn opencv_and_our_own_code_find_the_same_matches() {
    let h = similarity(1.04, 5.0, MIDDLE_PX);
    let pictures = pair(&h, 3.0);
    let found = pictures.each_ref().map(|p| features(p, DetectorKind::Harris));
    for descriptor in DescriptorKind::ALL {
        let usual = MatcherConfig { descriptor: *descriptor, guided_radius_px: 9.0, ..MatcherConfig::default() };
        let describe = |i: usize| describe_features(&pictures[i], &found[i], Orientation::Upright, &usual);
        let rows = [0, 1].map(|i| describe(i).expect("descriptors"));
        let [from, to] = [0, 1].map(|i| Described { features: &found[i], descriptors: &rows[i] });
        // Every seventh has no prediction.
        let predict = |p: &Vector2<f64>| (p.x as i64 % 7 != 0).then(|| apply(&h, *p));
        let matches = |implementation: Implementation| {
            let config = MatcherConfig { implementation, ..usual.clone() };
            let free = match_features(from, to, &config).expect("matches");
            [free, match_features_guided(from, to, &predict, &config).expect("matches")]
        };
        let [opencv, fused] = [Implementation::Opencv, Implementation::Fused].map(matches);
        assert_eq!(opencv, fused, "{descriptor:?}");
        assert!(opencv[0].len() > 80 && opencv[1].len() > 80 && opencv[0] != opencv[1], "{descriptor:?}");
        assert!(opencv[1].iter().all(|m| found[0][m.from].pixel_px.x as i64 % 7 != 0));
    }
}

#[test]
fn parts_are_named_by_their_words() {
    let config: FrontEndConfig = toml::from_str(
        "[detector]\nkind = \"shi-tomasi\"\nimplementation = \"fused\"\n[matcher]\ndescriptor = \"sift\"\n",
    )
    .expect("settings");
    assert_eq!(config.detector.kind, DetectorKind::ShiTomasi);
    assert_eq!(
        (config.detector.implementation, config.matcher.descriptor),
        (Implementation::Fused, DescriptorKind::Sift)
    );
    let defaults = FrontEndConfig::default();
    assert_eq!((defaults.detector.kind.word(), defaults.matcher.descriptor.word()), ("harris", "orb"));
    assert_eq!([defaults.detector.implementation, defaults.matcher.implementation], [Implementation::Opencv; 2]);
    let error = toml::from_str::<FrontEndConfig>("[detector]\nkind = \"surf\"\n").expect_err("refused").to_string();
    assert!(error.contains("harris") && error.contains("shi-tomasi"), "{error}");
}
