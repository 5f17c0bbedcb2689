//! What the front end promises, measured against its bounds: on rendered pictures, on simulated matches and on a real
//! descent.

mod center_table;
#[cfg(feature = "render")]
mod descriptors;
#[cfg(feature = "render")]
pub mod known_center;
mod landing_camera;
#[cfg(feature = "render")]
mod levels;
mod likelihood;
#[cfg(feature = "render")]
mod localisation;
#[cfg(feature = "render")]
mod rendered;
mod rotation_table;

#[cfg(feature = "render")]
use crate::accuracy_bar::{Extent, check_table};

/// All bars that need rendered pictures, as one table.
#[cfg(feature = "render")]
#[test]
#[ignore = "minutes long: run by `make accuracy`"]
fn accuracy_of_the_front_end() {
    let parts = [levels::bars, localisation::bars, descriptors::bars];
    check_table("front end on rendered pictures", parts.into_iter().map(|part| part(Extent::Full)));
}
