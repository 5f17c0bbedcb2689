//! From settings to a tumbling scene.

use super::placement::center_in_camera_m;
use super::rigid_body::rows;
use super::{RigidBody, Spin, TumblingConfig};
use crate::dataset::CameraSensor;
use crate::dataset::truth::{AsteroidInertia, AsteroidState, Landmark};
use crate::scene::{Imager, SceneError, SensorConfig, SmallBody, View, sun_angular_radius_rad};
use nalgebra::{Isometry3, Translation3, Unit, Vector2, Vector3};
use std::path::Path;

/// A tumbling body and the pictures to take of it.
#[derive(Debug, Clone, PartialEq)]
pub struct TumblingScene {
    /// The body in asteroid axes.
    pub body: SmallBody,
    /// One view a picture, in asteroid axes.
    pub views: Vec<View>,
    /// True attitude and rate, one a picture. Inertial axes are the camera's.
    pub states: Vec<AsteroidState>,
    /// True inertia tensor in asteroid axes, the last element 1.
    pub inertia: AsteroidInertia,
    /// Centre of the body in the camera frame, m; it does not move.
    pub center_in_camera_m: Vector3<f64>,
    /// The camera, in the spacecraft's frame.
    pub sensor: CameraSensor,
    /// The detector.
    pub sensor_model: SensorConfig,
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
        imager: &Imager,
        seed: u64,
        base_folder: &Path,
    ) -> Result<TumblingScene, SceneError> {
        let (mesh, shape) = config.shape.centered_mesh(config.surface.albedo_map.as_ref(), base_folder, seed)?;
        let rigid_body = config.inertia.rigid_body(&shape)?;
        let offset_px = Vector2::from(config.center_offset_px);
        let center_in_camera_m = center_in_camera_m(&imager.camera, mesh.radius_m(), config.fill_fraction, &offset_px);
        if center_in_camera_m.z <= mesh.radius_m() {
            let cure = "the camera would be inside the body: make it smaller";
            return Err(SceneError::out_of_range("tumbling.fill_fraction", config.fill_fraction, cure));
        }
        let sun_in_camera = config.sun.sun_in_camera(&center_in_camera_m);
        let states = states(config, &rigid_body);
        let sun = (&sun_in_camera, sun_angular_radius_rad(config.sun.distance_au));
        let views = states.iter().map(|state| view(state, &center_in_camera_m, sun)).collect();
        let rate_hz = Some(1.0 / config.interval_s);
        Ok(TumblingScene {
            views,
            states,
            inertia: AsteroidInertia { inertia: rows(rigid_body.inertia()) },
            center_in_camera_m,
            sensor: CameraSensor { camera: imager.camera, spacecraft_from_camera: Isometry3::identity(), rate_hz },
            sensor_model: imager.detector,
            landmarks: mesh.spread_landmarks(config.landmarks, seed),
            body: SmallBody { surface: config.surface.on(&mesh, seed), mesh },
        })
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

/// A point p of the camera frame is A (p - c) in asteroid axes, with A the attitude and c the body's centre.
fn view(
    state: &AsteroidState,
    center_in_camera_m: &Vector3<f64>,
    (sun_in_camera, sun_angular_radius_rad): (&Unit<Vector3<f64>>, f64),
) -> View {
    let attitude = state.asteroid_from_inertial;
    let camera_in_asteroid_m = -(attitude * center_in_camera_m);
    View {
        t_ns: state.t_ns,
        reference_from_camera: Isometry3::from_parts(Translation3::from(camera_in_asteroid_m), attitude),
        sun_in_reference: attitude * sun_in_camera,
        sun_angular_radius_rad,
    }
}
