//! The state, and the coordinates that its error is written in: hybrid (consistent) or standard (the paper's own).

mod coordinates;
mod filter_kind;
mod ground_point;
mod hybrid;
mod jacobian;
mod standard;
mod state;
mod state_core;
mod transition;

pub use filter_kind::FilterKind;
pub use ground_point::ground_point;
pub use jacobian::{RayPoint, RelativeJacobian};
pub use state::{
    ATTITUDE, BIASES, DescentEstimate, DescentState, LandmarkRole, POSITION, UnknownLandmark, VELOCITY, WITH_BIASES,
};
pub use state_core::Core;
pub use transition::{LandmarkTransition, Transition};
