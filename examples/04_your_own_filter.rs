//! A filter of one's own: a state, how it moves and what is measured are all that has to be written.
//!
//!     cargo run --no-default-features --example 04_your_own_filter
//!
//! A spacecraft turns; its gyroscope drifts; every second it sees one of three stars. The filter estimates attitude and
//! drift together. Whether it believes itself rightly is then judged over many runs, with a control that must fail.

use nalgebra::{Matrix3, SMatrix, SVector, UnitQuaternion, Vector3};
use opnav::geometry::Manifold;
use opnav::geometry::so3::exp;
use opnav::navigation::filter::{CorrectionOptions, Gate, Measurement, correct, predict};
use opnav::stats::{ConsistencyBounds, Estimate, normalized_error_squared, random_stream};
use rand_distr::{Distribution, StandardNormal};

/// Attitude and drift, 6 degrees of freedom: an attitude has no vector to add, so the state says what adding means.
#[derive(Debug, Clone, PartialEq)]
struct Turning {
    inertial_from_node: UnitQuaternion<f64>,
    gyro_bias_rad_s: Vector3<f64>,
}

impl Manifold<6> for Turning {
    fn plus(&self, d: &SVector<f64, 6>) -> Self {
        Turning {
            inertial_from_node: self.inertial_from_node.plus(&d.fixed_rows::<3>(0).into_owned()),
            gyro_bias_rad_s: self.gyro_bias_rad_s + d.fixed_rows::<3>(3),
        }
    }
    fn minus(&self, other: &Self) -> SVector<f64, 6> {
        let turn = self.inertial_from_node.minus(&other.inertial_from_node);
        let drift = self.gyro_bias_rad_s - other.gyro_bias_rad_s;
        SVector::from_iterator(turn.iter().chain(drift.iter()).copied())
    }
}

const GYRO_NOISE_RAD: f64 = 2e-5; // 1σ of a second's sum
const STAR_NOISE: f64 = 1e-4; // 1σ of each coordinate of a direction

/// One run of 60 s. Gives the normalised error squared at its end, and tells every tenth second if `aloud`.
fn run(seed: u64, believed_star_noise: f64, aloud: bool) -> f64 {
    let mut random = random_stream(seed, "own filter", 0);
    let mut white =
        |sigma: f64| Vector3::from_fn(|_, _| sigma * Distribution::<f64>::sample(&StandardNormal, &mut random));
    let stars = [Vector3::x(), Vector3::y(), Vector3::new(0.0, 0.6, 0.8)];
    let rate_rad_s = Vector3::new(0.01, -0.02, 0.005);

    let sigma = SVector::from_column_slice(&[0.02, 0.02, 0.02, 1e-4, 1e-4, 1e-4]);
    let at_rest = Turning { inertial_from_node: UnitQuaternion::identity(), gyro_bias_rad_s: Vector3::zeros() };
    let mut estimate = Estimate::from_sigma(at_rest, &sigma);
    let mut truth = Turning { inertial_from_node: exp(&white(0.02)), gyro_bias_rad_s: white(1e-4) };
    let process_noise =
        SMatrix::from_diagonal(&SVector::from_fn(|k, _| if k < 3 { GYRO_NOISE_RAD.powi(2) } else { 0.0 }));
    let options = CorrectionOptions { gate: Some(Gate { confidence: 0.999_99 }), ..CorrectionOptions::default() };

    for second in 1..=60 {
        truth.inertial_from_node *= exp(&rate_rad_s);
        let gyro_rad = rate_rad_s + truth.gyro_bias_rad_s + white(GYRO_NOISE_RAD);
        let turned = |x: &Turning| Turning {
            inertial_from_node: x.inertial_from_node * exp(&(gyro_rad - x.gyro_bias_rad_s)),
            ..x.clone()
        };
        estimate = predict(&estimate, turned, &process_noise);

        let star = stars[second % stars.len()];
        let seen = |x: &Turning| x.inertial_from_node.inverse() * star;
        let noise = Matrix3::identity() * believed_star_noise.powi(2);
        let value = if second == 25 { -seen(&truth) } else { seen(&truth) + white(STAR_NOISE) }; // a planet, once
        let after =
            correct(&estimate, &Measurement { value, noise }, seen, &options).expect("the covariance is positive");
        if aloud && (second % 10 == 0 || !after.used) {
            let error_mrad = truth.minus(&after.estimate.state).fixed_rows::<3>(0).norm() * 1e3;
            let sigma_mrad = after.estimate.sigma().fixed_rows::<3>(0).norm() * 1e3;
            let used = if after.used { "" } else { "  (refused: not where a star can be)" };
            println!("{second:3} s: attitude off by {error_mrad:.4} mrad, 1σ {sigma_mrad:.4} mrad{used}");
        }
        estimate = after.estimate;
    }
    normalized_error_squared(&truth.minus(&estimate.state), &estimate.covariance).expect("the covariance is regular")
}

fn main() {
    run(1, STAR_NOISE, true);
    let runs = 200;
    let bounds = ConsistencyBounds::of_mean(6, runs, 0.99);
    for (what, believed) in [("as they are", STAR_NOISE), ("for half of what they are", 0.5 * STAR_NOISE)] {
        let mean = (0..runs as u64).map(|seed| run(seed, believed, false)).sum::<f64>() / (6 * runs) as f64;
        let (low, high) = (bounds.lower, bounds.upper);
        println!("star errors taken {what}: NEES/6 {mean:.2}, {low:.2} to {high:.2} expected");
        println!("  {}", bounds.diagnosis(mean));
    }
}
