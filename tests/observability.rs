//! Tests of the room `observability`.
