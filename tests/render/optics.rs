//! Tests of the wing `render::optics`.

mod lens;
mod motion;
mod pixels;
