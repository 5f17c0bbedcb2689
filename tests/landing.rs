//! Tests of the room `landing`.
