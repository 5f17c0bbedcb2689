//! A data set and a result side by side, and the descent and the pictures that several tests judge.

use image::{ImageBuffer, Luma};
use nalgebra::{Isometry3, SMatrix, SVector, Translation3, Vector2, Vector3};
use opnav::dataset::truth::{LanderState, write_lander_states};
use opnav::dataset::{CameraSensor, StampedPose, write_camera_sensor, write_depth_tiff, write_tum};
use opnav::evaluation::*;
use opnav::geometry::so3::exp;
use opnav::geometry::{Camera, Distortion};
use opnav::stats::random_stream;
use rand_distr::{Distribution, StandardNormal};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

pub const SECOND_NS: i64 = 1_000_000_000;

/// A data set and a result side by side.
pub struct Bench {
    pub dir: tempfile::TempDir,
}

impl Bench {
    pub fn new(mission: &str) -> Self {
        let bench = Bench { dir: tempfile::tempdir().expect("a temporary folder") };
        fs::create_dir_all(bench.root().join("truth")).expect("a folder");
        bench.put("summary.json", &format!("{{\"mission\": \"{mission}\", \"opnav_version\": \"0.1.0\"}}"));
        bench
    }
    pub fn root(&self) -> PathBuf {
        self.dir.path().join("data set")
    }
    pub fn result(&self) -> PathBuf {
        self.dir.path().join("result")
    }
    pub fn put(&self, name: &str, text: &str) -> PathBuf {
        fs::create_dir_all(self.result()).expect("a folder");
        fs::write(self.result().join(name), text).expect("a file");
        self.result().join(name)
    }
    pub fn evaluate(&self) -> Result<Metrics, EvaluationError> {
        evaluate(&self.result(), &self.root())
    }
    pub fn metrics(&self) -> Metrics {
        self.evaluate().unwrap_or_else(|error| panic!("{error}"))
    }
}

pub fn figure(metrics: &Metrics, name: &str) -> f64 {
    metrics.figure(name).unwrap_or_else(|| panic!("no {name} among {:?}, notes {:?}", metrics.figures, metrics.notes))
}

pub fn assert_near(metrics: &Metrics, name: &str, expected: f64, tolerance: f64) {
    let value = figure(metrics, name);
    assert!((value - expected).abs() <= tolerance, "{name} is {value}, {expected} expected");
}

/// A smooth descent that ends in the site's origin after 100 s.
pub fn descent(t_ns: i64) -> LanderState {
    let left = 100.0 - t_ns as f64 * 1e-9;
    let position = Vector3::new(0.10, -0.05, 0.30) * left.powi(2);
    LanderState {
        t_ns,
        site_from_lander: Isometry3::from_parts(
            Translation3::from(position),
            exp(&(Vector3::new(0.05, -0.1, 0.2) * (left / 100.0))),
        ),
        lander_velocity_in_site_m_s: Vector3::new(0.10, -0.05, 0.30) * (-2.0 * left),
        gyro_bias_rad_s: Vector3::zeros(),
        accelerometer_bias_m_s2: Vector3::zeros(),
    }
}

/// The lander's camera looks straight down.
fn lander_from_camera() -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::identity(), exp(&Vector3::new(std::f64::consts::PI, 0.0, 0.0)))
}

pub fn small_camera() -> Camera {
    Camera { distortion: Distortion::RadialTangential([-0.05, 0.01, 1e-4, -1e-4]), ..Camera::from_fov(64, 48, 1.2) }
}

/// A descent over flat ground, truth sampled ten times a second, a picture every 20 s.
pub fn landing_bench() -> Bench {
    let bench = Bench::new("landing");
    let states: Vec<LanderState> = (0..=1000).map(|k| descent(k * SECOND_NS / 10)).collect();
    write_lander_states(&bench.root(), &states).expect("write");
    let sensor = CameraSensor {
        camera: small_camera(),
        spacecraft_from_camera: lander_from_camera(),
        rate_hz: None,
        bits: None,
    };
    write_camera_sensor(&bench.root().join("cam0/sensor.yaml"), &sensor).expect("write");
    let poses: Vec<StampedPose> =
        image_times().map(|t_ns| StampedPose { t_ns, reference_from_moving: true_camera(t_ns) }).collect();
    write_tum(&bench.root().join("truth/cam0.tum"), &poses).expect("write");
    for t_ns in image_times() {
        write_flat_depth(&bench.root(), t_ns);
    }
    bench
}

pub fn image_times() -> impl Iterator<Item = i64> {
    (0..5).map(|k| k * 20 * SECOND_NS)
}

pub fn true_camera(t_ns: i64) -> Isometry3<f64> {
    descent(t_ns).site_from_lander * lander_from_camera()
}

/// The point of the plane z = 0 that a pixel sees, and its z-depth.
pub fn ground_under(t_ns: i64, pixel: &Vector2<f64>) -> (Vector3<f64>, f64) {
    let site_from_camera = true_camera(t_ns);
    let ideal = small_camera().normalize(pixel).expect("inside the picture");
    let ray = site_from_camera.rotation * Vector3::new(ideal.x, ideal.y, 1.0);
    let depth = -site_from_camera.translation.z / ray.z;
    (site_from_camera.translation.vector + ray * depth, depth)
}

fn write_flat_depth(root: &Path, t_ns: i64) {
    let depth = ImageBuffer::<Luma<f32>, Vec<f32>>::from_fn(64, 48, |u, v| {
        Luma([ground_under(t_ns, &Vector2::new(f64::from(u), f64::from(v))).1 as f32])
    });
    write_depth_tiff(&root.join(format!("truth/depth/cam0/{t_ns}.tiff")), 64, 48, depth.as_raw()).expect("write");
}

#[derive(Clone)]
pub struct LandingRow {
    pub t_ns: i64,
    pub pose: Isometry3<f64>,
    pub velocity: Vector3<f64>,
}

pub fn perfect_landing() -> Vec<LandingRow> {
    let row = |k: i64| {
        let truth = descent(k * SECOND_NS);
        LandingRow { t_ns: truth.t_ns, pose: truth.site_from_lander, velocity: truth.lander_velocity_in_site_m_s }
    };
    (0..=100).map(row).collect()
}

/// Columns in another order than the documents', which must not matter.
pub fn landing_csv(rows: &[LandingRow]) -> String {
    let mut text = String::from(
        "t_ns,qw,qx,qy,qz,x_m,y_m,z_m,sigma_x_m,sigma_y_m,sigma_z_m,sigma_yaw_rad,sigma_pitch_rad,sigma_roll_rad,\
         sigma_vx_m_s,sigma_vy_m_s,sigma_vz_m_s,vx_m_s,vy_m_s,vz_m_s\n",
    );
    for row in rows {
        let (p, q, v) = (row.pose.translation, row.pose.rotation, row.velocity);
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},1,2,3,0.03,0.02,0.01,4,5,6,{},{},{}",
            row.t_ns, q.w, q.i, q.j, q.k, p.x, p.y, p.z, v.x, v.y, v.z
        )
        .expect("text");
    }
    text
}

pub fn covariance_csv<const N: usize>(rows: impl Iterator<Item = (i64, SMatrix<f64, N, N>)>) -> String {
    let mut text = String::from("t_ns,upper triangle row by row\n");
    for (t_ns, covariance) in rows {
        write!(text, "{t_ns}").expect("text");
        for i in 0..N {
            for j in i..N {
                write!(text, ",{}", covariance[(i, j)]).expect("text");
            }
        }
        text.push('\n');
    }
    text
}

/// A root of a covariance with strong correlations and units of very different size.
pub fn covariance_root<const N: usize>(scale: impl Fn(usize) -> f64) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|i, j| {
        let mixing = ((3 * i + 5 * j + i * j) as f64).sin() * 0.6;
        scale(i)
            * if i == j {
                1.0
            } else if j < i {
                mixing
            } else {
                0.0
            }
    })
}

pub fn white<const N: usize>(index: u64) -> SVector<f64, N> {
    let mut random = random_stream(11, "white errors", index);
    SVector::from_fn(|_, _| StandardNormal.sample(&mut random))
}
