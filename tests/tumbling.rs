//! Tests of the room `tumbling`.
