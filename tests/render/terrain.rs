//! Tests of the wing `render::terrain`.

mod elevation;
