//! The ground of a flight: heights, and the features on it.

use super::options::CampaignOptions;
use super::simulated_sensors::TrueState;
use crate::navigation::landing::CameraMount;
use nalgebra::{Vector2, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Smooth relief of a flight: three waves of random direction and phase, 0 at the site.
#[derive(Debug, Clone, PartialEq)]
pub struct Relief {
    amplitude_m: f64,
    waves: [(Vector2<f64>, f64); 3],
}

impl Relief {
    /// Relief of a flight, up to `options.relief_m` high.
    pub fn new(options: &CampaignOptions, random: &mut ChaCha8Rng) -> Self {
        let mut wave = |length_m: f64| {
            let angle: f64 = random.random_range(0.0..std::f64::consts::TAU);
            let phase: f64 = random.random_range(0.0..std::f64::consts::TAU);
            (Vector2::new(angle.cos(), angle.sin()) * (std::f64::consts::TAU / length_m), phase)
        };
        Relief { amplitude_m: options.relief_m, waves: [wave(3100.0), wave(1900.0), wave(1100.0)] }
    }

    /// Height above the plane z = 0, m; it fades to 0 at the site.
    pub fn height_m(&self, at_m: &Vector2<f64>) -> f64 {
        let sum: f64 = self.waves.iter().map(|(k, phase)| (k.dot(at_m) + phase).sin()).sum();
        self.amplitude_m * sum / 3.0 * (at_m.norm() / 400.0).min(1.0)
    }
}

/// The surface point in a direction of the lander's axes; `None` if it does not look down.
pub fn surface_point_m(
    truth: &TrueState,
    direction_in_lander: &Vector3<f64>,
    (options, relief): (&CampaignOptions, &Relief),
    random: &mut ChaCha8Rng,
) -> Option<Vector3<f64>> {
    let u = truth.lander_from_site.inverse() * direction_in_lander.normalize();
    if u.z > -1f64.to_radians().sin() {
        return None;
    }
    let at = |height_m: f64| truth.position_m + u * ((height_m - truth.position_m.z) / u.z);
    let height_m = if options.relief_m > 0.0 {
        // The ray's height over the relief is 0 where the fixed point of the heights below it is.
        (0..30).fold(0.0, |height_m, _| relief.height_m(&at(height_m).xy()))
    } else {
        let unit: f64 = StandardNormal.sample(random);
        unit * options.filter.ground.sigma_at_m(&at(0.0))
    };
    let point_m = at(height_m);
    ((point_m - truth.position_m).z < -1.0).then_some(point_m)
}

/// Surface points at random places of a camera's image.
pub fn features_m(
    truth: &TrueState,
    mount: &CameraMount,
    (options, relief): (&CampaignOptions, &Relief),
    random: &mut ChaCha8Rng,
) -> Vec<Vector3<f64>> {
    const FEATURES: usize = 60;
    let camera = &mount.camera;
    (0..FEATURES)
        .filter_map(|_| {
            let pixel = Vector2::new(
                random.random_range(0.0..f64::from(camera.width_px) - 1.0),
                random.random_range(0.0..f64::from(camera.height_px) - 1.0),
            );
            let direction = mount.lander_from_camera.rotation * camera.unproject(&pixel)?.into_inner();
            surface_point_m(truth, &direction, (options, relief), random)
        })
        .collect()
}

/// Whether a camera sees a point; everything is seen without one.
pub fn is_seen(truth: &TrueState, mount: Option<&CameraMount>, point_m: &Vector3<f64>) -> bool {
    let Some(mount) = mount else { return true };
    let in_lander = truth.lander_from_site * (point_m - truth.position_m);
    let in_camera = mount.lander_from_camera.inverse_transform_point(&in_lander.into());
    mount.camera.project(&in_camera.coords).is_some_and(|pixel| mount.camera.contains(&pixel, 0.0))
}
