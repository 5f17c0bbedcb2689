//! Tests of the wing `scene::body`.

mod albedo;
mod boulders;
mod formats;
mod large;
mod mesh;
mod procedural;
