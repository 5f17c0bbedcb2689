//! Landing with more than the paper has: landmarks without a known plane, biases, points of a map, rotations of images.

use super::descent::{PLANET, bearing, exact_increment, normal3, pose_error, truth};
use super::flight::{FLIGHT, Flight, camera, fly, truth_at_ns};
use nalgebra::{DMatrix, Matrix3, SMatrix, SVector, Vector2, Vector3};
use opnav::geometry::so3::exp;
use opnav::navigation::landing::{
    BearingObservation, BiasPrior, DescentEstimate, DescentState, FilterKind, ImageRotation, ImageRotationUse,
    ImuIncrement, InitializationModel, KnownSighting, LandingConfig, LandingEpoch, LandingInput, LandingResult,
    LandmarkRole, LandmarkStart, navigate, predict, triangulated, with_ray,
};
use opnav::navigation::landmark::GroundPrior;
use opnav::stats::{ConsistencyBounds, normalized_error_squared, random_stream};
use rayon::prelude::*;

fn error(epoch: &LandingEpoch) -> SVector<f64, 9> {
    pose_error(&truth_at_ns(epoch.t_ns), &epoch.site_from_lander, &epoch.lander_velocity_in_site_m_s)
}

fn nees(epoch: &LandingEpoch) -> f64 {
    normalized_error_squared(&error(epoch), &epoch.covariance).expect("a positive definite covariance") / 9.0
}

fn land(input: &LandingInput, config: &LandingConfig) -> LandingResult {
    navigate(input, config, &|_| ()).expect("a navigable descent")
}

/// The last epoch with an image of every flight.
fn last_of(inputs: &[LandingInput], config: &LandingConfig) -> Vec<LandingEpoch> {
    inputs.par_iter().map(|input| land(input, config).epochs.swap_remove(input.frame_times_ns.len() - 1)).collect()
}

fn mean(epochs: &[LandingEpoch], of: impl Fn(&LandingEpoch) -> f64) -> f64 {
    epochs.iter().map(of).sum::<f64>() / epochs.len() as f64
}

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

/// The same flight with an IMU that measures too much by constant biases.
fn biased(mut input: LandingInput, run: u64) -> (LandingInput, Vector3<f64>, Vector3<f64>) {
    let mut random = random_stream(11, "biases", run);
    let gyroscope_rad_s = normal3(&mut random, GYRO_SIGMA_RAD_S);
    let accelerometer_m_s2 = normal3(&mut random, FORCE_SIGMA_M_S2);
    for sample in &mut input.imu {
        sample.rate_in_lander_rad_s += gyroscope_rad_s;
        sample.specific_force_in_lander_m_s2 += accelerometer_m_s2;
    }
    (input, gyroscope_rad_s, accelerometer_m_s2)
}

const GYRO_SIGMA_RAD_S: f64 = 2e-5;
const FORCE_SIGMA_M_S2: f64 = 3e-3;

/// With the biases in the state the filter is consistent, finds what the motion shows of them, and lands; without them
/// it is not.
#[test]
fn biases_are_estimated() {
    let flown: Vec<_> = (0..12u64).map(|run| biased(fly(&FLIGHT, run), run)).collect();
    let inputs: Vec<_> = flown.iter().map(|f| f.0.clone()).collect();
    let prior = BiasPrior { sigma_gyroscope_rad_s: GYRO_SIGMA_RAD_S, sigma_accelerometer_m_s2: FORCE_SIGMA_M_S2 };
    let knowing = LandingConfig { biases: Some(prior), unknown_landmarks: 3, ..LandingConfig::default() };
    let ignorant = LandingConfig { biases: None, ..knowing.clone() };
    let bounds = ConsistencyBounds::of_mean(9, inputs.len(), 0.999);
    let last = last_of(&inputs, &knowing);
    assert!(bounds.contains(mean(&last, nees)), "NEES {}", mean(&last, nees));
    assert!(mean(&last_of(&inputs, &ignorant), nees) > 3.0 * bounds.upper);
    let mut normalized = 0.0;
    for (epoch, (_, gyroscope, accelerometer)) in last.iter().zip(&flown) {
        let (biases, sigma) = epoch.biases.expect("estimated");
        for k in 0..3 {
            normalized += ((biases.gyroscope_rad_s - gyroscope)[k] / sigma[k]).powi(2);
            normalized += ((biases.accelerometer_m_s2 - accelerometer)[k] / sigma[3 + k]).powi(2);
        }
        // The vertical one is seen in the motion.
        assert!(sigma[5] < 0.4 * FORCE_SIGMA_M_S2, "{sigma:?}");
    }
    let per_bias = normalized / (6 * last.len()) as f64;
    assert!((0.5..1.6).contains(&per_bias), "{per_bias}");
}

/// What the images tell of the lander's rotation between two frames, with noise.
fn image_rotations(input: &LandingInput, sigma_rad: f64, run: u64) -> Vec<ImageRotation> {
    let mut random = random_stream(13, "image rotations", run);
    input
        .frame_times_ns
        .windows(2)
        .map(|pair| {
            let (from, to) = (truth_at_ns(pair[0]), truth_at_ns(pair[1]));
            let exact = to.lander_from_site * from.lander_from_site.inverse();
            ImageRotation {
                from_t_ns: pair[0],
                to_t_ns: pair[1],
                after_from_before: exp(&normal3(&mut random, sigma_rad)) * exact,
                covariance_rad2: Matrix3::identity() * sigma_rad.powi(2),
            }
        })
        .collect()
}

/// Images check the gyroscope: where both are right the difference is as large as their covariances say; a gyroscope that
/// drifts is found out. As measurements they find its bias.
#[test]
fn image_rotations_check_and_correct_the_gyroscope() {
    let with_rotations = |mut input: LandingInput, run: u64| {
        input.rotations = image_rotations(&input, 3e-5, run);
        input
    };
    let check = |input: &LandingInput| {
        let result = land(input, &LandingConfig::default());
        let checks: Vec<_> = result.epochs.iter().filter_map(|e| e.rotation_check).collect();
        checks.iter().map(|c| c.normalized_squared / 3.0).sum::<f64>() / checks.len() as f64
    };
    let good = with_rotations(fly(&FLIGHT, 0), 0);
    assert!((0.7..1.3).contains(&check(&good)), "{}", check(&good));
    let flown: Vec<_> = (0..8u64).map(|run| biased(fly(&FLIGHT, run), run)).collect();
    let inputs: Vec<_> = flown.iter().zip(0..).map(|(f, run)| with_rotations(f.0.clone(), run)).collect();
    assert!(inputs.iter().map(check).sum::<f64>() / 8.0 > 1.5);
    let prior = BiasPrior { sigma_gyroscope_rad_s: GYRO_SIGMA_RAD_S, sigma_accelerometer_m_s2: FORCE_SIGMA_M_S2 };
    let config = |image_rotation| LandingConfig { biases: Some(prior), image_rotation, ..LandingConfig::default() };
    let off = |image_rotation| {
        let last = last_of(&inputs, &config(image_rotation));
        let square = |(e, f): (&LandingEpoch, &(LandingInput, Vector3<f64>, Vector3<f64>))| {
            (e.biases.expect("estimated").0.gyroscope_rad_s - f.1).norm_squared()
        };
        (last.iter().zip(&flown).map(square).sum::<f64>().sqrt(), mean(&last, nees))
    };
    let ((checked, _), (measured, nees)) = (off(ImageRotationUse::Check), off(ImageRotationUse::Measure));
    assert!(measured < 0.8 * checked, "{measured} against {checked}");
    let bounds = ConsistencyBounds::of_mean(9, inputs.len(), 0.999);
    assert!(bounds.contains(nees), "NEES {nees}");
}

/// Without biases a rotation from images corrects the increment as a Kalman update of its error would, the velocity by its
/// correlation too; a perfect one leaves no rotation error.
#[test]
fn an_increment_takes_the_images_rotation_in() {
    let mut increment: ImuIncrement = exact_increment(&truth(60.0), &truth(61.0), 1.0);
    let truth_increment = increment.clone();
    let mut covariance = SMatrix::<f64, 9, 9>::identity() * 1e-6;
    covariance[(0, 3)] = 5e-7;
    covariance[(3, 0)] = 5e-7;
    increment.covariance = covariance;
    increment = increment.adjusted(&-SVector::<f64, 9>::from_fn(|k, _| if k == 0 { 1e-3 } else { 0.0 }));
    let rotation = ImageRotation {
        from_t_ns: 0,
        to_t_ns: 1,
        after_from_before: truth_increment.before_from_after.inverse(),
        covariance_rad2: Matrix3::identity() * 1e-14,
    };
    let fused = rotation.fused(&increment).expect("regular");
    assert!(fused.before_from_after.angle_to(&truth_increment.before_from_after) < 1e-8);
    let gained = (fused.velocity_in_before_m_s - increment.velocity_in_before_m_s).x;
    assert!((gained - 5e-4).abs() < 1e-8, "{gained}");
    assert!(fused.covariance[(0, 0)] < 1e-13 && fused.covariance[(3, 3)] < increment.covariance[(3, 3)]);
    let check = rotation.check(&increment).expect("regular");
    assert!((check.angle_rad - 1e-3).abs() < 1e-8 && (check.normalized_squared - 1.0).abs() < 1e-3, "{check:?}");
}

/// Sightings of points of a map make yaw observable and tie the height; points that are off by more than they claim are
/// gated, not believed.
#[test]
fn a_map_makes_yaw_observable() {
    let with_map = |run: u64, off_m: f64| {
        let mut input = fly(&FLIGHT, run);
        let mut random = random_stream(17, "map", run);
        let (camera, lander_from_camera) = camera();
        let sigma_point_m = 1.0;
        let points: Vec<Vector3<f64>> = (0..60)
            .map(|k| {
                let spread = 2500.0 * (f64::from(k + 1) / 60.0).powi(2);
                let angle = f64::from(k) * 2.4;
                Vector3::new(spread * angle.cos(), spread * angle.sin(), 0.0)
            })
            .collect();
        let charted: Vec<Vector3<f64>> =
            points.iter().map(|p| p + normal3(&mut random, sigma_point_m) + Vector3::x() * off_m).collect();
        for t_ns in input.frame_times_ns.clone() {
            let now = truth_at_ns(t_ns);
            let mut seen = 0;
            // The outermost first: they tell yaw best.
            for (point_m, charted_m) in points.iter().zip(&charted).rev() {
                let in_lander = now.lander_from_site * (point_m - now.position_m);
                let Some(pixel) = camera.project(&lander_from_camera.inverse_transform_point(&in_lander.into()).coords)
                else {
                    continue;
                };
                if seen < 8 && camera.contains(&pixel, 5.0) {
                    seen += 1;
                    let noise = normal3(&mut random, 0.2);
                    input.known.push(KnownSighting {
                        t_ns,
                        pixel_px: pixel + Vector2::new(noise.x, noise.y),
                        sigma_px: 0.2,
                        point_in_site_m: *charted_m,
                        sigma_point_m,
                    });
                }
            }
        }
        input
    };
    let inputs: Vec<_> = (0..8).map(|run| with_map(run, 0.0)).collect();
    let last = last_of(&inputs, &LandingConfig::default());
    let rms = |k: usize| mean(&last, |e| error(e)[k].powi(2)).sqrt();
    assert!(rms(8) < 5e-3 && rms(2) < 1.5, "yaw {} rad, z {} m", rms(8), rms(2));
    assert!(last.iter().any(|e| e.known_points > 0) || inputs[0].known.last().is_some_and(|k| k.t_ns > 0));
    let without: Vec<_> = (0..8).map(|run| fly(&FLIGHT, run)).collect();
    assert!(mean(&last_of(&without, &LandingConfig::default()), |e| error(e)[8].powi(2)).sqrt() > 5e-3);
    // Negative control: a map that is 300 m off is contradicted by the designated point.
    let gated = |input: &LandingInput| land(input, &LandingConfig::default()).gated;
    let (right, wrong) = (gated(&inputs[0]), gated(&with_map(0, 300.0)));
    assert!(wrong > 30 && right < 10, "{wrong} gated of a wrong map, {right} of a right one");
}
