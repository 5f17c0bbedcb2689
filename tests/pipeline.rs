//! Whole stories of the room `pipeline`: what they write, and what comes of it.

mod accuracy;
#[cfg(feature = "report")]
mod end_to_end;
mod land_by_map;
mod rendered_landings;
mod rendered_sequences;
mod synthesize;
