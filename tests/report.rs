//! Tests of the room `report`.

mod browser;
mod page;
mod plot;
mod reference;
mod sample;
