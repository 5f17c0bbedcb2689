//! What the front end knows throughout a sequence.

use crate::dataset::ImageSequence;
use crate::geometry::Camera;
use crate::vision::config::FrontEndConfig;
use crate::vision::front_end::RotationPrediction;
use crate::vision::masks::KeepOut;
use nalgebra::{Matrix2, Unit, UnitQuaternion, Vector3};
use std::time::Instant;

/// The fixed part of the work.
pub struct TrackingContext<'a> {
    pub sequence: &'a ImageSequence,
    pub config: &'a FrontEndConfig,
    pub prior: Option<RotationPrediction<'a>>,
    pub keep_out: Option<KeepOut<'a>>,
}

/// The centre of rotation with its covariance, in the fixed-centre mode.
pub type Center = Option<(Unit<Vector3<f64>>, Matrix2<f64>)>;

impl TrackingContext<'_> {
    pub fn camera(&self) -> &Camera {
        &self.sequence.sensor.camera
    }

    pub fn predicted(&self, t_ns_from: i64, t_ns_to: i64) -> Option<UnitQuaternion<f64>> {
        self.prior.and_then(|prior| prior(t_ns_from, t_ns_to))
    }
}

pub fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
