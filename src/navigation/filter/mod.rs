//! The estimators that every mission shares, and that know no spacecraft: the extended Kalman filter in Joseph's form with
//! an innovation gate, iterations and second-order terms, the unscented Kalman filter, and covariance intersection.
//!
//! A state is any [`Manifold`](crate::geometry::Manifold), its uncertainty a covariance in the tangent space
//! ([`Estimate`](crate::stats::Estimate)). Every function takes an estimate and returns a new one. A gated measurement is
//! an outcome, not an error; `None` says that a covariance is no longer one.
//!
//! Whoever knows the derivatives gives them as an [`Innovation`]: [`correct_linearized`] for a state of fixed size,
//! [`correction`] for a covariance of any size, sparse Jacobians and none of the state's business. Whoever has only a
//! model of the measurement calls [`correct`] or [`unscented_correct`].
//!
//! # A filter of one's own
//!
//! A lander falls straight down above a beacon that it has passed by 300 m, and measures the distance to it. The state is
//! height and speed; motion and measurement are two functions, and all else is here.
//!
//! ```
//! use nalgebra::{Matrix1, Matrix2, Vector1, Vector2};
//! use opnav::navigation::filter::{CorrectionOptions, Gate, Measurement, correct, predict};
//! use opnav::stats::Estimate;
//!
//! const DT_S: f64 = 1.0;
//! let fall = |x: &Vector2<f64>| Vector2::new(x[0] + x[1] * DT_S - 0.5 * 1.62 * DT_S * DT_S, x[1] - 1.62 * DT_S);
//! let range_m = |x: &Vector2<f64>| Vector1::new(x[0].hypot(300.0));
//!
//! // The truth, and what is believed: 50 m and 5 m/s (1σ) off.
//! let mut truth = Vector2::new(2000.0, -20.0);
//! let mut estimate = Estimate::from_sigma(Vector2::new(2040.0, -17.0), &Vector2::new(50.0, 5.0));
//! let options = CorrectionOptions { gate: Some(Gate { confidence: 0.9999 }), ..CorrectionOptions::default() };
//! for second in 0..20 {
//!     truth = fall(&truth);
//!     estimate = predict(&estimate, fall, &Matrix2::from_diagonal(&Vector2::new(1e-4, 1e-4)));
//!     let echo_m = if second == 10 { Vector1::new(5.0) } else { range_m(&truth) };
//!     let measurement = Measurement { value: echo_m, noise: Matrix1::new(0.25) };
//!     let after = correct(&estimate, &measurement, range_m, &options).expect("the covariance stays positive");
//!     assert_eq!(after.used, second != 10, "an echo off the landing leg fails the gate");
//!     estimate = after.estimate;
//! }
//! assert!((truth - estimate.state).norm() < 0.5);
//! assert!(estimate.sigma()[0] < 0.5);
//! ```

mod correction;
mod covariance_intersection;
mod ekf;
mod gate;
mod innovation;
mod root;
mod second_order;
mod unscented;

pub use correction::{Correction, correction, iterated_correction};
pub use covariance_intersection::{IntersectionWeights, covariance_intersection};
pub use ekf::{Corrected, CorrectionOptions, Measurement, correct, correct_linearized, predict};
pub use gate::Gate;
pub use innovation::{Blocks, ErrorState, Innovation};
pub use second_order::QuadraticMoments;
pub use unscented::{
    SigmaPoints, Transformed, UnscentedOptions, unscented_correct, unscented_predict, unscented_transform,
};
