//! Rotations about a fixed centre: the problem and its solution.

use crate::geometry::Camera;
use crate::vision::pair::config::{FixedCenterConfig, RotationConfig};
use crate::vision::pair::solution::{PairSolution, PixelMatches};
use nalgebra::{Matrix2, Unit, UnitQuaternion, Vector3};

/// A pair of images of the body.
#[derive(Debug, Clone, Copy)]
pub struct CenteredPair<'a> {
    /// The matched pixels.
    pub matches: PixelMatches<'a>,
    /// Time between the images, s.
    pub dt_s: f64,
    /// Predicted rotation, where there is one.
    pub predicted: Option<UnitQuaternion<f64>>,
}

/// Rotations of all pairs, and the centre that they share.
#[derive(Debug, Clone, PartialEq)]
pub struct CenterSolution {
    /// Direction of the centre in the camera.
    pub center_in_camera: Unit<Vector3<f64>>,
    /// Its covariance (rad²) along the axes of [`so3::tangent_basis`](crate::geometry::so3::tangent_basis). The part of the rotations' errors that it causes
    /// is common to all pairs.
    pub center_covariance_rad2: Matrix2<f64>,
    /// One solution a pair.
    pub pairs: Vec<PairSolution>,
}

/// Everything that the solver needs besides the pairs.
#[derive(Debug, Clone, Copy)]
pub struct CenterProblem<'a> {
    /// The camera.
    pub camera: &'a Camera,
    /// First guess of the centre's direction.
    pub center_guess: Unit<Vector3<f64>>,
    /// The fixed-centre model's parameters.
    pub config: &'a FixedCenterConfig,
    /// Thresholds.
    pub rotation: &'a RotationConfig,
}
