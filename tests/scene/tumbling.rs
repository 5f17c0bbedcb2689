//! Tests of the wing `scene::tumbling`.

mod papers_case;
mod shipped_bodies;
