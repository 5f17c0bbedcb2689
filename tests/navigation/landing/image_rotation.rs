//! Rotations of images check the gyroscope and correct it.

use super::biases::{FORCE_SIGMA_M_S2, GYRO_SIGMA_RAD_S, biased};
use super::descent::{exact_increment, normal3, truth};
use super::flight::{FLIGHT, fly, truth_at_ns};
use super::flown::{land, last_of, mean, nees};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use opnav::geometry::so3::exp;
use opnav::navigation::landing::{
    BiasPrior, ImageRotation, ImageRotationUse, ImuIncrement, LandingConfig, LandingEpoch, LandingInput,
};
use opnav::stats::{ConsistencyBounds, random_stream};

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
