//! Tests of the wing `scene::camera`.

mod lens;
mod several;
