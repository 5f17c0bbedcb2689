//! From settings to a tumbling scene.

use super::config::TumblingConfig;
use super::placement::{first_distance_m, toward_pixel};
use super::rigid_body::{RigidBody, Spin, rows};

use crate::dataset::truth::{AsteroidInertia, AsteroidState, Landmark};
use crate::dataset::{CameraId, CameraSensor};
use crate::scene::body::{Mesh, SmallBody};
use crate::scene::camera::{Imager, SceneCamera};
use crate::scene::error::SceneError;
use crate::scene::stars::Sky;
use crate::scene::view::View;
use crate::settings::OutOfRange;
use nalgebra::{Isometry3, Translation3, Unit, Vector2, Vector3};
use std::path::Path;

/// A tumbling body and the images to take of it.
#[derive(Debug, Clone, PartialEq)]
pub struct TumblingScene {
    /// The body in asteroid axes.
    pub body: SmallBody,
    /// The cameras with their views in asteroid axes; all take their images at the same times.
    pub cameras: Vec<SceneCamera>,
    /// True attitude and rate, one an image. Inertial axes are the camera's.
    pub states: Vec<AsteroidState>,
    /// True inertia tensor in asteroid axes, the last element 1.
    pub inertia: AsteroidInertia,
    /// Centre of the body in the spacecraft's frame (the nominal camera's) at t = 0, m.
    pub center_in_spacecraft_m: Vector3<f64>,
    /// Velocity at which the spacecraft approaches the body's centre, in its own frame, m/s; zero if it hovers.
    pub approach_in_spacecraft_m_s: Vector3<f64>,
    /// Direction to the Sun in the spacecraft's frame; it does not move.
    pub sun_in_spacecraft: Unit<Vector3<f64>>,
    /// Angular radius of the Sun's disc, rad.
    pub sun_angular_radius_rad: f64,
    /// What is behind the body; inertial axes are the spacecraft's.
    pub sky: Sky,
    /// How the body moves.
    pub rigid_body: RigidBody,
    /// Points on the surface, in asteroid axes.
    pub landmarks: Vec<Landmark>,
}

impl TumblingScene {
    /// Scene of a configuration that [`TumblingConfig::validate`] accepts; `base_folder` is where relative paths start.
    ///
    /// # Errors
    /// Names the shape file or the key at fault.
    pub fn new(
        config: &TumblingConfig,
        imagers: &[Imager],
        seed: u64,
        base_folder: &Path,
    ) -> Result<TumblingScene, SceneError> {
        let (mesh, shape) = config.shape.centered_mesh(config.surface.albedo_map.as_ref(), base_folder, seed)?;
        let rigid_body = config.inertia.rigid_body(&shape)?;
        let first_camera = &imagers[0].camera;
        let toward_center = toward_pixel(first_camera, &Vector2::from(config.center_offset_px));
        let distance_m = first_distance_m(config, first_camera, &mesh, &toward_center);
        let center_in_spacecraft_m = toward_center.into_inner() * distance_m;
        let inertial_from_icrf = config.icrf_rotation();
        let sunlight = config.sun.sunlight_in_camera(&center_in_spacecraft_m, &inertial_from_icrf, base_folder);
        let sunlight = sunlight.map_err(|e| e.under("sun").under("tumbling"))?;
        let states = states(config, &rigid_body);
        check_approach(config, distance_m, &states)?;
        let mut scene = TumblingScene {
            cameras: Vec::new(),
            approach_in_spacecraft_m_s: toward_center.into_inner() * config.approach_m_s,
            inertia: AsteroidInertia { inertia: rows(rigid_body.inertia()) },
            sun_in_spacecraft: sunlight.direction,
            sun_angular_radius_rad: sunlight.angular_radius_rad(),
            sky: config.sky.sky(&inertial_from_icrf, sunlight.distance_au, base_folder)?,
            center_in_spacecraft_m,
            rigid_body,
            states,
            landmarks: mesh.spread_landmarks(config.landmarks, seed),
            body: SmallBody { surface: config.surface.on(&mesh, seed), mesh },
        };
        scene.cameras = (0..).zip(imagers).map(|entry| scene.camera(entry, 1.0 / config.interval_s)).collect();
        for camera in &scene.cameras {
            check_first_view(config, &scene.body.mesh, &camera.views[0])?;
        }
        Ok(scene)
    }

    fn camera(&self, (number, imager): (u32, &Imager), rate_hz: f64) -> SceneCamera {
        let spacecraft_from_camera = imager.spacecraft_from_camera(&Isometry3::identity());
        let bits = imager.detector.stored_bits();
        let sensor = CameraSensor { camera: imager.camera, spacecraft_from_camera, rate_hz: Some(rate_hz), bits };
        let views = self.states.iter().map(|state| self.view(&sensor, state)).collect();
        SceneCamera { id: CameraId::single(number), sensor, detector: imager.detector, views }
    }

    /// What a camera sees at any time, between images too.
    pub fn view_at(&self, camera: &SceneCamera, t_ns: i64) -> View {
        let before = self.states.partition_point(|state| state.t_ns <= t_ns).saturating_sub(1);
        let AsteroidState { t_ns: start_ns, asteroid_from_inertial, rate_in_asteroid_rad_s } = self.states[before];
        let start = Spin { asteroid_from_inertial, rate_in_asteroid_rad_s };
        let spin = self.rigid_body.propagate(&start, (t_ns - start_ns) as f64 * 1e-9);
        let state = AsteroidState {
            t_ns,
            asteroid_from_inertial: spin.asteroid_from_inertial,
            rate_in_asteroid_rad_s: spin.rate_in_asteroid_rad_s,
        };
        self.view(&camera.sensor, &state)
    }

    /// A point p of the spacecraft's frame is A (p - c) in asteroid axes, with A the attitude and c the body's centre.
    fn view(&self, sensor: &CameraSensor, state: &AsteroidState) -> View {
        let attitude = state.asteroid_from_inertial;
        let approached_m = self.approach_in_spacecraft_m_s * (state.t_ns as f64 * 1e-9);
        let spacecraft_in_asteroid_m = attitude * (approached_m - self.center_in_spacecraft_m);
        let asteroid_from_spacecraft = Isometry3::from_parts(Translation3::from(spacecraft_in_asteroid_m), attitude);
        View {
            t_ns: state.t_ns,
            reference_from_camera: asteroid_from_spacecraft * sensor.spacecraft_from_camera,
            sun_in_reference: attitude * self.sun_in_spacecraft,
            sun_angular_radius_rad: self.sun_angular_radius_rad,
        }
    }
}

fn states(config: &TumblingConfig, body: &RigidBody) -> Vec<AsteroidState> {
    let mut spin = Spin { asteroid_from_inertial: config.attitude(), rate_in_asteroid_rad_s: config.rate_rad_s() };
    let t_ns = |index: usize| (index as f64 * config.interval_s * 1e9).round() as i64;
    let mut states = Vec::with_capacity(config.frames);
    for index in 0..config.frames {
        if index > 0 {
            spin = body.propagate(&spin, (t_ns(index) - t_ns(index - 1)) as f64 * 1e-9);
        }
        states.push(AsteroidState {
            t_ns: t_ns(index),
            asteroid_from_inertial: spin.asteroid_from_inertial,
            rate_in_asteroid_rad_s: spin.rate_in_asteroid_rad_s,
        });
    }
    states
}

/// Checks that the camera is outside the body in the first image; drawing checks the others.
fn check_first_view(config: &TumblingConfig, mesh: &Mesh, view: &View) -> Result<(), OutOfRange> {
    let camera_m = view.reference_from_camera.translation.vector;
    if camera_m.norm() > mesh.radius_m() || mesh.surrounds(&camera_m) == 0 {
        return Ok(());
    }
    let (key, value) = config.distance_key();
    let cure = format!("the camera would be inside the body, whose radius is {:.3} m: move it out", mesh.radius_m());
    Err(OutOfRange::new(format!("tumbling.{key}"), value, cure))
}

/// Checks that the camera does not fly through the body.
fn check_approach(config: &TumblingConfig, distance_m: f64, states: &[AsteroidState]) -> Result<(), OutOfRange> {
    let last_s = states.last().map_or(0.0, |state| state.t_ns as f64 * 1e-9);
    if distance_m > config.approach_m_s * last_s {
        return Ok(());
    }
    let cure = "the camera would pass the body's centre: approach more slowly or from farther away";
    Err(OutOfRange::new("tumbling.approach_m_s", config.approach_m_s, cure))
}
