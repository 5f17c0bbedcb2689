//! The state, and the coordinates that its error is written in: hybrid (consistent) or standard (the paper's own).

mod coordinates;
mod hybrid;
mod standard;
mod state;

pub use coordinates::{LandmarkTransition, RayPoint, RelativeJacobian, Transition};
pub use state::{
    ATTITUDE, BIASES, DescentEstimate, DescentState, ImuBiases, LARGEST, LandmarkRole, POSITION, UnknownLandmark,
    VELOCITY, WITH_BIASES,
};
