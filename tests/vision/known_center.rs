//! What a rendered body's pictures tell of its rotation if the centre of rotation is known: the bound of the fixed-centre
//! model, whose other errors are those of the pictures.

use super::bearings::{angle_deg, median, median_angle_deg};
use nalgebra::{Unit, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::{CameraSource, ImageSequence, read_tum};
use opnav::vision::*;
use std::collections::BTreeMap;
use std::path::Path;

const SPANS: [usize; 4] = [1, 2, 3, 4];

/// Median error of the rotations, and the median that their covariances predict, degrees.
pub struct KnownCenter {
    pub error_deg: f64,
    pub predicted_deg: f64,
}

/// A pair of pictures by the tracks that it shares.
struct Pair {
    shared: MatchedPair,
    sigma_px: Vec<f64>,
    dt_s: f64,
    true_rotation: UnitQuaternion<f64>,
}

type Picture = BTreeMap<u64, (Vector2<f64>, f64)>;

/// Solves the adjacent pairs and the keyframe pairs of a tracked sequence once more, the centre held where it is.
pub fn with_known_center(images: &Path, tracks: &Path) -> KnownCenter {
    let sequence = ImageSequence::open(images, &CameraSource::Folder).expect("pictures");
    let attitudes = read_tum(&images.join("truth/cam0.tum")).expect("true attitudes");
    let mut pictures: BTreeMap<i64, Picture> = BTreeMap::new();
    for o in read_tracks(&tracks.join("tracks.csv")).expect("tracks") {
        pictures.entry(o.t_ns).or_default().insert(o.track_id, (o.pixel_px, o.sigma_px));
    }
    let all: Vec<(i64, UnitQuaternion<f64>, Picture)> = attitudes
        .iter()
        .filter_map(|a| Some((a.t_ns, a.reference_from_moving.rotation, pictures.get(&a.t_ns)?.clone())))
        .collect();
    let pairs: Vec<Pair> =
        SPANS.iter().flat_map(|span| all.windows(span + 1).map(|w| pair(&w[0], &w[*span]))).collect();
    let reference_from_camera = attitudes.first().expect("a pose").reference_from_moving;
    let solved = solve(&sequence, &pairs, Unit::new_normalize(reference_from_camera.inverse().translation.vector));
    let ok = || pairs.iter().zip(&solved.pairs).filter(|(_, s)| s.status == PairStatus::Ok);
    KnownCenter {
        error_deg: median(ok().map(|(p, s)| angle_deg(&p.true_rotation, &s.camera_to_from_camera_from)).collect()),
        predicted_deg: median(ok().map(|(_, s)| median_angle_deg(&s.covariance_rad2)).collect()),
    }
}

fn pair(
    (t_ns, reference_from_first, first): &(i64, UnitQuaternion<f64>, Picture),
    (later_ns, reference_from_second, second): &(i64, UnitQuaternion<f64>, Picture),
) -> Pair {
    const LEAST_SIGMA_PX: f64 = 0.05;
    let mut found = Pair {
        shared: MatchedPair::default(),
        sigma_px: Vec::new(),
        dt_s: (later_ns - t_ns) as f64 * 1e-9,
        true_rotation: reference_from_second.inverse() * reference_from_first,
    };
    for (track, (from_px, before_px)) in first {
        let Some((to_px, after_px)) = second.get(track) else { continue };
        found.shared.from_px.push(*from_px);
        found.shared.to_px.push(*to_px);
        let sigma_px = (after_px.powi(2) - before_px.powi(2)).max(LEAST_SIGMA_PX.powi(2)).sqrt();
        found.sigma_px.push(sigma_px * std::f64::consts::FRAC_1_SQRT_2);
    }
    found
}

fn solve(sequence: &ImageSequence, pairs: &[Pair], center_guess: Unit<Vector3<f64>>) -> CenterSolution {
    let (config, rotation) =
        (FixedCenterConfig { center_sigma_rad: 1e-7, ..FixedCenterConfig::default() }, RotationConfig::default());
    let problem = CenterProblem { camera: &sequence.sensor.camera, center_guess, config: &config, rotation: &rotation };
    let centered = pairs.iter().map(|p| CenteredPair {
        matches: PixelMatches { pair: &p.shared, sigma_px: &p.sigma_px },
        dt_s: p.dt_s,
        predicted: Some(p.true_rotation),
    });
    rotations_about_center(&centered.collect::<Vec<_>>(), &problem)
}
