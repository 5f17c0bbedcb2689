//! Images against a map of the ground: known landmarks by the dozen.
//!
//! A [`GroundMap`](crate::dataset::GroundMap) (orthoimages with heights) is drawn as the predicted camera sees it, corners
//! of that drawing are looked for in the image by their patches, and those that agree with one pose become
//! [`MapSighting`]s. A first, badly predicted image is matched by descriptors instead. Images that show more than the
//! map knows are made smaller first.

mod acquire;
mod config;
mod fit;
mod ground;
mod matcher;
mod points;
mod result;
mod view;

pub use config::{MapFeatures, MapMatchConfig};
pub use matcher::MapMatcher;
pub use result::{MapFix, MapSighting, MapStatus};
