//! The front end over small sequences on disk.

use crate::vision::pair::bearings::{angle_deg, median};
use crate::vision::texture::*;
use image::GrayImage;
use nalgebra::{Isometry3, Matrix2, Translation3, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::*;
use opnav::geometry::{Camera, so3};
use opnav::observations::*;
use opnav::vision::*;
use std::collections::HashMap;
use std::path::Path;

pub const SIDE: u32 = 320;

pub fn camera() -> Camera {
    Camera::from_fov(SIDE, SIDE, 60f64.to_radians())
}

/// Camera pose in the site frame, looking down, at frame `k` of a descent.
fn pose(k: usize) -> Isometry3<f64> {
    let t = k as f64;
    let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let turn = so3::exp(&Vector3::new(0.02 * t, 0.015 * t, 0.03 * t));
    Isometry3::from_parts(Translation3::new(4.0 * t, 3.0 * t, 300.0 - 8.0 * t), down * turn)
}

pub fn frame(k: usize) -> GrayImage {
    picture(SIDE, SIDE, 1.0, k as u64, |p| ground(&camera(), &pose(k), p).xy())
}

pub fn t_ns(k: usize) -> i64 {
    (k as i64 + 1) * 1_000_000_000
}

pub fn write(folder: &Path, pictures: impl Iterator<Item = GrayImage>) -> ImageSequence {
    let sensor =
        CameraSensor { camera: camera(), spacecraft_from_camera: Isometry3::identity(), rate_hz: None, bits: None };
    write_camera_sensor(&folder.join("cam0/sensor.yaml"), &sensor).unwrap();
    for (k, picture) in pictures.enumerate() {
        write_grey_png(&folder.join(format!("cam0/data/{}.png", t_ns(k))), &picture).unwrap();
    }
    ImageSequence::open(folder, &CameraSource::Folder).unwrap()
}

pub fn true_rotation(from: usize, to: usize) -> UnitQuaternion<f64> {
    pose(to).rotation.inverse() * pose(from).rotation
}

fn index(t: i64) -> usize {
    (t / 1_000_000_000 - 1) as usize
}

pub fn config() -> FrontEndConfig {
    let detector = DetectorConfig { max_features: 400, ..DetectorConfig::default() };
    FrontEndConfig { detector, ..FrontEndConfig::default() }
}

pub fn gyro(from: i64, to: i64) -> Option<UnitQuaternion<f64>> {
    Some(so3::exp(&Vector3::new(0.001, 0.0005, -0.001)) * true_rotation(index(from), index(to)))
}

/// The ground point in a pixel at a time.
pub fn on_ground(t: i64, pixel_px: Vector2<f64>) -> Vector3<f64> {
    ground(&camera(), &pose(index(t)), pixel_px)
}

/// The pixel of a ground point at a time.
pub fn pixel_at(t: i64, place: Vector3<f64>) -> Vector2<f64> {
    camera().project(&(pose(index(t)).inverse() * nalgebra::Point3::from(place)).coords).unwrap()
}

/// Everything but the times.
fn without_times(mut result: FrontEnd) -> FrontEnd {
    result.stage_ms.clear();
    for f in &mut result.frames {
        (f.load_ms, f.detect_ms, f.describe_ms, f.match_ms, f.rotation_ms) = (0.0, 0.0, 0.0, 0.0, 0.0);
    }
    result
}

#[test]
fn a_descent_over_a_plane_gives_rotations_tracks_and_the_designated_point() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = write(folder.path(), (0..10).map(frame));
    let start = camera().project(&(pose(0).inverse() * nalgebra::Point3::new(20.0, 10.0, 0.0)).coords).unwrap();
    let designated = DesignatedPoint { t_ns: t_ns(0), pixel_px: start, covariance_px2: Matrix2::identity() * 0.01 };
    let inputs = TrackInputs { rotation_prior: Some(&gyro), designated: Some(designated), ..TrackInputs::default() };
    let result = track_sequence(&sequence, &config(), &inputs, &|_| ()).unwrap();

    assert!(result.rotations[..9].windows(2).all(|w| w[0].t_ns_to == w[1].t_ns_from));
    assert!(result.rotations.len() > 9 + 15, "keyframe pairs follow");
    for r in &result.rotations {
        assert_eq!(r.status, PairStatus::Ok);
        let error_deg = angle_deg(&true_rotation(index(r.t_ns_from), index(r.t_ns_to)), &r.camera_to_from_camera_from);
        let sigma_deg = r.covariance_rad2.trace().sqrt().to_degrees();
        assert!(error_deg < 0.15 && error_deg < 4.0 * sigma_deg, "{error_deg} degrees, sigma {sigma_deg}");
    }

    let mut first: HashMap<u64, Vector3<f64>> = HashMap::new();
    let (mut errors, mut last) = (Vec::new(), i64::MIN);
    for o in result.observations.iter().filter(|o| o.track_id != TrackObservation::DESIGNATED) {
        assert!(o.t_ns >= last);
        last = o.t_ns;
        let here = pose(index(o.t_ns));
        let place = *first.entry(o.track_id).or_insert_with(|| ground(&camera(), &here, o.pixel_px));
        errors.push(
            (camera().project(&(here.inverse() * nalgebra::Point3::from(place)).coords).unwrap() - o.pixel_px).norm(),
        );
    }
    assert!(first.len() > 200 && errors.len() > 4 * first.len() / 2, "{} tracks, {}", first.len(), errors.len());
    assert!(median(errors) < 0.35);

    assert_eq!(result.designated.len(), 10);
    for step in &result.designated {
        let truth = (pose(index(step.t_ns)).inverse() * nalgebra::Point3::new(20.0, 10.0, 0.0)).coords;
        let off = step.pixel_px - camera().project(&truth).unwrap();
        let sigma = (0.5 * step.covariance_px2.trace()).sqrt();
        assert!(off.norm() < 0.4 && off.norm() < 4.5 * sigma, "{} px at sigma {sigma}", off.norm());
    }
}

#[test]
fn the_designated_point_ends_where_it_leaves_the_image() {
    let folder = tempfile::tempdir().unwrap();
    let shifted = |k: usize| picture(SIDE, SIDE, 1.0, k as u64, move |p| p + Vector2::new(20.0 * k as f64, 0.0));
    let sequence = write(folder.path(), (0..6).map(shifted));
    let designated =
        DesignatedPoint { t_ns: t_ns(0), pixel_px: Vector2::new(60.0, 150.0), covariance_px2: Matrix2::identity() };
    let inputs = TrackInputs { designated: Some(designated), ..TrackInputs::default() };
    let result = track_sequence(&sequence, &config(), &inputs, &|_| ()).unwrap();
    assert_eq!(result.designated.len(), 3, "60, 40, 20 px, and then the edge");
    assert!((result.designated[2].pixel_px - Vector2::new(20.0, 150.0)).norm() < 0.3);
    assert_eq!(result.observations.iter().filter(|o| o.track_id == TrackObservation::DESIGNATED).count(), 3);
}

#[test]
fn black_images_and_a_camera_at_rest_are_outcomes() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = [frame(0), GrayImage::new(SIDE, SIDE), frame(2), frame(2), frame(3)];
    let sequence = write(folder.path(), pictures.into_iter());
    let result = track_sequence(&sequence, &config(), &TrackInputs::default(), &|_| ()).unwrap();
    let statuses: Vec<PairStatus> = result.rotations[..4].iter().map(|r| r.status).collect();
    assert_eq!(statuses[..3], [PairStatus::NoFeatures, PairStatus::NoFeatures, PairStatus::NoMotion]);
    assert!(result.rotations[..3].iter().all(|r| r.model == RotationModel::None));
    assert_eq!(result.frames[1].features, 0);
}

#[test]
fn the_result_is_the_same_at_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = write(folder.path(), (0..10).map(frame));
    let run = |threads: usize, (detector, descriptor): (DetectorKind, DescriptorKind)| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let inputs = TrackInputs { rotation_prior: Some(&gyro), ..TrackInputs::default() };
        let mut config = config();
        (config.detector.kind, config.matcher.descriptor) = (detector, descriptor);
        without_times(pool.install(|| track_sequence(&sequence, &config, &inputs, &|_| ()).unwrap()))
    };
    let ways = [
        (DetectorKind::Harris, DescriptorKind::Orb),
        (DetectorKind::Harris, DescriptorKind::Sift),
        (DetectorKind::ShiTomasi, DescriptorKind::Orb),
    ];
    let [usual, sift, shi_tomasi] = ways.map(|way| {
        let alone = run(1, way);
        assert_eq!(alone, run(3, way), "{way:?}");
        assert!(alone.rotations.iter().all(|r| r.status == PairStatus::Ok), "{way:?}");
        alone
    });
    assert!(usual != sift && usual != shi_tomasi);
}

/// A picture that rolls by a sixth of a turn from one to the next, which only turned descriptors follow.
#[test]
fn descriptors_are_turned_where_upright_ones_fail() {
    let folder = tempfile::tempdir().unwrap();
    let about_px = Vector2::new(159.5, 159.5);
    let rolled = |k: usize| {
        let h = similarity(1.0, 60.0 * k as f64, about_px);
        picture(SIDE, SIDE, 1.0, k as u64, move |p| apply(&h, p))
    };
    let sequence = write(folder.path(), (0..4).map(rolled));
    for descriptor in [DescriptorKind::Orb, DescriptorKind::Sift] {
        let mut config = FrontEndConfig { keyframe_spans: vec![], ..config() };
        (config.matcher.descriptor, config.rotation.max_angle_rad) = (descriptor, 1.2);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let track = || track_sequence(&sequence, &config, &TrackInputs::default(), &|_| ()).unwrap();
            for pair in &pool.install(track).rotations {
                let turn_deg = pair.camera_to_from_camera_from.angle().to_degrees();
                assert_eq!(pair.status, PairStatus::Ok, "{descriptor:?}");
                assert!((turn_deg - 60.0).abs() < 0.1 && pair.inliers > 100, "{descriptor:?}: {turn_deg} degrees");
            }
        }
    }
}

#[test]
fn frames_can_be_chosen_and_one_is_too_few() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = write(folder.path(), (0..5).map(frame));
    let read = std::sync::atomic::AtomicUsize::new(0);
    let progress = |_| {
        read.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    };
    let inputs = TrackInputs { frames: 1..9, every: 2, ..TrackInputs::default() };
    let result = track_sequence(&sequence, &config(), &inputs, &progress).unwrap();
    let times: Vec<i64> = result.frames.iter().map(|f| f.t_ns).collect();
    assert_eq!(times, [t_ns(1), t_ns(3)]);
    assert_eq!(read.into_inner(), 2);
    let inputs = TrackInputs { frames: 4..5, ..TrackInputs::default() };
    let error = track_sequence(&sequence, &config(), &inputs, &|_| ()).unwrap_err();
    assert!(error.to_string().contains("at least two pictures are needed"));
    let wrong = FrontEndConfig { keyframe_max_angle_rad: -1.0, ..config() };
    let error = track_sequence(&sequence, &wrong, &TrackInputs::default(), &|_| ()).unwrap_err();
    assert!(error.to_string().contains("keyframe_max_angle_rad is -1"));
}

/// A sphere of 100 m, 380 m ahead and off the axis, that turns; its texture is fixed to it.
fn turning_body(k: usize, turn_a_frame: &Vector3<f64>) -> GrayImage {
    let lens = Camera::from_fov(SIDE, SIDE, 40f64.to_radians());
    let (center, radius) = (Vector3::new(12.0, -8.0, 380.0), 100.0);
    let body_from_camera = so3::exp(&(turn_a_frame * k as f64)).inverse();
    GrayImage::from_fn(SIDE, SIDE, |u, v| {
        let ray = lens.unproject(&Vector2::new(f64::from(u), f64::from(v))).unwrap().into_inner();
        let along = ray.dot(&center);
        let inside = along * along - center.norm_squared() + radius * radius;
        if inside < 0.0 {
            return image::Luma([0]);
        }
        let point = ray * (along - inside.sqrt()) - center;
        let p = body_from_camera * point;
        let light = point.normalize().dot(&Vector3::new(-0.5, -0.3, -0.8).normalize()).max(0.0);
        let grey = texture(Vector2::new(p.x + 0.6 * p.z, p.y - 0.7 * p.z) * 1.3) * (0.3 + 0.7 * light);
        image::Luma([if light > 0.0 { (235.0 * grey).clamp(0.0, 255.0) as u8 } else { 0 }])
    })
}

#[test]
fn a_turning_body_is_solved_about_its_centre() {
    let folder = tempfile::tempdir().unwrap();
    let turn = Vector3::new(0.03, -0.05, 0.04);
    write(folder.path(), (0..7).map(|k| turning_body(k, &turn)));
    let source = CameraSource::HorizontalFov(40f64.to_radians());
    let sequence = ImageSequence::open(folder.path(), &source).unwrap();
    let config = FrontEndConfig { mode: FrontEndMode::FixedCenter, ..config() };
    let result = track_sequence(&sequence, &config, &TrackInputs::default(), &|_| ()).unwrap();
    assert!(result.rotations.len() > 6 + 6, "keyframe pairs follow");
    for r in &result.rotations {
        assert_eq!((r.status, r.model), (PairStatus::Ok, RotationModel::FixedCenter));
        let span = index(r.t_ns_to) - index(r.t_ns_from);
        let error_deg = angle_deg(&so3::exp(&(turn * span as f64)), &r.camera_to_from_camera_from);
        let sigma_deg = r.covariance_rad2.trace().sqrt().to_degrees();
        // 0.12 degrees a frame are 3 % of the rate; 400 features on 320 px say no more.
        assert!(
            error_deg < 0.12 * span as f64 && error_deg < 4.0 * sigma_deg,
            "{error_deg} over {span}, sigma {sigma_deg}"
        );
    }
    let center = result.center_in_camera.unwrap();
    let off = center.angle(&Vector3::new(12.0, -8.0, 380.0));
    assert!(off < 0.02, "the centre is {off} rad off");
}
