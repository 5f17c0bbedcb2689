//! The `filter` room.
