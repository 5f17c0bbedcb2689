//! Where the Sun stands: by angles or a vector in a mission's own table, or by ephemeris.

mod ephemeris;
mod sunlight;

pub(super) use sunlight::direction;

pub use ephemeris::{EphemerisConfig, SunInIcrf};
pub use sunlight::{Sunlight, sun_angular_radius_rad};
