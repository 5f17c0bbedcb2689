//! How materials scatter sunlight.

mod directions;
mod lunar_lambert;
mod model;
mod oren_nayar;

pub use directions::PhotometricAngles;
pub use lunar_lambert::LunarWeight;
pub use model::Photometry;
pub use oren_nayar::oren_nayar_coefficients;
