//! Tests of the room `report`.

mod browser;
mod page;
mod plot;
#[cfg(feature = "scene")]
mod reference;
mod sample;
mod track_overlay;
