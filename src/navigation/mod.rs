//! Estimators, one folder a mission, and the three rooms that they share.

pub mod filter;
pub mod landing;
pub mod landmark;
pub mod observability;
pub mod tumbling;

pub use landing::{correct, predict};
