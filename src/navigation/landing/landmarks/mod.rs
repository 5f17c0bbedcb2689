//! Which unknown landmark to follow, when it is visible, and how its place starts.

mod delayed_start;
mod designated_point;
mod initialize;
mod select;
mod visibility;

pub use delayed_start::{triangulated, with_ray};
pub use designated_point::with_designated_errors;
pub use initialize::{InitializationModel, initial_estimate, with_landmark, with_landmark_at_height, without_landmark};
pub use select::{Memory, Selection, with_chosen, with_triangulated, without_lost};
pub use visibility::{LookAhead, survives, viewpoint};
