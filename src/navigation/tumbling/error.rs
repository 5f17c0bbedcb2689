//! What can go wrong in estimating a tumble.

use crate::dataset::DatasetError;
use crate::settings::OutOfRange;
use thiserror::Error;

/// Why there is no estimate.
#[derive(Debug, Error)]
pub enum TumblingError {
    /// Not enough usable pairs.
    #[error(
        "{usable} of {given} image pairs have a usable rotation, but {needed} are needed: use more pictures, a longer \
         sequence or a looser front end"
    )]
    TooFewPairs {
        /// Pairs with the status ok.
        usable: usize,
        /// All pairs.
        given: usize,
        /// The least number.
        needed: usize,
    },
    /// Too few images, or their times are out of order.
    #[error("the times of the {frames} pictures are not usable: at least 4 are needed, each after the one before")]
    FrameTimes {
        /// Number of images.
        frames: usize,
    },
    /// A pair at a time where there is no image, or with its times reversed.
    #[error(
        "the image pair from {t_ns_from} ns to {t_ns_to} ns does not join an earlier picture to a later one of this \
         sequence: give the rotations and the pictures of the same sequence"
    )]
    UnknownPair {
        /// Time of the first image in ns.
        t_ns_from: i64,
        /// Time of the second image in ns.
        t_ns_to: i64,
    },
    /// A rotation or covariance that is no number, or a covariance that is not positive definite.
    #[error(
        "the image pair from {t_ns_from} ns to {t_ns_to} ns has {problem}: mark it as rejected, or repair the front end"
    )]
    BadPair {
        /// Time of the first image in ns.
        t_ns_from: i64,
        /// Time of the second image in ns.
        t_ns_to: i64,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A setting outside its range.
    #[error("tumbling setting {0}")]
    OutOfRange(#[from] OutOfRange),
    /// No free rigid body moves like this.
    #[error(
        "no freely turning rigid body fits the rotations (typical misfit {misfit_deg:.2} degrees, {misfit_sigma:.0} times \
         their stated error): check that pairs are camera(to)_from_camera(from), that the camera does not turn, and the \
         pairs' covariances"
    )]
    NoConsistentMotion {
        /// Median misfit of a pair in degrees.
        misfit_deg: f64,
        /// The same in its standard deviations.
        misfit_sigma: f64,
    },
    /// A filter lost the motion: its inertia became singular, or its covariance no covariance.
    #[error("the filter lost the motion at {t_ns} ns: use the estimator 'shooting', or larger variances")]
    Diverged {
        /// Time in ns.
        t_ns: i64,
    },
    /// A file could not be written or read.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
}
