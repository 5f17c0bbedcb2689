//! Which truth a data set holds beside its images.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Truth for each pixel that is written on request; depth and mask are always there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TruthConfig {
    /// Unit normals of the surface in reference axes, detail finer than the mesh included (default false).
    pub normals: bool,
    /// Albedo (default false).
    pub albedo: bool,
    /// Optical flow from each image to the same camera's next one (default false).
    pub flow: bool,
}
