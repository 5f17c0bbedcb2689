//! Tests of the wing `scene::elevation`.

mod formats;
mod model;
mod scenarios;
