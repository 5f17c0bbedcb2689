//! Tests of the wing `vision::features`.

mod pictures;
