//! The reference descent seen by a 512² camera of 90°, as pixels: frames at a constant ratio of slant range, tracks of
//! limited length on ground with relief, an IMU at 100 Hz.

use super::descent::{GRAVITY_IN_SITE_M_S2, normal3, truth};
use nalgebra::{Isometry3, UnitQuaternion, Vector2, Vector3};
use opnav::campaign::{TrueState, uncertain_start};
use opnav::dataset::{ImuNoise, ImuSample};
use opnav::geometry::Camera;
use opnav::geometry::so3::{left_jacobian, log};
use opnav::navigation::landing::LandingInput;
use opnav::observations::TrackObservation;
use opnav::stats::random_stream;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// What a flight varies.
#[derive(Clone, Copy)]
pub struct Flight {
    pub frames: usize,
    pub sigma_px: f64,
    /// 1 for heights of ± min(25 m, 0.06 of the distance), 0 for a plane.
    pub relief: f64,
    /// Scale of the IMU's noise; 1 is the reference.
    pub imu_noise: f64,
    /// Scale of the initial errors; 1 is ±1000 m, ±10 m/s, ±2°.
    pub start: f64,
    pub tracks: usize,
    pub longest_track: u64,
    /// 1σ of the designated pixel in the first frame: what track 0 follows is off by as much.
    pub designated_sigma_px: f64,
    /// 1σ of the tracker's drift off the designated point a frame.
    pub designated_drift_px: f64,
}

pub const FLIGHT: Flight = Flight {
    frames: 60,
    sigma_px: 0.2,
    relief: 1.0,
    imu_noise: 1.0,
    start: 1.0,
    tracks: 80,
    longest_track: 12,
    designated_sigma_px: 0.0,
    designated_drift_px: 0.0,
};

const RATE_HZ: i64 = 100;
const STEP_NS: i64 = 1_000_000_000 / RATE_HZ;
const END_NS: i64 = 198_000_000_000;

pub fn truth_at_ns(t_ns: i64) -> TrueState {
    truth(t_ns as f64 * 1e-9)
}

/// Height of the ground, m; 0 at the site.
pub fn height_m(flight: &Flight, x_m: f64, y_m: f64) -> f64 {
    let waves = 0.5 * (x_m / 310.0 + 1.0).sin() * (y_m / 420.0).cos()
        + 0.3 * ((x_m + y_m) / 95.0).sin()
        + 0.2 * ((x_m - 2.0 * y_m) / 17.0).cos();
    flight.relief * waves * (0.06 * x_m.hypot(y_m)).min(25.0)
}

pub fn camera() -> (Camera, Isometry3<f64>) {
    let flipped = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let canted = flipped * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.05);
    (
        Camera::from_fov(512, 512, 90f64.to_radians()),
        Isometry3::from_parts(Vector3::new(0.4, -0.2, -1.1).into(), canted),
    )
}

/// Whole IMU steps at which the slant range falls by equal ratios from the start down to about 16 m.
pub fn frame_times_ns(frames: usize) -> Vec<i64> {
    let start_m = truth(0.0).position_m.norm();
    let time_of = |range_m: f64| {
        let (mut low, mut high) = (0.0, 198.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if truth(middle).position_m.norm() > range_m { low = middle } else { high = middle }
        }
        low
    };
    let ratio = (16.0 / start_m).powf(1.0 / (frames - 1) as f64);
    (0..frames).map(|k| (time_of(start_m * ratio.powi(k as i32)) * RATE_HZ as f64).round() as i64 * STEP_NS).collect()
}

fn imu(flight: &Flight, random: &mut ChaCha8Rng) -> (ImuNoise, Vec<ImuSample>) {
    let noise = ImuNoise {
        rate_hz: RATE_HZ as f64,
        gyroscope_noise_density: 2.78e-5f64.to_radians(),
        accelerometer_noise_density: 5e-4,
        bias: None,
    };
    let dt = STEP_NS as f64 * 1e-9;
    let scale = flight.imu_noise / dt.sqrt();
    let samples = (1..=END_NS / STEP_NS).map(|k| {
        let (from, to) = (truth_at_ns((k - 1) * STEP_NS), truth_at_ns(k * STEP_NS));
        let turn = log(&(from.lander_from_site * to.lander_from_site.inverse()));
        let gained = from.lander_from_site * (to.velocity_m_s - from.velocity_m_s - GRAVITY_IN_SITE_M_S2 * dt);
        let force = left_jacobian(&turn).try_inverse().expect("a small turn") * gained / dt;
        ImuSample {
            t_ns: k * STEP_NS,
            rate_in_lander_rad_s: turn / dt + normal3(random, noise.gyroscope_noise_density * scale),
            specific_force_in_lander_m_s2: force + normal3(random, noise.accelerometer_noise_density * scale),
        }
    });
    (noise, samples.collect())
}

struct Track {
    id: u64,
    point_m: Vector3<f64>,
    left: u64,
}

/// Everything that the lander sees on one flight.
pub fn fly(flight: &Flight, run: u64) -> LandingInput {
    let mut random = random_stream(512, "flight", run);
    let (imu_noise, imu) = imu(flight, &mut random);
    let (camera, lander_from_camera) = camera();
    let frame_times_ns = frame_times_ns(flight.frames);
    let mut observations = Vec::new();
    let mut tracks = vec![Track { id: 0, point_m: designated_point_m(flight, run), left: u64::MAX }];
    let mut next_id = 1;
    let mut drift = random_stream(512, "drift", run);
    for t_ns in &frame_times_ns {
        let site_from_camera = site_from_lander(&truth_at_ns(*t_ns)) * lander_from_camera;
        if *t_ns > 0 {
            tracks[0].point_m = slipped_m(
                flight,
                &site_from_camera,
                &tracks[0].point_m,
                &normal3(&mut drift, flight.designated_drift_px),
            );
        }
        let pixel = |point_m: &Vector3<f64>| {
            let pixel = camera.project(&site_from_camera.inverse_transform_point(&(*point_m).into()).coords);
            pixel.filter(|p| camera.contains(p, 0.0))
        };
        tracks.retain(|t| t.left > 0 && (t.id == 0 || pixel(&t.point_m).is_some()));
        while tracks.len() < flight.tracks {
            let at = Vector2::from_fn(|_, _| random.random_range(10.0..501.0));
            let bearing = camera.unproject(&at).expect("a pinhole");
            let Some(point_m) = on_ground(flight, &site_from_camera, &bearing) else { continue };
            tracks.push(Track { id: next_id, point_m, left: random.random_range(3..=flight.longest_track) });
            next_id += 1;
        }
        for track in &mut tracks {
            let Some(exact) = pixel(&track.point_m) else { continue };
            let pixel_px = exact + normal3(&mut random, flight.sigma_px).xy();
            let (track_id, sigma_px) = (track.id, flight.sigma_px.max(0.1));
            observations.push(TrackObservation { t_ns: *t_ns, track_id, pixel_px, sigma_px, response: 1.0 });
            track.left -= 1;
        }
    }
    let initial = scaled(flight, &mut random);
    LandingInput {
        imu,
        imu_noise,
        camera,
        lander_from_camera,
        observations,
        frame_times_ns,
        initial,
        known: Vec::new(),
        rotations: Vec::new(),
    }
}

/// The surface point under the designated pixel.
fn designated_point_m(flight: &Flight, run: u64) -> Vector3<f64> {
    let site_from_camera = site_from_lander(&truth(0.0)) * camera().1;
    let noise = normal3(&mut random_stream(512, "designated", run), flight.designated_sigma_px);
    slipped_m(flight, &site_from_camera, &Vector3::zeros(), &noise)
}

/// The surface point that lies `slip_px` (x, y) from another in the picture.
fn slipped_m(
    flight: &Flight,
    site_from_camera: &Isometry3<f64>,
    point_m: &Vector3<f64>,
    slip_px: &Vector3<f64>,
) -> Vector3<f64> {
    if slip_px.norm() == 0.0 {
        return *point_m;
    }
    let in_camera = site_from_camera.inverse_transform_point(&(*point_m).into());
    let exact = camera().0.project(&in_camera.coords).expect("the point is in the picture");
    let bearing = camera().0.unproject(&(exact + slip_px.xy())).expect("a pinhole");
    on_ground(flight, site_from_camera, &bearing).expect("it looks down")
}

fn scaled(flight: &Flight, random: &mut ChaCha8Rng) -> opnav::dataset::InitialState {
    let mut initial = uncertain_start(&truth(0.0), random);
    let exact = site_from_lander(&truth(0.0));
    if flight.start == 0.0 {
        initial.site_from_lander = exact;
        initial.lander_velocity_in_site_m_s = truth(0.0).velocity_m_s;
    }
    initial
}

pub fn site_from_lander(truth: &TrueState) -> Isometry3<f64> {
    Isometry3::from_parts(truth.position_m.into(), truth.lander_from_site.inverse())
}

/// Where a ray in camera axes meets the ground.
fn on_ground(flight: &Flight, site_from_camera: &Isometry3<f64>, bearing: &Vector3<f64>) -> Option<Vector3<f64>> {
    let origin_m = site_from_camera.translation.vector;
    let u = site_from_camera.rotation * bearing;
    if u.z > -0.2 {
        return None;
    }
    let mut point_m = origin_m - u * (origin_m.z / u.z);
    for _ in 0..50 {
        point_m = origin_m + u * ((height_m(flight, point_m.x, point_m.y) - origin_m.z) / u.z);
    }
    Some(Vector3::new(point_m.x, point_m.y, height_m(flight, point_m.x, point_m.y)))
}
