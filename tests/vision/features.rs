//! Tests of the wing `vision::features`.

mod detectors;
pub mod images;
