//! From scene to pixel: `projection` of the pinhole, `sample_grid`, several samples a pixel with one at its centre,
//! `lens`, which looks samples up where the distortion puts them, and `motion_blur`, the moments of an exposure and
//! their rows. `renderer` and the exposure use it.

mod lens;
mod motion_blur;
mod projection;
mod sample_grid;

pub use lens::Lens;
pub use motion_blur::SubImages;
pub use projection::{corner_rays_in_camera, side_planes_in_camera};
