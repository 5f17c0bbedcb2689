//! Attitude, spin and inertia ratios of a small body that turns freely, from rotations between images.
//!
//! The camera does not turn, so its axes are the inertial ones; the asteroid axes are the camera's at the first image.
//! A pair of images gives `camera(to)_from_camera(from)` as a camera that moves around a resting body would see it, which
//! is `A(to)⁻¹ A(from)` with `A = asteroid_from_inertial`. The motion is Euler's, so eight numbers say everything: the
//! initial rate and five inertia ratios. [`estimate`] is the way in. Where the motion does not show a direction of the
//! inertia (a pure spin hides three), the result names the direction and gives no number for it.
//!
//! Source: Deng et al., "Motion state estimation of small celestial bodies based on system observability analysis" (2024),
//! with its errata put right (see [`PaperFilter`]): `ω̇ ≠ 0` does not imply full rank (one direction stays hidden on the
//! separatrix), and rank 11 is generically reached with the third Lie derivative already ([`lie_derivatives`]).

mod bounds;
mod config;
mod error;
mod estimate;
mod files;
mod filters;
mod motion;
mod pair;
mod result;
mod shooting;

pub use bounds::{ArcBound, ArcDesign, UndeterminedDirection, planned_pairs};
pub use bounds::{arc_bound, lie_derivatives};
pub use config::{Estimator, PaperConfig, PaperIntegration, TumblingConfig};
pub use error::TumblingError;
pub use estimate::estimate;
pub use files::{write_covariance_csv, write_estimate_csv};
pub use filters::{PaperFilter, PaperState};
pub use motion::{FreeBody, INERTIA_NAMES, InertiaRatios, Sensitivity, SpinState, TrajectoryPoint, propagate};
pub use result::{InertiaKnowledge, TumblingEpoch, TumblingResult};
