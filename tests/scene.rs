//! Tests of the room `scene`.
