//! The pose of a badly predicted image: descriptors matched anywhere, and the pose that most of them agree with.

use super::config::MapFeatures;
use super::fit::{Pointing, fit_pose};
use super::ground::MapGround;
use super::points::half_px;
use super::view::MapView;
use crate::geometry::Camera;
use crate::observations::PredictedCamera;
use crate::vision::error::VisionError;
use crate::vision::features::{DetectorConfig, Feature, detect_features};
use crate::vision::matching::{Described, DescriptorSet, Orientation, describe_features, match_features};
use crate::vision::opencv_bridge::{mat_from, points};
use image::GrayImage;
use nalgebra::{Isometry3, Matrix3, Translation3, Vector2, Vector3};
use opencv::calib3d::{SOLVEPNP_P3P, solve_pnp_ransac};
use opencv::core::{Mat, Point3d, Vector, no_array};

/// Heights at which the map is drawn, in 1σ of the predicted height: descriptors bear a change of scale of a tenth.
const HEIGHTS_SIGMA: [f64; 5] = [0.0, -0.8, 0.8, -1.6, 1.6];
/// Corners of each image.
const CORNERS: usize = 800;
/// A match agrees with a pose up to this residual, px.
const AGREEING_PX: f64 = 4.0;
/// Fewest agreeing matches.
const FEWEST: usize = 12;
/// Random samples of matches.
const SAMPLES: i32 = 2000;
/// 1σ of a corner's pixel among the agreeing matches, px.
const CORNER_SIGMA_PX: f64 = 0.7;

/// The pose of an image within the wide limits of its prediction; `None` where too few corners match the map.
pub(super) fn acquire(
    ground: &MapGround,
    (image, camera): (&GrayImage, &Camera),
    predicted: &PredictedCamera,
    means: &MapFeatures,
) -> Result<Option<Isometry3<f64>>, VisionError> {
    let (features, descriptors) = described(image, None, means)?;
    let here = Described { features: &features, descriptors: &descriptors };
    let mut best: Option<(usize, Isometry3<f64>)> = None;
    for height_sigma in HEIGHTS_SIGMA {
        let raised = raised(&predicted.camera_from_site, height_sigma * predicted.sigma_position_m);
        let view = MapView::draw(ground, camera, &raised);
        let (map_features, map_descriptors) = described(&view.image, Some(&view.known), means)?;
        let there = Described { features: &map_features, descriptors: &map_descriptors };
        let matches = match_features(there, here, &means.matcher)?;
        let pointing = |m: &crate::vision::matching::IndexMatch| {
            let meeting = view.meet(&map_features[m.from].pixel_px)?;
            let (point_in_site_m, pixel_px) = (meeting.point_in_site_m, features[m.to].pixel_px);
            Some(Pointing { point_in_site_m, pixel_px, sigma_px: CORNER_SIGMA_PX })
        };
        let pointings: Vec<Pointing> = matches.iter().filter_map(pointing).collect();
        if let Some((agreeing, pose)) = agreed_pose(camera, &pointings, predicted)
            && best.is_none_or(|(most, _)| agreeing > most)
        {
            best = Some((agreeing, pose));
        }
    }
    Ok(best.map(|(_, pose)| pose))
}

/// The pose with the camera higher by some metres.
fn raised(camera_from_site: &Isometry3<f64>, by_m: f64) -> Isometry3<f64> {
    camera_from_site * Translation3::new(0.0, 0.0, -by_m)
}

fn described(
    image: &GrayImage,
    known: Option<&GrayImage>,
    means: &MapFeatures,
) -> Result<(Vec<Feature>, DescriptorSet), VisionError> {
    let border_px = 2 * half_px(image);
    let config = DetectorConfig { max_features: CORNERS, border_px, ..means.detector.clone() };
    let features = detect_features(image, known, &config)?;
    let descriptors = describe_features(image, &features, Orientation::Upright, &means.matcher)?;
    Ok((features, descriptors))
}

/// The pose that most points agree with, and their number.
fn agreed_pose(camera: &Camera, points: &[Pointing], predicted: &PredictedCamera) -> Option<(usize, Isometry3<f64>)> {
    let start = sampled_pose(camera, points)?;
    let mut pose = start;
    let mut agreeing: Vec<Pointing> = Vec::new();
    for _ in 0..3 {
        let near = |p: &&Pointing| residual_px(camera, &pose, p) < AGREEING_PX;
        agreeing = points.iter().filter(near).copied().collect();
        if agreeing.len() < FEWEST {
            return None;
        }
        pose = fit_pose(camera, &agreeing, predicted, &pose)?.camera_from_site;
    }
    Some((agreeing.len(), pose))
}

fn residual_px(camera: &Camera, pose: &Isometry3<f64>, point: &Pointing) -> f64 {
    let in_camera_m = (pose * nalgebra::Point3::from(point.point_in_site_m)).coords;
    camera.project(&in_camera_m).map_or(f64::INFINITY, |pixel_px| (pixel_px - point.pixel_px).norm())
}

/// The pose of the best of many random samples of points, through OpenCV's RANSAC (of a fixed seed).
fn sampled_pose(camera: &Camera, pointings: &[Pointing]) -> Option<Isometry3<f64>> {
    if pointings.len() < FEWEST {
        return None;
    }
    let focal_px = camera.mean_focal_px();
    let ideal: Vec<Vector2<f64>> = pointings.iter().map(|p| camera.normalize(&p.pixel_px)).collect::<Option<_>>()?;
    let pixels = points(ideal.iter().map(|n| n * focal_px));
    // Counted from the first point: the solver works with small numbers.
    let zero_m = pointings[0].point_in_site_m;
    let places: Vector<Point3d> =
        pointings.iter().map(|p| p.point_in_site_m - zero_m).map(|p| Point3d::new(p.x, p.y, p.z)).collect();
    let intrinsic = mat_from(&Matrix3::new(focal_px, 0.0, 0.0, 0.0, focal_px, 0.0, 0.0, 0.0, 1.0)).ok()?;
    let (mut turn, mut shift, mut agreeing) = (Mat::default(), Mat::default(), Mat::default());
    // OpenCV throws where no sample gives a pose: that is an outcome, not an error.
    let found = solve_pnp_ransac(
        &places,
        &pixels,
        &intrinsic,
        &no_array(),
        &mut turn,
        &mut shift,
        false,
        SAMPLES,
        AGREEING_PX as f32,
        0.9999,
        &mut agreeing,
        SOLVEPNP_P3P,
    );
    if !found.unwrap_or(false) {
        return None;
    }
    let vector =
        |mat: &Mat| crate::vision::opencv_bridge::vector_from(mat).filter(|v: &Vector3<f64>| v.norm().is_finite());
    let rotation = crate::geometry::so3::exp(&vector(&turn)?);
    let shift_m = vector(&shift)? - rotation * zero_m;
    Some(Isometry3::from_parts(shift_m.into(), rotation))
}
