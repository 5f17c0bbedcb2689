//! Tests of the wing `navigation::tumbling`.

mod bounds;
mod files;
mod filters;
mod motion;
mod shooting;
mod simulated;
