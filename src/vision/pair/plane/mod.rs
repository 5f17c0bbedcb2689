//! A plane with relief: the ground as a camera high above sees it.

mod fit;
mod model;
mod start;

pub use fit::{ReliefPlaneFit, fit_relief_plane};
pub use model::{ReliefPlane, whitening};
pub use start::plane_of_motion;
