//! Tests of the room `observations`.

mod files;
