//! Tests of the wing `render::gpu`.

mod adapters;
mod depth;
mod repetition;
