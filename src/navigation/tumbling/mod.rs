//! The `tumbling` room.
