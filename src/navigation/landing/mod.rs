//! The `landing` room.
