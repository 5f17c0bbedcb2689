//! Tests of the room `landmark`.
