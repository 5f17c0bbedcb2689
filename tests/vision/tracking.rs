//! Tests of the wing `vision::tracking`: the front end over sequences on disk.

mod coasted_tracks;
mod gaps;
pub mod sequences;
