//! Tests of the wing `render::sensor`.

mod detector;
mod noise;
mod optics;
