//! Tests of the wing `render::shading`.

mod light;
pub mod texture;
