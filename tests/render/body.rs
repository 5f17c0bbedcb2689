//! Tests of the wing `render::body`.

mod albedo;
