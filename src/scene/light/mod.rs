//! Where the Sun stands: by angles or a vector in a mission's own table, or by an ephemeris kernel (`ephemeris`,
//! through anise); `sunlight` is the direction with the disc's angle that all of them give.

mod ephemeris;
mod sunlight;

pub use ephemeris::{EphemerisConfig, SunInIcrf};
pub use sunlight::{Sunlight, direction, sun_angular_radius_rad};
