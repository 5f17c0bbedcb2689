//! The landing's story: from a folder to a navigated descent, with a map or without.

mod map_sightings;
mod notes;
mod run;

pub use run::{LandRequest, land};
