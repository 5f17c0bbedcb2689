//! From settings to an attachment scene.

use super::config::AttachmentConfig;
use super::gravity::TurningBody;
use super::guidance::ApolloGuidance;
use super::node_motion::NodeMotion;
use crate::dataset::truth::{LanderState, Landmark};
use crate::dataset::{CameraId, CameraSensor, ImuNoise, ImuSample, InitialState};
use crate::geometry::so3;
use crate::scene::camera::{Imager, SceneCamera};
use crate::scene::descent::{check_above_ground, landmarks_around_site};
use crate::scene::error::SceneError;
use crate::scene::terrain::Terrain;
use crate::scene::view::View;
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use std::path::Path;

/// Linked spacecraft over the site of a small body: what they photograph, measure and believe.
#[derive(Debug, Clone, PartialEq)]
pub struct AttachmentScene {
    /// The ground in the site frame.
    pub terrain: Terrain,
    /// The cameras with their views in the site frame, node by node; all take their images at the same times.
    pub cameras: Vec<SceneCamera>,
    /// The spacecraft.
    pub nodes: Vec<AttachmentNode>,
    /// The inertial measurement units' data sheet.
    pub imu_noise: ImuNoise,
    /// Points on the ground, in the site frame; the first is the site's origin.
    pub landmarks: Vec<Landmark>,
    /// The body below.
    pub body: TurningBody,
    /// Direction to the Sun at t = 0 in the site frame.
    pub sun_in_site_at_start: Unit<Vector3<f64>>,
    /// Angular radius of the Sun's disc, rad.
    pub sun_angular_radius_rad: f64,
}

/// One of the spacecraft.
#[derive(Debug, Clone, PartialEq)]
pub struct AttachmentNode {
    /// How it moves.
    pub motion: NodeMotion,
    /// True states at t = 0 and at every inertial sample.
    pub states: Vec<LanderState>,
    /// Inertial samples, the first one interval after t = 0.
    pub imu: Vec<ImuSample>,
    /// What it believes at t = 0.
    pub initial: InitialState,
}

impl AttachmentScene {
    /// Scene of a configuration that [`AttachmentConfig::validate`] accepts; relative paths start at `base_folder`.
    ///
    /// # Errors
    /// Names the kernel or the key at fault, among them a camera that would be in the ground.
    pub fn new(
        config: &AttachmentConfig,
        imagers: &[Imager],
        seed: u64,
        base_folder: &Path,
    ) -> Result<AttachmentScene, SceneError> {
        let sunlight = config.sun.sunlight_in_site(base_folder).map_err(|e| e.under("sun").under("attachment"))?;
        let (center, body) = (ApolloGuidance::new(&config.approach), TurningBody::new(&config.body));
        let terrain = Terrain::new(&config.terrain, seed);
        let farthest_m = 0.3 * center.position_in_site_m(0.0).norm();
        let node = |(number, place_m): (u32, &[f64; 3])| {
            let place_m = Vector3::from(*place_m);
            let motion = NodeMotion { center, place_m, vibration: config.flex.vibration(seed, number), body };
            node(config, motion, (seed, number))
        };
        let mut scene = AttachmentScene {
            landmarks: landmarks_around_site(&terrain, config.landmarks, farthest_m),
            terrain,
            cameras: Vec::new(),
            nodes: (0..).zip(&config.nodes_m).map(node).collect(),
            imu_noise: config.imu.noise(),
            body,
            sun_in_site_at_start: sunlight.direction,
            sun_angular_radius_rad: sunlight.angular_radius_rad(),
        };
        scene.cameras = scene.cameras(config, imagers);
        for camera in &scene.cameras {
            check_above_ground("attachment.terrain", &camera.views, &scene.terrain)?;
        }
        Ok(scene)
    }

    fn cameras(&self, config: &AttachmentConfig, imagers: &[Imager]) -> Vec<SceneCamera> {
        let times_ns = config.times_ns();
        let mut cameras = Vec::new();
        for (number, node) in (0..).zip(&self.nodes) {
            for (camera, imager) in (0..).zip(imagers) {
                let sensor = CameraSensor {
                    camera: imager.camera,
                    spacecraft_from_camera: imager.spacecraft_from_camera(&node_from_nominal_camera()),
                    rate_hz: Some(1.0 / config.picture_interval_s),
                    bits: imager.detector.stored_bits(),
                };
                let views = times_ns.iter().map(|t_ns| self.view(&node.motion, &sensor, *t_ns)).collect();
                let id = CameraId { node: Some(number), number: camera };
                cameras.push(SceneCamera { id, sensor, detector: imager.detector, views });
            }
        }
        cameras
    }

    /// What a camera sees at any time, between images too.
    pub fn view_at(&self, camera: &SceneCamera, t_ns: i64) -> View {
        let node = camera.id.node.unwrap_or(0) as usize;
        self.view(&self.nodes[node].motion, &camera.sensor, t_ns)
    }

    fn view(&self, motion: &NodeMotion, sensor: &CameraSensor, t_ns: i64) -> View {
        View {
            t_ns,
            reference_from_camera: motion.state(t_ns).site_from_lander * sensor.spacecraft_from_camera,
            sun_in_reference: self.sun_in_site(t_ns),
            sun_angular_radius_rad: self.sun_angular_radius_rad,
        }
    }

    /// Direction to the Sun in the site frame, which turns under it.
    pub fn sun_in_site(&self, t_ns: i64) -> Unit<Vector3<f64>> {
        so3::exp(&(self.body.rate_in_site_rad_s * (-t_ns as f64 * 1e-9))) * self.sun_in_site_at_start
    }
}

/// C = diag(1, -1, -1), half a turn about x: the camera looks along -z of the node.
fn node_from_nominal_camera() -> Isometry3<f64> {
    let half_turn = UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0));
    Isometry3::from_parts(Translation3::identity(), half_turn)
}

fn node(config: &AttachmentConfig, motion: NodeMotion, place: (u64, u32)) -> AttachmentNode {
    let end_ns = (config.approach.duration_s * 1e9).round() as i64;
    let (imu, states) = config.imu.samples(&motion, end_ns, place);
    let initial = config.initial_error.initial_state(&motion.state(0), place);
    AttachmentNode { motion, states, imu, initial }
}
