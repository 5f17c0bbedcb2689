//! Where a body's inertia comes from.

use super::rigid_body::RigidBody;
use crate::scene::body::MassProperties;
use crate::settings::OutOfRange;
use nalgebra::Matrix3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Inertia of a tumbling body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum InertiaSource {
    /// A tensor in asteroid axes (rows), to scale only; it need not be that of the shape.
    Tensor([[f64; 3]; 3]),
    /// That of the shape at uniform density.
    FromShape,
}

impl Default for InertiaSource {
    /// The case of Deng et al. (2024).
    fn default() -> Self {
        InertiaSource::Tensor([[0.85, 0.13, 0.17], [0.13, 1.37, -0.11], [0.17, -0.11, 1.0]])
    }
}

impl InertiaSource {
    /// The rigid body, its tensor scaled so that the last element is 1.
    ///
    /// # Errors
    /// Names the key `inertia` if no body can have the tensor.
    pub fn rigid_body(&self, shape: &MassProperties) -> Result<RigidBody, OutOfRange> {
        let tensor = match self {
            InertiaSource::Tensor(rows) => Matrix3::from_fn(|row, column| rows[row][column]),
            InertiaSource::FromShape => shape.inertia_m5,
        };
        let body = RigidBody::new(&tensor)?;
        RigidBody::new(&(body.inertia() / tensor[(2, 2)]))
    }

    /// Checks that a body can have the tensor.
    ///
    /// # Errors
    /// Names the key `inertia`.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        match self {
            InertiaSource::Tensor(rows) => RigidBody::new(&Matrix3::from_fn(|r, c| rows[r][c])).map(|_| ()),
            InertiaSource::FromShape => Ok(()),
        }
    }
}
