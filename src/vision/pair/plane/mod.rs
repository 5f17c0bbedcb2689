//! A plane with relief: the ground as a camera high above sees it.

mod fit;
mod model;
mod start;

pub use fit::{GroundFit, fit_ground};
pub use model::{Ground, whitening};
pub use start::plane_of_motion;
