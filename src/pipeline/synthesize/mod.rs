//! Scenario to data set: build the scene, draw every image with its truth, write the manifest last.
//!
//! One thread draws; others take what it has drawn, run the detector, pack, hash and write ([`workers`]), so that drawing
//! and writing overlap. Each finished image is noted in a journal with its checksums. A job that was killed at any
//! moment is continued from there: what the journal vouches for is kept, everything else is made anew, and the data set
//! ends up with the same bytes as an undisturbed one.

mod check;
mod draw;
mod flow;
mod folder;
mod frame;
mod lists;
mod measured;
mod record;
mod request;
mod run;
mod workers;

pub use draw::world;
pub use request::{SynthesizeRequest, Synthesized};
pub use run::synthesize;
