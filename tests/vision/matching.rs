//! Tests of the wing `vision::matching`.

mod sift;
