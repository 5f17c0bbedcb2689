//! A plane with relief: the ground as a camera high above sees it. `model` is its likelihood with the relief
//! marginalised, `start` takes plane and motion from a homography, `fit` climbs. It becomes the epipolar constraint
//! where relief shows and the homography where it does not.

mod fit;
mod model;
mod start;

pub use fit::{ReliefPlaneFit, fit_relief_plane};
pub use model::{ReliefPlane, whitening};
pub use start::plane_of_motion;
