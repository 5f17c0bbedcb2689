//! From scene to pixel: projections, lenses, sample grids, motion within an exposure.

mod lens;
mod motion_blur;
mod projection;
mod sample_grid;

pub use lens::Lens;
pub use motion_blur::SubImages;
pub use projection::{corner_rays_in_camera, side_planes_in_camera};
