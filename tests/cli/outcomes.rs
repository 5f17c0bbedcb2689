//! Whole sequences on disk through the command line: degenerate motion by status, and the same bytes at any number of threads.

use super::opnav;
use crate::vision::texture::{apply, picture, texture};
use image::{GrayImage, Luma};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, so3};
use opnav::observations::read_relative_rotations;
use opnav::observations::{PairStatus, RelativeRotation};
use opnav::stats::random_stream;
use rand_distr::{Distribution, StandardNormal};
use std::collections::BTreeMap;
use std::path::Path;
use tempfile::TempDir;

const SIDE: u32 = 256;
const MIDDLE: f64 = 0.5 * SIDE as f64 - 0.5;

fn folder(pictures: impl Iterator<Item = GrayImage>) -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    pictures.enumerate().for_each(|(k, p)| p.save(folder.path().join(format!("a{k}.png"))).expect("written"));
    folder
}

fn camera() -> Camera {
    Camera::from_fov(SIDE, SIDE, 60f64.to_radians())
}

/// Rotations of the adjacent pairs of pictures taken by [`camera`].
fn tracked(pictures: impl Iterator<Item = GrayImage>) -> Vec<RelativeRotation> {
    let folder = folder(pictures);
    let out = folder.path().join("result");
    opnav().arg("track").arg(folder.path()).args(["--fov-deg", "60", "--out"]).arg(&out).assert().success();
    let mut rotations = read_relative_rotations(&out.join("relative_rotations.csv")).expect("rotations");
    rotations.retain(|r| r.t_ns_to - r.t_ns_from == 1_000_000_000);
    rotations
}

/// Far ground under a camera that turns by this much a frame.
fn turned(k: usize, turn: &Vector3<f64>) -> impl Fn(Vector2<f64>) -> Vector2<f64> {
    let camera = camera();
    let matrix = nalgebra::Matrix3::new(
        camera.focal_px.x,
        0.0,
        camera.center_px.x,
        0.0,
        camera.focal_px.y,
        camera.center_px.y,
        0.0,
        0.0,
        1.0,
    );
    let rotation = so3::exp(&(turn * k as f64)).to_rotation_matrix().into_inner();
    let h = matrix * rotation.transpose() * matrix.try_inverse().expect("a camera matrix");
    move |p| apply(&h, p)
}

const TURN: Vector3<f64> = Vector3::new(0.01, -0.02, 0.03);

fn error_deg(rotation: &UnitQuaternion<f64>) -> f64 {
    rotation.angle_to(&so3::exp(&TURN)).to_degrees()
}

#[test]
fn a_turning_camera_is_solved_and_a_camera_at_rest_is_said_to_be() {
    let moving = tracked((0..4).map(|k| picture(SIDE, SIDE, 1.0, k as u64, turned(k, &TURN))));
    for r in &moving {
        assert_eq!(r.status, PairStatus::Ok);
        assert!(error_deg(&r.camera_to_from_camera_from) < 0.1, "{}", error_deg(&r.camera_to_from_camera_from));
    }
    let still = tracked((0..7).map(|k| picture(SIDE, SIDE, 2.0, k as u64, |p| p)));
    // Noise alone may look like a tiny motion over a plane; its rotation is then none, within its own 1σ.
    for r in still.iter().filter(|r| r.status != PairStatus::NoMotion) {
        let sigma_rad = r.covariance_rad2.trace().sqrt();
        assert!(r.status == PairStatus::Ok && r.camera_to_from_camera_from.angle() < 3.0 * sigma_rad, "{r:?}");
    }
    let said = still.iter().filter(|r| r.status == PairStatus::NoMotion).count();
    assert!(still.len() == 6 && said >= 4, "{said} of {}", still.len());
    assert!(moving.iter().all(|r| r.camera_to_from_camera_from.angle() > 100.0 * r.covariance_rad2.trace().sqrt()));
}

#[test]
fn dust_gives_no_rotation() {
    // Slow shades that drift, and the sensor's noise: corners are found, but of nothing.
    let dust = |k: usize| {
        let mut random = random_stream(k as u64, "dust", 0);
        GrayImage::from_fn(SIDE, SIDE, |u, v| {
            let z: f64 = StandardNormal.sample(&mut random);
            let shade = 120.0 + 50.0 * (f64::from(u + v) / 150.0 + 0.4 * k as f64).sin();
            Luma([(shade + 3.0 * z).clamp(0.0, 255.0) as u8])
        })
    };
    let rotations = tracked((0..5).map(dust));
    let given = [PairStatus::NoFeatures, PairStatus::FewMatches, PairStatus::Rejected, PairStatus::Degenerate];
    assert!(rotations.len() == 4 && rotations.iter().all(|r| given.contains(&r.status)), "{rotations:?}");
}

/// A heat shield that falls away before turning ground: a dark disc with a texture of its own, which shrinks and drifts.
fn before_ground(k: usize, radius_px: f64) -> GrayImage {
    let mut canvas = picture(SIDE, SIDE, 1.0, k as u64, turned(k, &TURN));
    let middle = Vector2::new(MIDDLE - 10.0 + 12.0 * k as f64, MIDDLE + 5.0 - 6.0 * k as f64);
    for (u, v, pixel) in canvas.enumerate_pixels_mut() {
        let on_disc = (Vector2::new(f64::from(u), f64::from(v)) - middle) / radius_px;
        if on_disc.norm() < 1.0 {
            *pixel = Luma([(110.0 * texture(on_disc * 130.0 + Vector2::new(900.0, 300.0))).clamp(0.0, 255.0) as u8]);
        }
    }
    canvas
}

#[test]
fn a_heat_shield_in_view_gives_the_grounds_rotation_or_none() {
    let radii = [115.0, 95.0, 75.0, 55.0, 40.0, 28.0];
    let rotations = tracked(radii.iter().enumerate().map(|(k, radius)| before_ground(k, *radius)));
    for (k, r) in rotations.iter().enumerate() {
        let error = error_deg(&r.camera_to_from_camera_from);
        println!("shield of {} px: {:?}, {} of {}, {error:.3} degrees off", radii[k], r.status, r.inliers, r.matches);
    }
    for r in rotations.iter().filter(|r| r.status == PairStatus::Ok) {
        assert!(error_deg(&r.camera_to_from_camera_from) < 0.2, "{r:?}");
    }
    assert!(rotations[3..].iter().all(|r| r.status == PairStatus::Ok), "the ground shows enough again");
}

/// All files under a folder, `summary.json` without its times.
pub(super) fn files(folder: &Path, under: &Path, into: &mut BTreeMap<String, Vec<u8>>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, under, into);
            continue;
        }
        let mut bytes = std::fs::read(&path).expect("a file");
        if path.ends_with("summary.json") {
            let mut summary: serde_json::Value = serde_json::from_slice(&bytes).expect("JSON");
            assert!(summary["timing_ms"].take().is_object());
            bytes = summary.to_string().into_bytes();
        }
        into.insert(path.strip_prefix(under).expect("under it").display().to_string(), bytes);
    }
}

#[test]
fn the_bytes_are_the_same_at_any_number_of_threads() {
    let mut pictures: Vec<GrayImage> = (0..11).map(|k| picture(SIDE, SIDE, 1.0, k as u64, turned(k, &TURN))).collect();
    pictures[5] = GrayImage::new(SIDE, SIDE);
    pictures[8] = GrayImage::new(3, 3);
    let folder = folder(pictures.into_iter());
    let run = |threads: &str, more: &[&str]| {
        let result = TempDir::new().expect("a temporary folder");
        let mut command = opnav();
        command.arg("track").arg(folder.path()).args(["--fov-deg", "60", "--out"]).arg(result.path()).args(more);
        command.env("RAYON_NUM_THREADS", threads).assert().success();
        let mut all = BTreeMap::new();
        files(result.path(), result.path(), &mut all);
        all
    };
    let one = run("1", &[]);
    let names: Vec<&str> = one.keys().map(String::as_str).collect();
    for name in ["tracks.csv", "relative_rotations.csv", "attitude_chain.tum", "summary.json", "contact_sheet.png"] {
        assert!(names.contains(&name), "{name} is not among {names:?}");
    }
    assert!(names.iter().filter(|name| name.starts_with("overlays/")).count() >= 5, "{names:?}");
    assert!(one == run("2", &[]) && one == run("5", &[]), "another number of threads gives other bytes");
    assert!(one != run("1", &["--every", "2"]), "other pictures give other bytes");
}
