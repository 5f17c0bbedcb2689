//! One way for settings: range checks with a cure, shared by every room.

pub mod limits;
