//! Where the files of several cameras and spacecraft lie, and that the truth in them agrees.

use super::{SMALL, render, scenario_file, succeed};
use nalgebra::Vector3;
use opnav::dataset::truth::{
    TruthRaster, camera_poses_file, read_flow, read_landmarks, read_node_states, read_observations,
};
use opnav::dataset::{
    CameraId, CameraSource, ImageSequence, find_cameras, read_camera_sensor, read_depth_tiff, read_imu,
    read_initial_state, read_manifest, read_mask_png, read_normals_tiff, read_tum, sha256_hex,
};
use std::path::Path;
use tempfile::TempDir;

pub const THREE_NODES: &str = "\
[camera]
width_px = 64
height_px = 64
[attachment]
picture_interval_s = 900.0
landmarks = 60
";

fn made(text: &str) -> (TempDir, std::path::PathBuf) {
    let folder = TempDir::new().expect("a temporary folder");
    let out = folder.path().join("out");
    succeed(&mut render(&scenario_file(folder.path(), text), &out));
    (folder, out)
}

/// Every landmark falls where the camera's files say, and is visible where the depth says.
fn landmarks_agree(root: &Path, camera: &CameraId) {
    let sensor = read_camera_sensor(&camera.folder(root).join("sensor.yaml")).expect("a camera");
    let landmarks = read_landmarks(root).expect("landmarks");
    let poses = read_tum(&camera_poses_file(root, camera)).expect("poses");
    let observations = read_observations(root, camera.node).expect("observations");
    let mut visible = 0;
    for o in observations.iter().filter(|o| o.camera == camera.number) {
        let pose = poses.iter().find(|p| p.t_ns == o.t_ns).expect("a pose").reference_from_moving;
        let landmark = landmarks.iter().find(|l| l.id == o.id).expect("a landmark");
        let point = pose.inverse_transform_point(&landmark.position_m.into()).coords;
        let pixel = sensor.camera.project(&point).expect("in front");
        assert!((pixel - o.pixel_px).norm() < 1e-6, "{pixel}");
        let depth = read_depth_tiff(&root.join(TruthRaster::Depth.file(camera, o.t_ns))).expect("a depth");
        let nearest = depth.get_pixel(pixel.x.round() as u32, pixel.y.round() as u32)[0];
        assert_eq!((f64::from(nearest) - point.z).abs() <= 0.01 * point.z, o.visible);
        visible += usize::from(o.visible);
    }
    assert!(visible > 10, "{camera}: {visible} landmarks visible");
}

#[test]
fn nodes_have_their_cameras_measurements_and_truth() {
    let (_folder, root) = made(THREE_NODES);
    let cameras = find_cameras(&root).expect("cameras");
    assert_eq!(cameras, [0, 1, 2].map(|node| CameraId { node: Some(node), number: 0 }));
    let manifest = read_manifest(&root).expect("a manifest");
    assert_eq!((manifest.frame_count, manifest.cameras.len()), (3, 3));
    assert_eq!(manifest.cameras[1], "node1/cam0");
    for name in ["node2/cam0/data/900000000000.png", "truth/node2/depth/cam0/0.tiff", "truth/node0/mask/cam0/0.png"] {
        assert!(manifest.sha256.contains_key(name), "{name} is missing");
    }
    for (name, sha256) in &manifest.sha256 {
        assert_eq!(*sha256, sha256_hex(&std::fs::read(root.join(name)).expect("a file")), "{name}");
    }
    assert!(!root.join("cam0").exists() && !root.join("unfinished.txt").exists());
    for camera in &cameras {
        let node = camera.spacecraft_folder(&root);
        let sequence = ImageSequence::open(&node, &CameraSource::Folder).expect("a sequence");
        assert_eq!(sequence.frames.len(), 3);
        let (noise, samples) = read_imu(&node).expect("measurements");
        assert_eq!((noise.rate_hz, samples.len()), (10.0, 18_000));
        assert_eq!(noise.bias.and_then(|bias| bias.bias_time_constant_s), Some(2000.0));
        let states = read_node_states(&root, camera.node).expect("states");
        let initial = read_initial_state(&node).expect("a first estimate");
        let error = initial.site_from_lander.translation.vector - states[0].site_from_lander.translation.vector;
        assert!(error.norm() > 0.1 && error.norm() < 25.0, "{error}");
        assert!((initial.sigma_position_m - 5.0).abs() < 0.01);
        // The camera looks down from its node.
        let pose = read_tum(&camera_poses_file(&root, camera)).expect("poses")[0].reference_from_moving;
        assert!((pose.translation.vector - states[0].site_from_lander.translation.vector).norm() < 1e-9);
        assert!((pose * Vector3::z()).z < -0.99);
        landmarks_agree(&root, camera);
    }
}

#[test]
fn two_cameras_have_their_own_images_and_flow_agrees_with_landmarks() {
    let (_folder, root) = made(SMALL);
    for number in [0, 1] {
        let camera = CameraId::single(number);
        let size = if number == 0 { (96, 96) } else { (64, 80) };
        let mask = read_mask_png(&root.join(TruthRaster::Mask.file(&camera, 0))).expect("a mask");
        assert_eq!(mask.dimensions(), size);
        assert!(root.join(camera.image(23_000_000_000)).is_file());
        landmarks_agree(&root, &camera);
        let [error, control] = flow_errors(&root, &camera);
        println!("cam{number}: flow against landmarks {error:.4} px median; against the wrong picture {control:.2} px");
        assert!(error < 0.05 && control > 0.5, "{error} {control}");
        assert!(
            !root.join(TruthRaster::Flow.file(&camera, 23_000_000_000)).exists(),
            "the last picture has no next one"
        );
    }
}

/// Median difference between the flow (bilinear) and the true motion of landmarks that both pictures show; and the same
/// against the picture after the next.
fn flow_errors(root: &Path, camera: &CameraId) -> [f64; 2] {
    let observations = read_observations(root, camera.node).expect("observations");
    let seen: Vec<_> = observations.iter().filter(|o| o.camera == camera.number && o.visible).collect();
    let mut errors = [Vec::new(), Vec::new()];
    for index in 0..20_i64 {
        let flow = read_flow(&root.join(TruthRaster::Flow.file(camera, index * 1_000_000_000))).expect("a flow");
        for o in seen.iter().filter(|o| o.t_ns == index * 1_000_000_000) {
            let (u, v) = (o.pixel_px.x.floor(), o.pixel_px.y.floor());
            let at = |du: f64, dv: f64| {
                let place = (v + dv) as usize * flow.width_px as usize + (u + du) as usize;
                flow.motion_px.get(place).map_or(nalgebra::Vector2::repeat(f64::NAN), |m| m.map(f64::from))
            };
            let (fu, fv) = (o.pixel_px.x - u, o.pixel_px.y - v);
            let upper = at(0.0, 0.0) * (1.0 - fu) + at(1.0, 0.0) * fu;
            let lower = at(0.0, 1.0) * (1.0 - fu) + at(1.0, 1.0) * fu;
            let motion = upper * (1.0 - fv) + lower * fv;
            for (later, errors) in (1..).zip(&mut errors) {
                let next = seen.iter().find(|n| n.id == o.id && n.t_ns == (index + later) * 1_000_000_000);
                let error = next.map_or(f64::NAN, |n| (motion - (n.pixel_px - o.pixel_px)).norm());
                errors.extend(Some(error).filter(|e| e.is_finite()));
            }
        }
    }
    errors.map(|mut errors| {
        assert!(errors.len() > 100, "{} landmarks", errors.len());
        errors.sort_by(f64::total_cmp);
        errors[errors.len() / 2]
    })
}

/// Normals are unit vectors that agree with the depth's own slope, on average; albedo is that of the surface.
#[test]
fn normals_and_albedo_come_on_request() {
    let text = "[truth]\nnormals = true\nalbedo = true\n[camera]\nwidth_px = 128\nheight_px = 128\n[tumbling]\nframes = 1\n\
                [tumbling.surface]\nalbedo = 0.3\n[tumbling.shape.procedural]\nsubdivisions = 5\n";
    let (_folder, root) = made(text);
    let camera = CameraId::single(0);
    let file = |kind: TruthRaster| root.join(kind.file(&camera, 0));
    let normals = read_normals_tiff(&file(TruthRaster::Normals)).expect("normals");
    let albedo = read_depth_tiff(&file(TruthRaster::Albedo)).expect("albedo");
    let depth = read_depth_tiff(&file(TruthRaster::Depth)).expect("depth");
    let lens = read_camera_sensor(&root.join("cam0/sensor.yaml")).expect("a camera").camera;
    let pose = read_tum(&camera_poses_file(&root, &camera)).expect("poses")[0].reference_from_moving;
    let point = |u: u32, v: u32| {
        let ideal = lens.normalize(&nalgebra::Vector2::new(f64::from(u), f64::from(v))).expect("a ray");
        pose * nalgebra::Point3::from(ideal.push(1.0) * f64::from(depth.get_pixel(u, v)[0]))
    };
    let (mut agreement, mut reversed, mut brightness, mut count) = (0.0, 0.0, 0.0, 0.0);
    for (u, v, pixel) in normals.enumerate_pixels() {
        let hit = depth.get_pixel(u, v)[0].is_finite();
        assert_eq!((pixel[0].is_finite(), albedo.get_pixel(u, v)[0].is_finite()), (hit, hit), "pixel {u}, {v}");
        if !hit || u < 1 || v < 1 || u > 126 || v > 126 {
            continue;
        }
        let normal = Vector3::new(pixel[0], pixel[1], pixel[2]).map(f64::from);
        assert!((normal.norm() - 1.0).abs() < 1e-3, "{normal}");
        brightness += f64::from(albedo.get_pixel(u, v)[0]);
        let slope = (point(u + 1, v) - point(u - 1, v)).cross(&(point(u, v - 1) - point(u, v + 1)));
        let inward = pose.translation.vector - point(u, v).coords;
        if slope.iter().all(|x| x.is_finite()) && slope.normalize().dot(&inward.normalize()).abs() > 0.4 {
            agreement += normal.dot(&slope.normalize());
            reversed += normal.dot(&inward.normalize());
            count += 1.0;
        }
    }
    assert!(count > 1000.0, "{count} pixels");
    assert!(agreement / count > 0.9, "{}", agreement / count);
    assert!(reversed / count > 0.4, "normals point inward: {}", reversed / count);
    assert!((0.2..0.4).contains(&(brightness / count)), "{}", brightness / count);
    assert!(!root.join("truth/flow").exists());
}
