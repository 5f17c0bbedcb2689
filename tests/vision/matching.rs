//! Tests of the wing `vision::matching`.

mod matcher;
mod sift;
