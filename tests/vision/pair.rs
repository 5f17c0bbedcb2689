//! Tests of the wing `vision::pair`.

pub mod bearings;
pub mod fixed_center;
mod relative_rotation;
