//! Pairs of rendered pictures with the true place of each pixel of the first in the second.

use image::GrayImage;
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, so3};
use opnav::render::{Detector, RenderedFrame, Renderer};
use opnav::scene::{SensorConfig, Terrain, View};
use opnav::stats::random_stream;
use rand_distr::{Distribution, StandardNormal};

/// Depths that differ by less are those of one surface.
const SAME_DEPTH: f64 = 0.005;

/// Two pictures of one scene.
pub struct RenderedPair {
    pub camera: Camera,
    views: [View; 2],
    frames: [RenderedFrame; 2],
    level_m: f64,
}

impl RenderedPair {
    pub fn new(renderer: &mut Renderer, camera: &Camera, views: [View; 2]) -> Self {
        let frames = [0, 1].map(|i| renderer.render(&views[i]).expect("a picture"));
        let mut depths_m: Vec<f32> = frames[0].depth_m.iter().copied().filter(|d| d.is_finite()).collect();
        let middle = depths_m.len() / 2;
        let depth_m = f64::from(*depths_m.select_nth_unstable_by(middle, f32::total_cmp).1);
        let level_m = views[0].reference_from_camera.translation.z - depth_m;
        RenderedPair { camera: *camera, views, frames, level_m }
    }

    /// Both pictures through the default optics and exposure, with normal noise of that many grey levels.
    pub fn pictures(&self, noise_dn: f64, seed: u64) -> [GrayImage; 2] {
        let config = SensorConfig { noise: false, bits: 16, ..SensorConfig::default() };
        [0, 1].map(|i| {
            let (frame, t_ns) = (&self.frames[i], self.views[i].t_ns);
            let exposed = Detector::new(&self.camera, &config, 1, 0).expose(frame, t_ns);
            let mut random = random_stream(seed, "grey-levels", i as u64);
            let noisy = |number: &u16| {
                let noise: f64 = StandardNormal.sample(&mut random);
                (f64::from(*number) / 257.0 + noise_dn * noise).round().clamp(0.0, 255.0) as u8
            };
            let grey = exposed.numbers.iter().map(noisy).collect();
            GrayImage::from_raw(frame.width_px, frame.height_px, grey).expect("a number a pixel")
        })
    }

    /// Where a pixel of the first picture would lie in the second if the ground were level, at the height of the median depth.
    pub fn carried_over_level_ground(&self, pixel_px: &Vector2<f64>) -> Option<Vector2<f64>> {
        let [from, to] = self.views.each_ref().map(|v| v.reference_from_camera);
        let ray = from.rotation * self.camera.unproject(pixel_px)?.into_inner();
        let on_ground = from.translation.vector + ray * ((self.level_m - from.translation.z) / ray.z);
        self.camera.project(&(to.inverse() * Point3::from(on_ground)).coords)
    }

    /// Where the surface point in a pixel of the first picture lies in the second; `None` where it is hidden or outside.
    pub fn carried(&self, pixel_px: &Vector2<f64>) -> Option<Vector2<f64>> {
        let depth_m = depth(&self.frames[0], pixel_px)?;
        let bearing = self.camera.unproject(pixel_px)?.into_inner();
        let point = self.views[0].reference_from_camera * Point3::from(bearing * (depth_m / bearing.z));
        let seen = self.views[1].reference_from_camera.inverse() * point;
        let there = self.camera.project(&seen.coords)?;
        let visible = (depth(&self.frames[1], &there)? / seen.z - 1.0).abs() < SAME_DEPTH;
        visible.then_some(there)
    }
}

/// Bilinear depth in m of one surface; `None` at edges and outside.
fn depth(frame: &RenderedFrame, pixel_px: &Vector2<f64>) -> Option<f64> {
    let (u, v) = (pixel_px.x.floor(), pixel_px.y.floor());
    if u < 0.0 || v < 0.0 || u + 1.0 >= f64::from(frame.width_px) || v + 1.0 >= f64::from(frame.height_px) {
        return None;
    }
    let at = |i: u32, j: u32| f64::from(frame.depth_m[frame.index(u as u32 + i, v as u32 + j)]);
    let corners = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
    let (low, high) = corners.iter().fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), d| (l.min(*d), h.max(*d)));
    let (s, t) = (pixel_px.x - u, pixel_px.y - v);
    let depth_m = (corners[0] * (1.0 - s) + corners[1] * s) * (1.0 - t) + (corners[2] * (1.0 - s) + corners[3] * s) * t;
    (depth_m.is_finite() && high < low * (1.0 + SAME_DEPTH)).then_some(depth_m)
}

/// Straight down from above a place of the ground, then nearer by a share of the height and rolled about the axis of matched.
pub fn descent(terrain: &Terrain, [x_m, y_m]: [f64; 2], height_m: f64, (share, roll_rad): (f64, f64)) -> [View; 2] {
    let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let ground = Vector3::new(x_m, y_m, terrain.height_m(x_m, y_m));
    let view = |t_ns, above_m: f64, roll_rad: f64| View {
        t_ns,
        reference_from_camera: Isometry3::from_parts(
            (ground + Vector3::z() * above_m).into(),
            down * so3::exp(&(Vector3::z() * roll_rad)),
        ),
        sun_in_reference: nalgebra::Unit::new_normalize(Vector3::new(1.0, 0.5, 0.8)),
        sun_angular_radius_rad: 0.0,
    };
    [view(1, height_m, 0.3), view(2, height_m * (1.0 - share), 0.3 + roll_rad)]
}
