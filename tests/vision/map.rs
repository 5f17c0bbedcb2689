//! Rendered pictures against rendered maps: where points of the map are found, and what happens where they are not.

use image::GrayImage;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::{GroundMap, MapLevel};
use opnav::geometry::{Camera, so3};
use opnav::observations::PredictedCamera;
use opnav::render::{Detector, Gpu, Renderer, World, map_level};
use opnav::scene::{RenderConfig, SensorConfig, SunConfig, SurveyLevel, Terrain, TerrainConfig, View};
use opnav::vision::{DescriptorKind, DetectorKind, MapFeatures, MapFix, MapMatchConfig, MapMatcher, MapStatus};
use std::path::Path;
use std::sync::LazyLock;

const LEVELS: [SurveyLevel; 2] =
    [SurveyLevel { metres_per_px: 0.5, side_m: 160.0 }, SurveyLevel { metres_per_px: 2.0, side_m: 1200.0 }];

struct World3d {
    terrain: Terrain,
    gpu: Gpu,
    map: GroundMap,
}

fn sun() -> (nalgebra::Unit<Vector3<f64>>, f64) {
    let sun = SunConfig::default().sunlight_in_site(Path::new(".")).expect("a Sun");
    (sun.direction, sun.angular_radius_rad())
}

fn level(gpu: &Gpu, terrain: &Terrain, level: &SurveyLevel) -> MapLevel {
    map_level(gpu, terrain, sun(), (level, &RenderConfig::default())).expect("a map")
}

static WORLD: LazyLock<World3d> = LazyLock::new(|| {
    let gpu = Gpu::new(None).expect("an adapter");
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let levels = LEVELS.iter().map(|l| level(&gpu, &terrain, l)).collect();
    World3d { terrain, gpu, map: GroundMap { levels } }
});

fn camera() -> Camera {
    Camera::from_fov(256, 256, 90f64.to_radians())
}

/// A camera above the ground that looks down, tilted and turned by so much.
fn site_from_camera(place_m: Vector3<f64>, tilt_deg: f64, yaw_deg: f64) -> Isometry3<f64> {
    let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let turn = so3::exp(&Vector3::new(0.0, 0.0, yaw_deg.to_radians()))
        * so3::exp(&Vector3::new(tilt_deg.to_radians(), 0.0, 0.0));
    Isometry3::from_parts(Translation3::from(place_m), turn * down)
}

fn picture(world: &World3d, pose: &Isometry3<f64>, noise: bool) -> GrayImage {
    let (sun_in_reference, sun_angular_radius_rad) = sun();
    let view = View { t_ns: 0, reference_from_camera: *pose, sun_in_reference, sun_angular_radius_rad };
    let mut renderer = Renderer::new(&world.gpu, World::Terrain(&world.terrain), &camera(), &RenderConfig::default())
        .expect("a renderer");
    let frame = renderer.render(&view).expect("a picture");
    let sensor = SensorConfig { noise, ..SensorConfig::default() };
    Detector::new(&camera(), &sensor, 1, 0).expose(&frame, 0).to_image().expect("a full picture").into_luma8()
}

/// The prediction of a pose that is off by so many m and rad along every axis.
fn predicted(pose: &Isometry3<f64>, off_m: f64, off_rad: f64) -> PredictedCamera {
    let turn = so3::exp(&Vector3::repeat(off_rad));
    let moved = Isometry3::from_parts((pose.translation.vector + Vector3::repeat(off_m)).into(), turn * pose.rotation);
    PredictedCamera {
        camera_from_site: moved.inverse(),
        sigma_position_m: off_m.abs().max(0.1),
        sigma_attitude_rad: off_rad.abs().max(1e-3),
    }
}

fn matcher(map: &GroundMap) -> MapMatcher {
    MapMatcher::new(map, &MapFeatures::default(), &MapMatchConfig::default()).expect("usable settings")
}

fn sightings(map: &GroundMap, picture: &GrayImage, predicted: &PredictedCamera) -> MapFix {
    matcher(map).sightings(picture, &camera(), predicted).expect("OpenCV works")
}

/// Found less true pixels of the sightings.
fn errors_px(fix: &MapFix, pose: &Isometry3<f64>) -> Vec<Vector2<f64>> {
    let error = |s: &opnav::vision::MapSighting| {
        let in_camera_m = pose.inverse_transform_point(&Point3::from(s.point_in_site_m)).coords;
        s.pixel_px - camera().project(&in_camera_m).expect("in front of the camera")
    };
    fix.sightings.iter().map(error).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Mean squared error over its variance, a coordinate.
fn normalized(fix: &MapFix, pose: &Isometry3<f64>) -> f64 {
    let squared = |(e, s): (&Vector2<f64>, &opnav::vision::MapSighting)| {
        let of_map_m2 = (s.sigma_horizontal_m / pose.translation.z * camera().focal_px.x).powi(2);
        let covariance = s.covariance_px2 + nalgebra::Matrix2::identity() * of_map_m2;
        e.dot(&(covariance.try_inverse().expect("a covariance") * e)) / 2.0
    };
    let errors = errors_px(fix, pose);
    errors.iter().zip(&fix.sightings).map(squared).sum::<f64>() / errors.len() as f64
}

/// From where a pixel is as large as the map's: what is found lies where it truly is.
#[test]
fn points_of_the_map_are_found_where_they_are() {
    let pose = site_from_camera(Vector3::new(3.0, -2.0, 64.0), 2.0, 15.0);
    let picture = picture(&WORLD, &pose, false);
    let fix = sightings(&WORLD.map, &picture, &predicted(&pose, 0.2, 2e-3));
    assert_eq!((fix.status, fix.scale), (MapStatus::Tracked, 1.0));
    assert!(fix.sightings.len() >= 20, "{fix:?}");
    let error_px = median(errors_px(&fix, &pose).iter().map(Vector2::norm).collect());
    println!("median error {error_px} px, normalised {}", normalized(&fix, &pose));
    assert!(error_px < 0.15, "median error {error_px} px");
    assert!(normalized(&fix, &pose) < 1.0);
    let found = fix.camera_from_site.inverse();
    assert!((found.translation.vector - pose.translation.vector).norm() < 0.1, "{found} {pose}");
    assert!(found.rotation.angle_to(&pose.rotation) < 1e-3);
}

/// A map that lies 2 m off: all points agree, and the pose is off by as much; the truth contradicts them.
#[test]
fn a_shifted_map_shifts_the_pose() {
    let pose = site_from_camera(Vector3::new(3.0, -2.0, 64.0), 2.0, 15.0);
    let picture = picture(&WORLD, &pose, true);
    let mut map = WORLD.map.clone();
    map.levels.iter_mut().for_each(|l| l.first_in_site_m.x += 2.0);
    let wide = PredictedCamera { sigma_position_m: 50.0, sigma_attitude_rad: 0.05, ..predicted(&pose, 0.2, 2e-3) };
    let fix = sightings(&map, &picture, &wide);
    assert!(fix.sightings.len() >= 20, "{fix:?}");
    let shift = fix.camera_from_site.inverse().translation.vector - pose.translation.vector;
    assert!((shift - Vector3::new(2.0, 0.0, 0.0)).norm() < 0.3, "shift {shift}");
    println!("normalised {}", normalized(&fix, &pose));
    assert!(normalized(&fix, &pose) > 10.0, "a shift of 4 px passes unnoticed: {}", normalized(&fix, &pose));
}

/// A pose that is off by a seventh of the height and by 3°: patches would be looked for far from where they are.
#[test]
fn a_bad_prediction_is_recovered_by_descriptors() {
    let pose = site_from_camera(Vector3::new(40.0, 25.0, 330.0), 6.0, -20.0);
    let picture = picture(&WORLD, &pose, true);
    let bad = PredictedCamera { sigma_position_m: 40.0, sigma_attitude_rad: 0.02, ..predicted(&pose, 45.0, 0.03) };
    let mut found = Vec::new();
    let all = DetectorKind::ALL.iter().flat_map(|kind| DescriptorKind::ALL.iter().map(move |d| (*kind, *d)));
    for (kind, descriptor) in all {
        let mut means = MapFeatures::default();
        (means.detector.kind, means.matcher.descriptor) = (kind, descriptor);
        let matcher = MapMatcher::new(&WORLD.map, &means, &MapMatchConfig::default()).expect("usable settings");
        let fix = matcher.sightings(&picture, &camera(), &bad).expect("OpenCV works");
        assert_eq!(fix.status, MapStatus::Acquired, "{kind:?}, {descriptor:?}");
        let site_from_camera = fix.camera_from_site.inverse();
        let off_m = (site_from_camera.translation.vector - pose.translation.vector).norm();
        assert!(off_m < 1.5, "{kind:?}, {descriptor:?}: {off_m} m off");
        assert!(median(errors_px(&fix, &pose).iter().map(Vector2::norm).collect()) < 0.4);
        found.push(fix.camera_from_site);
    }
    assert!(found[1..].iter().all(|pose| *pose != found[0]), "the means that are asked for make a difference");
}

/// Low above the ground a picture shows what no map knows: it is made smaller until it does.
#[test]
fn a_near_image_is_made_as_coarse_as_the_map() {
    let pose = site_from_camera(Vector3::new(3.0, 4.0, 30.0), 3.0, 5.0);
    let fix = sightings(&WORLD.map, &picture(&WORLD, &pose, true), &predicted(&pose, 0.1, 1e-3));
    assert_eq!((fix.status, fix.scale), (MapStatus::Tracked, 2.0));
    let off_m = fix.camera_from_site.inverse().translation.vector - pose.translation.vector;
    assert!(off_m.norm() < 0.2, "{off_m}");
    assert!(
        fix.sightings.iter().all(|s| s.sigma_px() > 0.2),
        "no better than a tenth of the pixels that were compared"
    );
}

#[test]
fn other_ground_and_no_ground_give_nothing() {
    let pose = site_from_camera(Vector3::new(3.0, -2.0, 64.0), 2.0, 15.0);
    let guess = predicted(&pose, 0.2, 2e-3);
    let noise = GrayImage::from_fn(256, 256, |u, v| {
        let mixed = (u.wrapping_mul(0x9e37_79b1) ^ v.wrapping_mul(0x85eb_ca77)).wrapping_mul(0xc2b2_ae3d);
        image::Luma([(mixed >> 24) as u8])
    });
    for picture in [noise, GrayImage::new(256, 256)] {
        let fix = sightings(&WORLD.map, &picture, &guess);
        assert_eq!((fix.status, fix.sightings.len()), (MapStatus::Lost, 0));
        assert_eq!(fix.camera_from_site, guess.camera_from_site);
    }
    let elsewhere = site_from_camera(Vector3::new(5000.0, 0.0, 64.0), 0.0, 0.0);
    let fix = sightings(&WORLD.map, &picture(&WORLD, &pose, true), &predicted(&elsewhere, 0.2, 2e-3));
    assert_eq!((fix.status, fix.sightings.len()), (MapStatus::OffMap, 0));
    let below = site_from_camera(Vector3::new(0.0, 0.0, -50.0), 0.0, 0.0);
    let fix = sightings(&WORLD.map, &picture(&WORLD, &pose, true), &predicted(&below, 0.2, 2e-3));
    assert_eq!(fix.status, MapStatus::OffMap);
}

/// Holes in the map are left out: no sighting lies in one or beside it.
#[test]
fn holes_of_the_map_are_left_out() {
    let pose = site_from_camera(Vector3::new(3.0, -2.0, 64.0), 2.0, 15.0);
    let mut map = WORLD.map.clone();
    for level in &mut map.levels {
        let (width, height) = level.size_px();
        for (index, height_m) in level.heights_m.iter_mut().enumerate() {
            let pixel = Vector2::new((index as u32 % width) as f64, (index as u32 / width) as f64);
            let x_m = -0.5 * level.metres_per_px * f64::from(height - 1) + pixel.x * level.metres_per_px;
            *height_m = if x_m > 0.0 { f32::NAN } else { *height_m };
        }
    }
    let fix = sightings(&map, &picture(&WORLD, &pose, true), &predicted(&pose, 0.2, 2e-3));
    assert_eq!(fix.status, MapStatus::Tracked);
    assert!(fix.sightings.iter().all(|s| s.point_in_site_m.x < -1.0), "{fix:?}");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let pose = site_from_camera(Vector3::new(3.0, -2.0, 64.0), 2.0, 15.0);
    let (picture, guess) = (picture(&WORLD, &pose, true), predicted(&pose, 0.2, 2e-3));
    let wide = PredictedCamera { sigma_position_m: 10.0, sigma_attitude_rad: 0.02, ..predicted(&pose, 5.0, 0.02) };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| [sightings(&WORLD.map, &picture, &guess), sightings(&WORLD.map, &picture, &wide)])
    };
    let one = with(1);
    assert!(one.iter().all(|fix| !fix.sightings.is_empty()), "{one:?}");
    assert_eq!(one, with(2));
}

#[test]
fn a_map_does_not_depend_on_threads_and_its_errors_are_stated() {
    let small = SurveyLevel { metres_per_px: 1.0, side_m: 96.0 };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| level(&WORLD.gpu, &WORLD.terrain, &small))
    };
    let map = with(1);
    assert_eq!(map, with(2));
    assert_eq!((map.size_px(), map.first_in_site_m), ((97, 97), Vector2::new(-48.0, 48.0)));
    let off = |u: f64, v: f64| {
        let at = map.place_of(&Vector2::new(u, v));
        map.height_m(&at).expect("inside") - WORLD.terrain.height_m(at.x, at.y)
    };
    let squared: Vec<f64> = (0..90)
        .flat_map(|u| (0..90).map(move |v| (u, v)))
        .map(|(u, v)| off(f64::from(u) + 0.37, f64::from(v) + 0.61).powi(2))
        .collect();
    let rms_m = (squared.iter().sum::<f64>() / squared.len() as f64).sqrt();
    assert!((0.8..1.25).contains(&(map.sigma_vertical_m / rms_m)), "{} stated, {rms_m} found", map.sigma_vertical_m);
}

#[test]
fn settings_out_of_range_are_named() {
    let refused = |config: MapMatchConfig| {
        MapMatcher::new(&WORLD.map, &MapFeatures::default(), &config).expect_err("refused").to_string()
    };
    assert!(
        refused(MapMatchConfig { fewest_sightings: 2, ..MapMatchConfig::default() }).contains("map.fewest_sightings")
    );
    assert!(
        refused(MapMatchConfig { track_sigma_px: f64::NAN, ..MapMatchConfig::default() })
            .contains("map.track_sigma_px")
    );
}
