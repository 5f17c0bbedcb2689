//! Tests of the room `terrain`.
