//! From settings to a descent scene.

use super::config::DescentConfig;
use super::ground::{check_above_model, ground};
use super::guidance::PolynomialGuidance;
use super::landmarks::landmarks_around_site;
use super::motion::DescentMotion;
use crate::dataset::truth::{LanderState, Landmark};
use crate::dataset::{CameraId, CameraSensor, DesignatedPoint, ImuNoise, ImuSample, InitialState};
use crate::scene::camera::{Imager, SceneCamera};
use crate::scene::error::SceneError;
use crate::scene::terrain::Terrain;
use crate::scene::view::View;
use crate::settings::OutOfRange;
use nalgebra::{Isometry3, Point3, Unit, Vector3};
use std::path::Path;

/// A descent: the ground, the images to take, and what the lander measures and believes.
#[derive(Debug, Clone, PartialEq)]
pub struct DescentScene {
    /// The ground in the site frame.
    pub terrain: Terrain,
    /// The cameras with their views in the site frame; all take their images at the same times.
    pub cameras: Vec<SceneCamera>,
    /// How the lander moves.
    pub motion: DescentMotion,
    /// Direction to the Sun in the site frame.
    pub sun_in_site: Unit<Vector3<f64>>,
    /// Angular radius of the Sun's disc, rad.
    pub sun_angular_radius_rad: f64,
    /// True states at t = 0 and at every inertial sample, up to touchdown.
    pub lander_states: Vec<LanderState>,
    /// Inertial samples up to touchdown, the first one interval after t = 0.
    pub imu: Vec<ImuSample>,
    /// The inertial measurement unit's data sheet.
    pub imu_noise: ImuNoise,
    /// What the lander believes at the first image.
    pub initial: InitialState,
    /// Measured pixel of the site's origin in the first camera's first image.
    pub designated: DesignatedPoint,
    /// Points on the ground, in the site frame; the first is the site's origin.
    pub landmarks: Vec<Landmark>,
}

impl DescentScene {
    /// What a camera sees at any time of the descent, between images too.
    pub fn view_at(&self, camera: &SceneCamera, t_ns: i64) -> View {
        view(&self.motion, &camera.sensor, &(self.sun_in_site, self.sun_angular_radius_rad), t_ns)
    }

    /// Scene of a configuration that [`DescentConfig::validate`] accepts; relative paths start at `base_folder`.
    ///
    /// # Errors
    /// Names the key at fault if no schedule fits, if a camera would be in the ground, or if the first one does not see
    /// the site in its first image.
    pub fn new(
        config: &DescentConfig,
        imagers: &[Imager],
        seed: u64,
        base_folder: &Path,
    ) -> Result<DescentScene, SceneError> {
        let path = PolynomialGuidance::new(&config.guidance);
        let motion = DescentMotion::new(path);
        let terrain = ground(config, seed, base_folder)?;
        let interval_ns = config.imu.interval_ns();
        let end_ns = (config.guidance.duration_s * 1e9).round() as i64;
        let times_ns =
            config.schedule.times_ns(&path, interval_ns).map_err(|e| e.under("schedule").under("descent"))?;
        let site_in_lander_m = motion.state(0).site_from_lander.inverse_transform_point(&Point3::origin()).coords;
        let lander_from_nominal = config.camera_mount.lander_from_camera(&site_in_lander_m);
        let sunlight = config.sun.sunlight_in_site(base_folder).map_err(|e| e.under("sun").under("descent"))?;
        let sun = (sunlight.direction, sunlight.angular_radius_rad());
        let camera = |(number, imager): (u32, &Imager)| {
            let sensor = CameraSensor {
                camera: imager.camera,
                spacecraft_from_camera: imager.spacecraft_from_camera(&lander_from_nominal),
                rate_hz: config.schedule.rate_hz(),
                bits: imager.detector.stored_bits(),
            };
            let views = times_ns.iter().map(|t_ns| view(&motion, &sensor, &sun, *t_ns)).collect();
            SceneCamera { id: CameraId::single(number), sensor, detector: imager.detector, views }
        };
        let cameras: Vec<SceneCamera> = (0..).zip(imagers).map(camera).collect();
        cameras.iter().try_for_each(|camera| check_above_ground("descent.terrain", &camera.views, &terrain))?;
        cameras.iter().try_for_each(|camera| check_above_model(&camera.views, &terrain))?;
        let designated = designated(config, &cameras[0], seed)?;
        let first_ns = times_ns[0];
        Ok(DescentScene {
            lander_states: (0..=end_ns / interval_ns).map(|index| motion.state(index * interval_ns)).collect(),
            imu: config.imu.samples(&motion, end_ns, seed),
            imu_noise: config.imu.noise(),
            initial: config.initial_error.initial_state(&motion.state(first_ns), seed),
            designated,
            landmarks: landmarks_around_site(&terrain, config.landmarks, path.position_in_site_m(0.0).norm()),
            terrain,
            cameras,
            motion,
            sun_in_site: sun.0,
            sun_angular_radius_rad: sun.1,
        })
    }
}

/// What a camera of the lander sees at one moment.
fn view(motion: &DescentMotion, sensor: &CameraSensor, sun: &(Unit<Vector3<f64>>, f64), t_ns: i64) -> View {
    View {
        t_ns,
        reference_from_camera: motion.state(t_ns).site_from_lander * sensor.spacecraft_from_camera,
        sun_in_reference: sun.0,
        sun_angular_radius_rad: sun.1,
    }
}

fn designated(config: &DescentConfig, first_camera: &SceneCamera, seed: u64) -> Result<DesignatedPoint, SceneError> {
    let (camera, first) = (&first_camera.sensor.camera, &first_camera.views[0]);
    let site_in_camera_m = first.reference_from_camera.inverse_transform_point(&Point3::origin()).coords;
    let pixel_px = camera.project(&site_in_camera_m).filter(|pixel| camera.contains(pixel, 0.0)).ok_or_else(|| {
        let off_axis_deg = site_in_camera_m.xy().norm().atan2(site_in_camera_m.z).to_degrees();
        let cure = format!(
            "the first picture does not show the landing site, {off_axis_deg:.1}° off the optical axis: widen \
             camera.fov_deg or turn the camera with this key"
        );
        SceneError::out_of_range("descent.camera_mount.cant_deg", config.camera_mount.cant_deg, cure)
    })?;
    Ok(config.initial_error.designated(first.t_ns, &pixel_px, seed))
}

/// Refuses views from the ground or below; `key` is the terrain's in the scenario file.
pub fn check_above_ground(key: &str, views: &[View], terrain: &Terrain) -> Result<(), OutOfRange> {
    let clearance_m = |pose: &Isometry3<f64>| {
        let p = pose.translation.vector;
        p.z - terrain.height_m(p.x, p.y)
    };
    match views.iter().map(|v| (v.t_ns, clearance_m(&v.reference_from_camera))).find(|(_, height_m)| *height_m < 0.1) {
        None => Ok(()),
        Some((t_ns, height_m)) => {
            let cure = format!(
                "the camera would be {height_m:.1} m above the ground at t = {:.2} s: make the terrain flatter or end \
                 the pictures higher",
                t_ns as f64 * 1e-9
            );
            Err(OutOfRange::new(key, "too high", cure))
        }
    }
}
