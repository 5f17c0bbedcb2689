//! Tests of the wing `dataset::storage`.

mod atomic;
mod manifest;
mod tables;
