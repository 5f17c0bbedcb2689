//! What `shaders/photometry.wgsl` reads of a material.

use super::gpu_data::Photometry as PhotometryData;
use crate::scene::{LunarWeight, Photometry, oren_nayar_coefficients};
use bytemuck::Zeroable;

const LUNAR_LAMBERT: u32 = 0;
const OREN_NAYAR: u32 = 1;

/// The material's parameters. Lambert's and Lommel-Seeliger's laws are the ends of the lunar-Lambert law.
pub(super) fn photometry_data(photometry: &Photometry) -> PhotometryData {
    match photometry {
        Photometry::Lambert => lunar_lambert(&LunarWeight::Constant(0.0)),
        Photometry::LommelSeeliger => lunar_lambert(&LunarWeight::Constant(1.0)),
        Photometry::LunarLambert { weight } => lunar_lambert(weight),
        Photometry::OrenNayar { slope_sigma_deg } => {
            let [c1, c2] = oren_nayar_coefficients(slope_sigma_deg.to_radians());
            PhotometryData { model: OREN_NAYAR, rough: [c1 as f32, c2 as f32, 0.0, 0.0], ..Zeroable::zeroed() }
        }
    }
}

fn lunar_lambert(weight: &LunarWeight) -> PhotometryData {
    PhotometryData { model: LUNAR_LAMBERT, lunar: weight.coefficients().map(|c| c as f32), ..Zeroable::zeroed() }
}
