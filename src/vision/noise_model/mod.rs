//! How wrong pixels are: every number that a covariance of the front end rests on, with where it comes from.
//!
//! The numbers stand in `noise_model.toml` beside this file, which `make calibrate` writes: it renders scenes of its own,
//! compares what the front end finds with the truth, and fits each number by a stated criterion. The file is part of the
//! library, so that none has to be there at run time; another one is read by [`NoiseModelFile::parse`] and handed to
//! [`FrontEndConfig::with_noise_model`](crate::vision::FrontEndConfig::with_noise_model). Each part is a setting of the wing
//! that uses it.

mod file;
mod model;

pub use file::{Constant, NoiseModelFile};
pub use model::{BodyNoise, CornerNoise, DesignatedNoise, MapNoise, NoiseModel, PairNoise, PatchNoise};
