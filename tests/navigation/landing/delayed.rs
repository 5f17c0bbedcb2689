//! Landmarks without a known plane: two rays place them.

use super::descent::{PLANET, bearing, exact_increment, normal3, truth};
use super::flight::{FLIGHT, Flight, fly};
use super::flown::{error, last_of, mean, nees};
use nalgebra::{DMatrix, Matrix3, SMatrix, SVector, Vector3};
use opnav::navigation::landing::{
    BearingObservation, DescentEstimate, DescentState, FilterKind, InitializationModel, LandingConfig, LandingEpoch,
    LandmarkRole, LandmarkStart, predict, triangulated, with_ray,
};
use opnav::navigation::landmark::GroundPrior;
use opnav::stats::{ConsistencyBounds, normalized_error_squared, random_stream};

/// A landmark from two rays: exact without noise, and its error and covariance agree over samples, in both coordinates;
/// rays that meet too flat place nothing.
#[test]
fn two_rays_place_a_landmark() {
    let (before, after) = (truth(60.0), truth(66.0));
    let increment = exact_increment(&before, &after, 6.0);
    let point_m = Vector3::new(700.0, 1500.0, 25.0);
    for kind in [FilterKind::Hybrid, FilterKind::Standard] {
        let model = InitializationModel { kind, camera_in_lander_m: Vector3::zeros(), ground: GroundPrior::default() };
        let sigma: [f64; 9] = [2.0, 3.0, 2.0, 0.1, 0.1, 0.2, 2e-4, 2e-4, 2e-4];
        let covariance = DMatrix::from_diagonal(&nalgebra::DVector::from_fn(9, |k, _| sigma[k] * sigma[k]));
        let place = |off: &SVector<f64, 9>, sees: &dyn Fn(usize) -> BearingObservation, least_rad: f64| {
            let state = DescentState {
                lander_in_site_m: before.position_m,
                lander_velocity_in_site_m_s: before.velocity_m_s,
                lander_from_site: before.lander_from_site,
                biases: None,
                landmarks: Vec::new(),
            };
            let state = kind.retract(state, (-off).as_slice());
            let start = DescentEstimate { state, covariance: covariance.clone() };
            let with_ray = with_ray(&start, &sees(0), (0, 2500.0), &model);
            assert_eq!(with_ray.state.landmarks[0].role, LandmarkRole::RayOrigin);
            let moved = predict(with_ray, &increment, &PLANET, kind);
            triangulated(&moved, 0, &sees(1), (least_rad, &model))
        };
        let exact = |k: usize| {
            let now = if k == 0 { before } else { after };
            let direction = nalgebra::Unit::new_normalize(now.lander_from_site * (point_m - now.position_m));
            BearingObservation::from_sigma(5, direction, 1e-3)
        };
        let placed = place(&SVector::zeros(), &exact, 0.03).expect("they meet");
        assert_eq!(placed.state.landmarks.len(), 1);
        assert!((placed.state.landmarks[0].position_in_site_m - point_m).norm() < 1e-6, "{kind:?}");
        assert!(place(&SVector::zeros(), &exact, 1.4).is_none(), "{kind:?}");

        let mut random = random_stream(7, "two rays", 0);
        let mut total = 0.0;
        let samples = 400;
        for _ in 0..samples {
            let off = SVector::<f64, 9>::from_fn(|k, _| normal3(&mut random, sigma[k]).x);
            let seen = [before, after].map(|now| bearing(&now, 5, &point_m, &mut random));
            let found = place(&off, &|k| seen[k], 0.03).expect("they meet");
            // Relative to the lander, in lander axes: what images can tell.
            let relative = |c: &nalgebra::UnitQuaternion<f64>, p: &Vector3<f64>, r: &Vector3<f64>| c * (p - r);
            let (state, p) = (&found.state, &found.covariance);
            let e = relative(&after.lander_from_site, &point_m, &after.position_m)
                - relative(&state.lander_from_site, &state.landmarks[0].position_in_site_m, &state.lander_in_site_m);
            let j = kind.relative_jacobian(state, &state.landmarks[0].position_in_site_m, true);
            let blocks = [(0, j.by_position), (6, j.by_attitude), (9, j.by_landmark)];
            let mut c = Matrix3::zeros();
            for (row, left) in &blocks {
                for (column, right) in &blocks {
                    c += left * p.fixed_view::<3, 3>(*row, *column) * right.transpose();
                }
            }
            total += normalized_error_squared(&e, &SMatrix::<f64, 3, 3>::from(c)).expect("definite") / 3.0;
        }
        let bounds = ConsistencyBounds::of_mean(3, samples, 0.9999);
        let nees = total / samples as f64;
        assert!((0.95 * bounds.lower..1.1 * bounds.upper).contains(&nees), "{kind:?} {nees} {bounds:?}");
    }
}

/// Nothing known of the ground: landmarks from long tracks still help, and the filter stays consistent.
#[test]
fn lands_without_a_plane() {
    let flight = Flight { longest_track: 25, ..FLIGHT };
    let inputs: Vec<_> = (0..12u64).map(|run| fly(&flight, run)).collect();
    let delayed = LandingConfig {
        landmark_start: LandmarkStart::Delayed,
        unknown_landmarks: 4,
        reselect_after: 12,
        ..LandingConfig::default()
    };
    let last = last_of(&inputs, &delayed);
    let alone = last_of(&inputs, &LandingConfig { unknown_landmarks: 0, ..LandingConfig::default() });
    let z = |epochs: &[LandingEpoch]| mean(epochs, |e| error(e)[2].powi(2)).sqrt();
    let believed = |epochs: &[LandingEpoch]| mean(epochs, |e| e.covariance[(2, 2)]).sqrt();
    assert!(z(&last) < z(&alone), "z {} m with, {} m without", z(&last), z(&alone));
    assert!(believed(&last) < 0.8 * believed(&alone), "z {} m with, {} m without", believed(&last), believed(&alone));
    let bounds = ConsistencyBounds::of_mean(9, last.len(), 0.999);
    assert!(bounds.contains(mean(&last, nees)), "NEES {}", mean(&last, nees));
}
