//! The state of a descent, and the coordinates that its error is written in. Read `state` and `state_core`, then
//! `coordinates`, the interface of the two forms: `hybrid`, whose unobservable directions stay so, and `standard`, the
//! paper's own. `transition` and `jacobian` are what they give to propagation and correction; `ground_point` is where a
//! ray meets the ground. The other wings name the form only as `FilterKind`.

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
