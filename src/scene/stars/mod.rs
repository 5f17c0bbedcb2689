//! Stars behind a small body.
//!
//! `bright_stars.csv` holds the brightest stars by name: right ascension and declination in degrees (ICRF, J2000) and
//! Johnson V magnitude, rounded from the Hipparcos catalogue (ESA 1997, SP-1200).

mod catalogue;
mod config;
mod sky;

pub use catalogue::Star;
pub use config::SkyConfig;
pub use sky::Sky;
