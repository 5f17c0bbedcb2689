//! What a descent brings, from the image front end and the sensors.

use super::bearings::{CameraMount, KnownSighting};
use super::error::LandingError;
use super::propagation::ImageRotation;
use crate::dataset::{ImuNoise, ImuSample, InitialState};
use crate::geometry::Camera;
use crate::observations::TrackObservation;
use nalgebra::Isometry3;

/// Everything that [`navigate`](super::navigate) may see.
#[derive(Debug, Clone, PartialEq)]
pub struct LandingInput {
    /// IMU samples in order of time, each the mean over the interval that ends at its time.
    pub imu: Vec<ImuSample>,
    /// The IMU's noise densities.
    pub imu_noise: ImuNoise,
    /// Intrinsic parameters of the camera.
    pub camera: Camera,
    /// Pose of the camera in the lander frame, m.
    pub lander_from_camera: Isometry3<f64>,
    /// Tracks in order of time; track 0 is the designated landing point, the origin of the site frame.
    pub observations: Vec<TrackObservation>,
    /// Times of all frames in ns, those without any observation too.
    pub frame_times_ns: Vec<i64>,
    /// What the lander believes of itself at or before the first frame.
    pub initial: InitialState,
    /// Sightings of points whose place a map tells, in order of time; none without a map.
    pub known: Vec<KnownSighting>,
    /// Rotations between images, by the time of the second, in order of time; none if the images tell none.
    pub rotations: Vec<ImageRotation>,
}

impl LandingInput {
    /// The camera and where it sits.
    pub fn mount(&self) -> CameraMount {
        CameraMount { camera: self.camera, lander_from_camera: self.lander_from_camera }
    }

    /// Checks the camera, that every list is in order of time and finite, and that every observation has its frame.
    ///
    /// # Errors
    /// [`LandingError`] names what is wrong and where.
    pub fn validate(&self) -> Result<(), LandingError> {
        self.camera.validate()?;
        let first_ns = *self
            .frame_times_ns
            .first()
            .ok_or(LandingError::Empty { what: "frames", cure: "give the times of the images" })?;
        if self.imu.is_empty() {
            return Err(LandingError::Empty { what: "IMU samples", cure: "a descent needs imu0/data.csv" });
        }
        if self.initial.t_ns > first_ns {
            return Err(LandingError::LateStart { initial_ns: self.initial.t_ns, frame_ns: first_ns });
        }
        increasing("frame times", self.frame_times_ns.iter().copied())?;
        increasing("IMU samples", self.imu.iter().map(|s| s.t_ns))?;
        self.check_values()?;
        self.check_observations()
    }

    fn check_values(&self) -> Result<(), LandingError> {
        let i = &self.initial;
        let sigmas = [i.sigma_position_m, i.sigma_velocity_m_s, i.sigma_attitude_rad];
        let densities = [self.imu_noise.gyroscope_noise_density, self.imu_noise.accelerometer_noise_density];
        let start = i.site_from_lander.translation.vector + i.lander_velocity_in_site_m_s;
        let positive = |values: &[f64]| values.iter().all(|v| *v > 0.0 && v.is_finite());
        if !positive(&sigmas) || !start.iter().all(|v| v.is_finite()) {
            let cure = "every value must be finite and every sigma positive";
            return Err(LandingError::Value { what: "the initial state", t_ns: i.t_ns, cure });
        }
        if !positive(&densities) || !positive(&[self.imu_noise.rate_hz]) {
            let cure = "rate and noise densities must be positive";
            return Err(LandingError::Value { what: "the IMU's noise", t_ns: i.t_ns, cure });
        }
        let is_finite = |s: &ImuSample| (s.rate_in_lander_rad_s + s.specific_force_in_lander_m_s2).norm().is_finite();
        match self.imu.iter().find(|s| !is_finite(s)) {
            Some(s) => Err(LandingError::Value { what: "an IMU sample", t_ns: s.t_ns, cure: "remove the sample" }),
            None => Ok(()),
        }
    }

    fn check_observations(&self) -> Result<(), LandingError> {
        increasing_or_equal("observations", self.observations.iter().map(|o| o.t_ns))?;
        increasing_or_equal("sightings of known points", self.known.iter().map(|k| k.t_ns))?;
        increasing("rotations between images", self.rotations.iter().map(|r| r.to_t_ns))?;
        let is_fine = |k: &&KnownSighting| {
            let numbers = k.pixel_px.norm() + k.point_in_site_m.norm() + k.sigma_px + k.sigma_point_m;
            numbers.is_finite() && k.sigma_px > 0.0 && k.sigma_point_m >= 0.0
        };
        if let Some(k) = self.known.iter().find(|k| !is_fine(k)) {
            let cure = "places must be finite and sigmas positive";
            return Err(LandingError::Value { what: "a sighting of a known point", t_ns: k.t_ns, cure });
        }
        for o in &self.observations {
            if self.frame_times_ns.binary_search(&o.t_ns).is_err() {
                return Err(LandingError::NoFrame { track_id: o.track_id, t_ns: o.t_ns });
            }
            if !(o.pixel_px.norm().is_finite() && o.sigma_px > 0.0 && o.sigma_px.is_finite()) {
                let cure = "pixels must be finite and sigma_px positive";
                return Err(LandingError::Value { what: "an observation", t_ns: o.t_ns, cure });
            }
        }
        Ok(())
    }
}

fn increasing(what: &'static str, times_ns: impl Iterator<Item = i64>) -> Result<(), LandingError> {
    let mut last_ns = i64::MIN;
    for t_ns in times_ns {
        if t_ns <= last_ns {
            return Err(LandingError::Order { what, t_ns });
        }
        last_ns = t_ns;
    }
    Ok(())
}

fn increasing_or_equal(what: &'static str, times_ns: impl Iterator<Item = i64>) -> Result<(), LandingError> {
    let mut last_ns = i64::MIN;
    for t_ns in times_ns {
        if t_ns < last_ns {
            return Err(LandingError::Order { what, t_ns });
        }
        last_ns = t_ns;
    }
    Ok(())
}
