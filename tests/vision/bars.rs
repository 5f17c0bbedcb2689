//! What the front end promises, measured on rendered pictures against their truth.

mod descriptors;
mod levels;
mod localisation;

use crate::bar::{Extent, check_table};

/// All bars that need rendered pictures, as one table.
#[test]
#[ignore = "minutes long: run by `make accuracy`"]
fn accuracy_of_the_front_end() {
    let parts = [levels::bars, localisation::bars, descriptors::bars];
    check_table("front end on rendered pictures", parts.into_iter().map(|part| part(Extent::Full)));
}
