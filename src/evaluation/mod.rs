//! The `evaluation` room.
