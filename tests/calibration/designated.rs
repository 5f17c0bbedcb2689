//! How far the looks of the ground lead a carried point off the ground.

use super::components::Sample;
use super::truth::{PageImage, Sequence};
use nalgebra::{Matrix2, Point3, Vector2};
use opnav::dataset::DesignatedPoint;
use opnav::vision::*;

/// Pictures over which a point is carried, and from where to where it starts.
const CARRIED: usize = 24;
/// Where points start, in parts of the picture about its middle.
const STARTS: [f64; 3] = [-0.12, 0.0, 0.12];

/// Drifts of carried points over the ground at every e-fold of a quarter of scale, px of the first picture. What the ties'
/// own errors make is fixed; the part is that of the looks, `Σ size² |ln of the change of scale|`.
pub fn drifts(sequence: &Sequence, group: usize, model: &NoiseModel) -> Vec<Sample<1>> {
    let count = sequence.pictures.len();
    let starts = [0, count / 2];
    let jobs =
        starts.iter().enumerate().map(|(k, first)| (*first, STARTS[(group + k) % 3], STARTS[(group + 2 * k) % 3]));
    jobs.flat_map(|(first, u, v)| drifts_of(sequence, group, (first, Vector2::new(u, v)), model)).collect()
}

fn drifts_of(
    sequence: &Sequence,
    group: usize,
    (first, place): (usize, Vector2<f64>),
    model: &NoiseModel,
) -> Vec<Sample<1>> {
    let camera = &sequence.camera;
    let (width_px, height_px) = camera.size_px();
    // About where the descent leads: that stays in view.
    let site_px = {
        let picture = &sequence.pictures[first];
        let in_camera = picture.reference_from_camera.inverse_transform_point(&Point3::origin()).coords;
        camera.project(&in_camera).unwrap_or(Vector2::new(f64::from(width_px), f64::from(height_px)) * 0.5)
    };
    let pixel_px = site_px + place * f64::from(width_px.min(height_px));
    if !camera.contains(&pixel_px, 30.0) {
        return Vec::new();
    }
    let start =
        DesignatedPoint { t_ns: sequence.pictures[first].t_ns, pixel_px, covariance_px2: Matrix2::identity() * 1e-6 };
    let config = FrontEndConfig { keyframe_spans: vec![], ..FrontEndConfig::default() }.with_noise_model(model);
    let prior = |from_ns: i64, to_ns: i64| {
        let [from, to] = [from_ns, to_ns].map(|t| sequence.at(t).map(|p| p.reference_from_camera.rotation));
        Some(to?.inverse() * from?)
    };
    let inputs = TrackInputs {
        frames: first..first + CARRIED,
        rotation_prior: Some(&prior),
        designated: Some(start),
        ..TrackInputs::default()
    };
    let found = track_sequence(&sequence.images, &config, &inputs, &|_| ()).expect("the pictures are tracked");
    samples(sequence, group, &found.designated, model)
}

fn samples(sequence: &Sequence, group: usize, steps: &[DesignatedStep], model: &NoiseModel) -> Vec<Sample<1>> {
    let camera = &sequence.camera;
    let on_ground = |step: &DesignatedStep| {
        let picture: &PageImage = sequence.at(step.t_ns)?;
        Some((picture.point(&step.pixel_px, camera)?.coords, picture.reference_from_camera.translation.vector))
    };
    let Some((first_m, camera_m)) = steps.first().and_then(on_ground) else { return Vec::new() };
    let pixel_m = (first_m - camera_m).norm() / camera.mean_focal_px();
    let (mut looks, mut next, mut found) = (0.0, 0.25, Vec::new());
    for pair in steps.windows(2) {
        let (before, size) = (pair[0].pixel_size, pair[1].pixel_size);
        looks += size.powi(2) * (before / size).ln().abs();
        if -size.ln() < next {
            continue;
        }
        next += 0.25;
        let Some((now_m, _)) = on_ground(&pair[1]) else { continue };
        let of_ties_px2 = pair[1].drift_first_px2 - model.designated.looks_sigma_px.powi(2) * looks;
        found.push(Sample {
            group,
            error: (now_m - first_m).xy() / pixel_m,
            fixed: Matrix2::identity() * of_ties_px2.max(0.0),
            parts: [Matrix2::identity() * looks],
        });
    }
    found
}
