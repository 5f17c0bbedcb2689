//! The `landmark` room.
