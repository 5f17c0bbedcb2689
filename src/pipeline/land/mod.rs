//! The landing's story. `run` is the story from a folder to a navigated descent; `map_sightings` joins the matcher of
//! maps (vision) with the loop that predicts where to look (navigation); `notes` says in words what a user should know
//! of the result.

mod map_sightings;
mod notes;
mod run;

pub use run::{LandRequest, land};
