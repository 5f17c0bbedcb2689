//! What happens in a scenario, and the scene that it describes.

use crate::dataset::truth::Landmark;
use crate::scene::attachment::{AttachmentConfig, AttachmentScene};
use crate::scene::camera::SceneCamera;
use crate::scene::descent::{DescentConfig, DescentScene};
use crate::scene::stars::Sky;
use crate::scene::tumbling::{TumblingConfig, TumblingScene};
use crate::scene::view::View;
use nalgebra::UnitQuaternion;

/// What happens in a scenario.
#[derive(Debug, Clone, PartialEq)]
pub enum Mission {
    /// A powered descent to a landing site: the table `[descent]`.
    Descent(DescentConfig),
    /// A tumbling small body: the table `[tumbling]`.
    Tumbling(TumblingConfig),
    /// Linked spacecraft over a site: the table `[attachment]`.
    Attachment(AttachmentConfig),
}

/// A scene that a scenario describes.
#[derive(Debug, Clone, PartialEq)]
pub enum Scene {
    /// A powered descent.
    Descent(Box<DescentScene>),
    /// A tumbling small body.
    Tumbling(Box<TumblingScene>),
    /// Linked spacecraft over a site.
    Attachment(Box<AttachmentScene>),
}

impl Scene {
    /// The cameras, at least one, and the images that they take.
    pub fn cameras(&self) -> &[SceneCamera] {
        match self {
            Scene::Descent(scene) => &scene.cameras,
            Scene::Tumbling(scene) => &scene.cameras,
            Scene::Attachment(scene) => &scene.cameras,
        }
    }

    /// Points on the surface, in the views' reference frame.
    pub fn landmarks(&self) -> &[Landmark] {
        match self {
            Scene::Descent(scene) => &scene.landmarks,
            Scene::Tumbling(scene) => &scene.landmarks,
            Scene::Attachment(scene) => &scene.landmarks,
        }
    }

    /// The sky behind the surface and how one of the scene's cameras is turned to it (camera from inertial axes); `None`
    /// where cameras look down at the ground.
    pub fn sky(&self, camera: &SceneCamera) -> Option<(&Sky, UnitQuaternion<f64>)> {
        match self {
            Scene::Descent(_) | Scene::Attachment(_) => None,
            Scene::Tumbling(scene) => Some((&scene.sky, camera.sensor.spacecraft_from_camera.rotation.inverse())),
        }
    }

    /// What one of the scene's cameras sees at any time, between its images too.
    pub fn view_at(&self, camera: &SceneCamera, t_ns: i64) -> View {
        match self {
            Scene::Descent(scene) => scene.view_at(camera, t_ns),
            Scene::Tumbling(scene) => scene.view_at(camera, t_ns),
            Scene::Attachment(scene) => scene.view_at(camera, t_ns),
        }
    }
}
