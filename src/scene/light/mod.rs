//! Where the Sun stands: by angles or a vector in a mission's own table, or by ephemeris.

mod ephemeris;
mod sunlight;

pub use ephemeris::{EphemerisConfig, SunInIcrf};
pub use sunlight::{Sunlight, direction, sun_angular_radius_rad};
