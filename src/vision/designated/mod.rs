//! The designated point: `carry` takes it from image to image by the matches about it, `keyframes` finds it again in
//! earlier images to bound its drift, `drift` says how far it has wandered. The landing filter reads the outcome as
//! track 0.

mod carry;
mod drift;
mod keyframes;

pub use carry::carry_designated;
pub use drift::drift_per_image_px;
