//! Tests of the wing `vision::features`.

mod detectors;
mod images;
