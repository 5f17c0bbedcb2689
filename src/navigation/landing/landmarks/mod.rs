//! Unknown landmarks: when one is visible and for how long (`visibility`), which to take next for what it will tell
//! (`select`, with the criteria of `navigation::landmark`), where its place starts, on a plane (`initialize`) or where
//! two bearings meet (`delayed_start`), and the errors of the designated point (`designated_point`). `step` calls them
//! once an image.

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
