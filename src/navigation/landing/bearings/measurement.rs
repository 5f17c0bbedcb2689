//! Bearings of landmarks, from pixels.

use super::known_sighting::KnownSighting;
use crate::geometry::{Camera, so3};
use crate::observations::TrackObservation;
use nalgebra::{Isometry3, Matrix2, Unit, Vector3};

/// A surface point whose place a map tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownPoint {
    /// Its place in the site frame, m.
    pub position_in_site_m: Vector3<f64>,
    /// 1σ of each coordinate, m.
    pub sigma_m: f64,
}

/// Direction of a tracked surface point, seen from the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BearingObservation {
    /// The track; 0 is the known landmark.
    pub track_id: u64,
    /// Unit vector from the camera to the point, lander axes.
    pub direction_in_lander: Unit<Vector3<f64>>,
    /// Covariance (rad²) across the direction, in the basis [`so3::tangent_basis`] of it.
    pub covariance_rad2: Matrix2<f64>,
    /// The point's place, where it is known; the track is then of no meaning.
    pub known: Option<KnownPoint>,
}

impl BearingObservation {
    /// Bearing with the same 1σ (rad) in every direction across it.
    pub fn from_sigma(track_id: u64, direction_in_lander: Unit<Vector3<f64>>, sigma_rad: f64) -> Self {
        let covariance_rad2 = Matrix2::identity() * sigma_rad.powi(2);
        BearingObservation { track_id, direction_in_lander, covariance_rad2, known: None }
    }

    /// 1σ averaged over the directions across the bearing, rad.
    pub fn sigma_rad(&self) -> f64 {
        (0.5 * self.covariance_rad2.trace()).sqrt()
    }
}

/// A camera and where it sits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraMount {
    /// Intrinsic parameters.
    pub camera: Camera,
    /// Pose of the camera in the lander frame, m.
    pub lander_from_camera: Isometry3<f64>,
}

impl CameraMount {
    /// Position of the camera in lander axes, m.
    pub fn camera_in_lander_m(&self) -> Vector3<f64> {
        self.lander_from_camera.translation.vector
    }

    /// Bearing of a pixel, its noise carried through the camera model; `sigma_floor_px` is the least 1σ that is
    /// believed. `None` where the distortion cannot be inverted.
    pub fn bearing(&self, observation: &TrackObservation, sigma_floor_px: f64) -> Option<BearingObservation> {
        let in_camera = self.camera.unproject(&observation.pixel_px)?;
        let direction_in_lander = Unit::new_normalize(self.lander_from_camera.rotation * in_camera.into_inner());
        let angle_by_pixel = self.angle_by_pixel(&direction_in_lander)?;
        let sigma_px = observation.sigma_px.max(sigma_floor_px);
        let covariance_rad2 = angle_by_pixel * angle_by_pixel.transpose() * sigma_px.powi(2);
        Some(BearingObservation { track_id: observation.track_id, direction_in_lander, covariance_rad2, known: None })
    }

    /// Derivative (rad/px) of a direction, in the basis [`so3::tangent_basis`] of it, by its pixel: the further off the
    /// axis, the smaller. `None` where the camera does not see it.
    pub fn angle_by_pixel(&self, direction_in_lander: &Unit<Vector3<f64>>) -> Option<Matrix2<f64>> {
        let camera_from_lander = self.lander_from_camera.rotation.inverse().to_rotation_matrix().into_inner();
        let across_in_camera = camera_from_lander * so3::tangent_basis(direction_in_lander);
        let (_, pixel_by_point) =
            self.camera.project_with_jacobian(&(camera_from_lander * direction_in_lander.into_inner()))?;
        (pixel_by_point * across_in_camera).try_inverse()
    }
}

impl CameraMount {
    /// Bearing of a sighting of a known point, as [`CameraMount::bearing`].
    pub fn known_bearing(&self, sighting: &KnownSighting, sigma_floor_px: f64) -> Option<BearingObservation> {
        let KnownSighting { t_ns, pixel_px, sigma_px, .. } = *sighting;
        let observation = TrackObservation { t_ns, track_id: u64::MAX, pixel_px, sigma_px, response: 0.0 };
        let point = KnownPoint { position_in_site_m: sighting.point_in_site_m, sigma_m: sighting.sigma_point_m };
        Some(BearingObservation { known: Some(point), ..self.bearing(&observation, sigma_floor_px)? })
    }
}
