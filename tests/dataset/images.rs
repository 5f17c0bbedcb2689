//! Tests of the wing `dataset::images`.

mod folders;
mod grey_levels;
