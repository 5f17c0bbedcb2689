//! What can be wrong with the navigation of a landing.

use crate::geometry::CameraError;
use crate::settings::OutOfRange;
use thiserror::Error;

/// Why a descent could not be navigated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LandingError {
    /// An option outside its range.
    #[error("landing option {0}")]
    OutOfRange(#[from] OutOfRange),
    /// The camera cannot be used.
    #[error("the lander's camera cannot be used: {0}")]
    Camera(#[from] CameraError),
    /// A list that must not be empty is.
    #[error("there are no {what}: {cure}")]
    Empty {
        /// The list.
        what: &'static str,
        /// What to do.
        cure: &'static str,
    },
    /// Times that must increase do not.
    #[error("{what} are not in order of time at {t_ns} ns: sort them and remove doubles")]
    Order {
        /// The list.
        what: &'static str,
        /// Where, ns.
        t_ns: i64,
    },
    /// The IMU does not cover a stretch of time that is too long to be bridged.
    #[error(
        "the IMU has no samples between {from_ns} ns and {to_ns} ns, too long to bridge: give a complete record of the \
         same time, or drop those frames"
    )]
    ImuGap {
        /// Start in ns.
        from_ns: i64,
        /// End in ns.
        to_ns: i64,
    },
    /// A value that is not finite, or a 1σ that is not positive.
    #[error("{what} at {t_ns} ns cannot be used: {cure}")]
    Value {
        /// The list.
        what: &'static str,
        /// When, ns.
        t_ns: i64,
        /// What to do.
        cure: &'static str,
    },
    /// The initial state comes after the first frame.
    #[error("the initial state is of {initial_ns} ns, after the first frame at {frame_ns} ns: start at a later frame")]
    LateStart {
        /// Time of the initial state, ns.
        initial_ns: i64,
        /// Time of the first frame, ns.
        frame_ns: i64,
    },
    /// An observation of a time without a frame.
    #[error(
        "track {track_id} is observed at {t_ns} ns, where there is no frame: give the frame times of the same data"
    )]
    NoFrame {
        /// The track.
        track_id: u64,
        /// When, ns.
        t_ns: i64,
    },
    /// The covariance is no longer positive definite.
    #[error("the filter's covariance broke down at {t_ns} ns: check the noise densities and the initial sigmas")]
    BrokeDown {
        /// When, ns.
        t_ns: i64,
    },
}
