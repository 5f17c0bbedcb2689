//! Cost of the front end on 1024² pictures with 1000 and 2000 features, one thread.

#[path = "vision/plain.rs"]
mod plain;

use criterion::{Criterion, criterion_group, criterion_main};
use image::GrayImage;
use nalgebra::Vector2;
use opnav::geometry::Camera;
use opnav::vision::*;
use std::hint::black_box;

/// A deterministic fractal texture, grey levels.
fn texture(x: f64, y: f64) -> f64 {
    let lattice = |x: i64, y: i64| {
        let h = (x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663)) as u64;
        let h = (h ^ (h >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        ((h ^ (h >> 32)) & 0xffff) as f64 / 65535.0 - 0.5
    };
    let noise = |x: f64, y: f64| {
        let (i, j) = (x.floor(), y.floor());
        let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
        let (s, t) = (smooth(x - i), smooth(y - j));
        let at = |a: i64, b: i64| lattice(i as i64 + a, j as i64 + b);
        (at(0, 0) * (1.0 - s) + at(1, 0) * s) * (1.0 - t) + (at(0, 1) * (1.0 - s) + at(1, 1) * s) * t
    };
    let octave = |k: i32| 0.7f64.powi(k) * noise(x / f64::from(128 >> k) + 9.1, y / f64::from(128 >> k) + 3.7);
    128.0 + 130.0 * (0..6).map(octave).sum::<f64>()
}

/// The texture sampled at `place`.
fn picture(place: impl Fn(f64, f64) -> (f64, f64)) -> GrayImage {
    GrayImage::from_fn(1024, 1024, |u, v| {
        let (x, y) = place(f64::from(u), f64::from(v));
        image::Luma([texture(x, y).clamp(0.0, 255.0) as u8])
    })
}

/// Features of both pictures, and their matches.
fn matched(
    pictures: [&GrayImage; 2],
    (detector, matcher): (&DetectorConfig, &MatcherConfig),
) -> ([Vec<Feature>; 2], Vec<IndexMatch>) {
    let features = pictures.map(|p| detect_features(p, None, detector).expect("features"));
    let rows = [0, 1]
        .map(|i| describe_features(pictures[i], &features[i], Orientation::Upright, matcher).expect("descriptors"));
    let described = [0, 1].map(|i| Described { features: &features[i], descriptors: &rows[i] });
    let found = match_features(described[0], described[1], matcher).expect("matches");
    (features, found)
}

/// Each step with so many features, by OpenCV and by our own code.
fn detection_and_matching(criterion: &mut Criterion, pictures: [&GrayImage; 2], count: usize) {
    let usual = DetectorConfig { max_features: count, ..DetectorConfig::default() };
    let ways = [Implementation::Opencv, Implementation::Fused];
    for (kind, implementation) in DetectorKind::ALL.iter().flat_map(|kind| ways.map(|way| (*kind, way))) {
        if kind != DetectorKind::Harris && implementation == Implementation::Fused {
            continue;
        }
        let config = DetectorConfig { kind, implementation, ..usual.clone() };
        criterion.bench_function(&format!("detect {count}, {}, {implementation:?}", kind.word()), |bench| {
            bench.iter(|| detect_features(black_box(pictures[0]), None, &config));
        });
    }
    let still = |p: &Vector2<f64>| Some((p + Vector2::new(15.0, -4.0)) / 1.03);
    for descriptor in DescriptorKind::ALL {
        let config = MatcherConfig { descriptor: *descriptor, ..MatcherConfig::default() };
        let features = pictures.map(|p| detect_features(p, None, &usual).expect("features"));
        let rows = [0, 1]
            .map(|i| describe_features(pictures[i], &features[i], Orientation::Upright, &config).expect("descriptors"));
        let described = [0, 1].map(|i| Described { features: &features[i], descriptors: &rows[i] });
        let word = descriptor.word();
        criterion.bench_function(&format!("describe {count}, {word}"), |bench| {
            bench.iter(|| describe_features(black_box(pictures[0]), &features[0], Orientation::Upright, &config));
        });
        for implementation in ways {
            let config = MatcherConfig { implementation, ..config.clone() };
            criterion.bench_function(&format!("match {count} x {count}, {word}, {implementation:?}"), |bench| {
                bench.iter(|| match_features(black_box(described[0]), described[1], &config));
            });
            criterion.bench_function(&format!("match {count} within 60 px, {word}, {implementation:?}"), |bench| {
                bench.iter(|| match_features_guided(black_box(described[0]), described[1], &still, &config));
            });
        }
    }
}

fn front_end(criterion: &mut Criterion) {
    opencv::core::set_num_threads(1).expect("OpenCV takes a number of threads");
    let (a, b) = (picture(|x, y| (x, y)), picture(|x, y| (1.03 * x + 0.03 * y - 15.0, 1.03 * y - 0.03 * x + 4.0)));
    let pictures = [&a, &b];
    for count in [1000, 2000] {
        detection_and_matching(criterion, pictures, count);
    }
    let config = DetectorConfig { max_features: 2000, ..DetectorConfig::default() };
    let matcher = MatcherConfig::default();
    let (features, found) = matched(pictures, (&config, &matcher));
    let pair = MatchedPair {
        from_px: found.iter().map(|m| features[0][m.from].pixel_px).collect(),
        to_px: found.iter().map(|m| features[1][m.to].pixel_px).collect(),
    };
    let sigma_px = vec![0.2; found.len()];
    let camera = Camera::from_fov(1024, 1024, 1.0);
    let points_px: Vec<Vector2<f64>> = features[0].iter().take(1000).map(|f| f.pixel_px).collect();
    let moved = |p: &Vector2<f64>| {
        let q = p + Vector2::new(15.0, -4.0);
        Some(Vector2::new(1.03 * q.x - 0.03 * q.y, 0.03 * q.x + 1.03 * q.y) / (1.03f64.powi(2) + 0.03f64.powi(2)))
    };
    criterion.bench_function("follow 1000 patches there and back", |bench| {
        bench.iter(|| track_patches((black_box(&a), &b), &points_px, &moved, &KltConfig::default()));
    });
    criterion.bench_function("rotation of a pair", |bench| {
        let matches = PixelMatches { pair: &pair, sigma_px: &sigma_px };
        bench
            .iter(|| relative_rotation(black_box(matches), &camera, &PairHints::default(), &RotationConfig::default()));
    });
}

fn beside_plain_opencv(criterion: &mut Criterion) {
    plain::chains(criterion, &plain::TwoViews::new(texture));
}

criterion_group!(benches, front_end, beside_plain_opencv);
criterion_main!(benches);
