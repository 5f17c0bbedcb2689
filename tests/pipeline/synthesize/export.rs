//! EuRoC, TUM and COLMAP: every reader finds the same poses.

use super::layout::THREE_NODES;
use super::{render, scenario_file, succeed};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::truth::{camera_poses_file, read_lander_states, read_landmarks, read_node_states};
use opnav::dataset::{
    ColmapImage, ColmapModel, ColmapPoint, find_cameras, read_camera_sensor, read_colmap, read_tum, write_colmap,
};
use opnav::geometry::{Camera, Distortion};
use opnav::pipeline::{ExportFormat, ExportRequest, export};
use std::path::Path;
use tempfile::TempDir;

const DESCENT: &str = "\
[[cameras]]
width_px = 48
height_px = 48
[[cameras]]
width_px = 64
height_px = 48
fov_deg = 50.0
turn_deg = [3.0, -4.0, 5.0]
offset_m = [0.4, -0.2, 0.1]
[descent.schedule.constant-scale]
count = 4
";

/// Distance in m and rad of two poses.
fn apart(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    (a.translation.vector - b.translation.vector).norm().max(a.rotation.angle_to(&b.rotation))
}

fn exported(root: &Path, out: &Path, format: ExportFormat) {
    export(&ExportRequest { folder: root.into(), out: out.into(), format }).expect("the data set is exported");
}

#[test]
fn euroc_tum_and_colmap_readers_find_the_same_poses() {
    for text in [DESCENT, THREE_NODES] {
        let folder = TempDir::new().expect("a temporary folder");
        let root = folder.path().join("out");
        succeed(&mut render(&scenario_file(folder.path(), text), &root));
        let (tum, colmap) = (folder.path().join("tum"), folder.path().join("colmap"));
        exported(&root, &tum, ExportFormat::Tum);
        exported(&root, &colmap, ExportFormat::Colmap);
        let model = read_colmap(&colmap).expect("a COLMAP model");
        let (mut worst, mut count, mut inverted) = (0.0_f64, 0, f64::INFINITY);
        for (place, camera) in find_cameras(&root).expect("cameras").iter().enumerate() {
            let sensor = read_camera_sensor(&camera.folder(&root).join("sensor.yaml")).expect("a camera");
            assert_eq!(model.cameras[place], sensor.camera);
            let states = match camera.node {
                None => read_lander_states(&root).expect("states"),
                node => read_node_states(&root, node).expect("states"),
            };
            let ours = read_tum(&camera_poses_file(&root, camera)).expect("poses");
            let theirs = read_tum(&camera.folder(&tum).join("groundtruth.txt")).expect("poses");
            assert_eq!(ours, theirs);
            for pose in theirs {
                let state = states.iter().find(|s| s.t_ns == pose.t_ns).expect("a state at each picture");
                let euroc = state.site_from_lander * sensor.spacecraft_from_camera;
                let image = model.images.iter().find(|i| i.name == camera.image(pose.t_ns)).expect("an image");
                assert_eq!(image.camera, place);
                worst = worst.max(apart(&pose.reference_from_moving, &euroc));
                worst = worst.max(apart(&pose.reference_from_moving, &image.reference_from_camera));
                inverted = inverted.min(apart(&pose.reference_from_moving, &image.reference_from_camera.inverse()));
                count += 1;
            }
        }
        println!("{count} poses: {worst:.1e} apart at most; inverted poses {inverted:.1e} at least");
        assert!(count > 7 && worst < 1e-9, "{worst}");
        assert!(inverted > 0.1, "an inverted pose would pass");
        tracks_project(&model);
        assert_eq!(model.points.len(), read_landmarks(&root).expect("landmarks").len());
    }
}

/// Every listed pixel is where the model's own camera and pose put its point.
fn tracks_project(model: &ColmapModel) {
    let mut count = 0;
    for image in &model.images {
        for (pixel_px, id) in &image.observations {
            let point = model.points.iter().find(|p| p.id == *id).expect("a point").position_m;
            let in_camera = image.reference_from_camera.inverse_transform_point(&point.into()).coords;
            let projected = model.cameras[image.camera].project(&in_camera).expect("in front");
            assert!((projected - pixel_px).norm() < 1e-5, "{projected} and not {pixel_px}");
            count += 1;
        }
    }
    assert!(count > 50, "{count} observations");
}

#[test]
fn colmap_files_follow_its_conventions() {
    let folder = TempDir::new().expect("a temporary folder");
    let lens = |distortion| Camera { distortion, ..Camera::from_fov(640, 480, 1.0) };
    let lenses = [
        lens(Distortion::None),
        lens(Distortion::RadialTangential([-0.28, 0.07, 2e-4, 1.7e-5])),
        lens(Distortion::Equidistant([0.003, 7e-4, -0.002, 2e-4])),
    ];
    let pose = Isometry3::from_parts(
        Translation3::new(1.0, 2.0, 3.0),
        UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.4, 1.1)),
    );
    let image = |camera: usize| ColmapImage {
        camera,
        name: format!("cam{camera}/data/7.png"),
        reference_from_camera: pose,
        observations: vec![(Vector2::new(10.0, 20.25), 5)],
    };
    let model = ColmapModel {
        cameras: lenses.to_vec(),
        images: (0..3).map(image).collect(),
        points: vec![ColmapPoint { id: 5, position_m: Vector3::new(0.1, 0.2, 0.3) }],
    };
    write_colmap(folder.path(), &model).expect("written");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("a file");
    let cameras = read("cameras.txt");
    for words in ["1 PINHOLE 640 480 ", "2 OPENCV 640 480 ", "3 OPENCV_FISHEYE 640 480 ", " 320 240", " -0.28 0.07 "] {
        assert!(cameras.contains(words), "{words} is not in {cameras}");
    }
    // The middle of a picture of 640 columns is at 319.5 for us and at 320 for COLMAP.
    assert_eq!(lenses[0].center_px.x, 319.5);
    let images = read("images.txt");
    assert!(images.contains("10.5 20.75 5") && images.contains(" 2 cam1/data/7.png\n"), "{images}");
    let head: Vec<f64> = images
        .lines()
        .nth(2)
        .expect("an image")
        .split_whitespace()
        .skip(1)
        .take(7)
        .map(|n| n.parse().expect("a number"))
        .collect();
    // COLMAP: x_camera = R(q) x + t; the camera's centre is -Rᵀ t.
    let rotation = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(head[0], head[1], head[2], head[3]));
    let center = -(rotation.inverse() * Vector3::new(head[4], head[5], head[6]));
    assert!((center - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-12, "{center}");
    assert!(read("points3D.txt").contains("5 0.1 0.2 0.3 128 128 128 0 1 0 2 0 3 0"), "{}", read("points3D.txt"));
    let back = read_colmap(folder.path()).expect("read");
    assert_eq!((&back.cameras, &back.points), (&model.cameras, &model.points));
    assert!(apart(&back.images[1].reference_from_camera, &pose) < 1e-12);
    assert_eq!(back.images[2].observations, model.images[2].observations);
    std::fs::write(folder.path().join("cameras.txt"), "1 THIN_PRISM 6 4 1 1 3 2\n").expect("written");
    let error = read_colmap(folder.path()).expect_err("refused").to_string();
    assert!(error.contains("cameras.txt, line 1") && error.contains("THIN_PRISM"), "{error}");
}
