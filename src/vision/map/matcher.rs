//! One image against the map.

use super::acquire::acquire;
use super::config::{MapFeatures, MapMatchConfig};
use super::fit::{Pointing, fit_pose};
use super::ground::{MapGround, Meeting};
use super::points::{FoundPoint, find, spread};
use super::result::{MapFix, MapStatus};
use super::view::MapView;
use crate::dataset::GroundMap;
use crate::geometry::Camera;
use crate::observations::PredictedCamera;
use crate::vision::error::VisionError;
use crate::vision::opencv_bridge::{grey_image, image_mat};
use image::GrayImage;
use nalgebra::{Isometry3, Matrix2, Vector2, Vector3};
use opencv::core::{BORDER_REFLECT_101, Mat, Size};
use opencv::imgproc::pyr_down;

/// Least share of the predicted view that the map has to cover.
const LEAST_COVERED: f64 = 0.05;
/// Images are not made smaller than this, px.
const LEAST_SIDE_PX: u32 = 64;
/// Residuals beyond this many 1σ do not agree.
const GATE_SIGMA: f64 = 3.5;
/// What is left to find after descriptors told the pose: 1σ of position over height, and of attitude.
const ACQUIRED_SHARE: f64 = 0.002;

/// Finds points of a map in images.
#[derive(Debug, Clone)]
pub struct MapMatcher {
    ground: MapGround,
    means: MapFeatures,
    config: MapMatchConfig,
}

impl MapMatcher {
    /// Prepares a map, whose features are found and matched by the given means.
    ///
    /// # Errors
    /// [`VisionError::OutOfRange`] names the setting at fault.
    pub fn new(map: &GroundMap, means: &MapFeatures, config: &MapMatchConfig) -> Result<Self, VisionError> {
        means.detector.validate().map_err(|e| e.under("detector"))?;
        means.matcher.validate().map_err(|e| e.under("matcher"))?;
        config.validate().map_err(|e| e.under("map"))?;
        Ok(MapMatcher { ground: MapGround::new(map), means: means.clone(), config: config.clone() })
    }

    /// Points of the map in an image that was taken near the predicted pose.
    ///
    /// The map is drawn as the predicted camera sees it, and patches about its corners are looked for in the image. Where
    /// the prediction is too wide for that, corners are matched by their descriptors first. The points that agree with one
    /// pose are given, the pose with them. That too few are found is an outcome.
    ///
    /// # Errors
    /// OpenCV's refusal.
    pub fn sightings(
        &self,
        image: &GrayImage,
        camera: &Camera,
        predicted: &PredictedCamera,
    ) -> Result<MapFix, VisionError> {
        let nothing = |status| MapFix {
            status,
            sightings: Vec::new(),
            camera_from_site: predicted.camera_from_site,
            found: 0,
            agreeing: 0,
            residual_px: f64::NAN,
            scale: 1.0,
        };
        let Some(height_m) = self.height_m(&predicted.camera_from_site) else { return Ok(nothing(MapStatus::OffMap)) };
        let halvings = self.halvings(camera, &predicted.camera_from_site, height_m);
        let (image, camera) = halved(image, camera, halvings)?;
        let scale = f64::from(1u32 << halvings);
        let focal_px = camera.mean_focal_px();
        let sigma_px = focal_px * (predicted.sigma_position_m / height_m).hypot(predicted.sigma_attitude_rad);
        if sigma_px <= self.config.track_sigma_px {
            let fix = self.tracked((&image, &camera), predicted, MapStatus::Tracked, scale)?;
            if fix.status == MapStatus::Tracked || sigma_px < 0.5 {
                return Ok(fix);
            }
        }
        let Some(pose) = acquire(&self.ground, (&image, &camera), predicted, &self.means)? else {
            return Ok(nothing(MapStatus::Lost));
        };
        let near = PredictedCamera {
            camera_from_site: pose,
            sigma_position_m: predicted.sigma_position_m.min(ACQUIRED_SHARE * height_m),
            sigma_attitude_rad: predicted.sigma_attitude_rad.min(ACQUIRED_SHARE),
        };
        let first = self.tracked((&image, &camera), &near, MapStatus::Acquired, scale)?;
        if first.status != MapStatus::Acquired {
            return Ok(first);
        }
        self.tracked(
            (&image, &camera),
            &PredictedCamera { camera_from_site: first.camera_from_site, ..near },
            MapStatus::Acquired,
            scale,
        )
    }

    /// Patches about corners of the map at their predicted places.
    fn tracked(
        &self,
        (image, camera): (&GrayImage, &Camera),
        predicted: &PredictedCamera,
        status: MapStatus,
        scale: f64,
    ) -> Result<MapFix, VisionError> {
        let view = MapView::draw(&self.ground, camera, &predicted.camera_from_site);
        let mut fix = MapFix {
            status: MapStatus::OffMap,
            sightings: Vec::new(),
            camera_from_site: predicted.camera_from_site,
            found: 0,
            agreeing: 0,
            residual_px: f64::NAN,
            scale,
        };
        if view.covered < LEAST_COVERED {
            return Ok(fix);
        }
        let found = find(&view, image, &self.config, &self.means.detector)?;
        (fix.status, fix.found) = (MapStatus::Lost, found.len());
        let Some((pose, agreeing, worse)) = self.agreeing(camera, &found, predicted) else { return Ok(fix) };
        fix.agreeing = agreeing.len();
        if agreeing.len() < self.config.fewest_sightings
            || (agreeing.len() as f64) < self.config.least_agreeing * found.len() as f64
        {
            return Ok(fix);
        }
        let residual = |p: &FoundPoint| {
            let in_camera_m = (pose * nalgebra::Point3::from(p.meeting.point_in_site_m)).coords;
            camera.project(&in_camera_m).map_or(Vector2::repeat(f64::NAN), |pixel| p.pixel_px - pixel)
        };
        let squared = agreeing.iter().map(|p| residual(p).norm_squared()).sum::<f64>();
        fix.residual_px = scale * (squared / (2 * agreeing.len()) as f64).sqrt();
        let chosen = spread(&agreeing, camera.size_px(), self.config.most_sightings);
        let sighting = |p: &FoundPoint| {
            let common_px2 = self.common_px2(camera, &pose, p) * chosen.len() as f64;
            // Where the points disagree more than they should, what they have in common is as much worse.
            let covariance_px2 = (p.covariance_px2 + common_px2) * worse.powi(2);
            let level = self.ground.level(p.meeting.level);
            FoundPoint { covariance_px2, ..*p }.sighting(scale, level)
        };
        fix.sightings = chosen.iter().map(sighting).collect();
        (fix.status, fix.camera_from_site) = (status, pose);
        Ok(fix)
    }

    /// The pose that fits the points, those that agree with it, and how many times larger than predicted their residuals are
    /// (1 or more).
    fn agreeing(
        &self,
        camera: &Camera,
        found: &[FoundPoint],
        predicted: &PredictedCamera,
    ) -> Option<(Isometry3<f64>, Vec<FoundPoint>, f64)> {
        if found.len() < self.config.fewest_sightings {
            return None;
        }
        let pointings: Vec<Pointing> = found.iter().map(FoundPoint::pointing).collect();
        let fit = fit_pose(camera, &pointings, predicted, &predicted.camera_from_site)?;
        let agrees =
            |(residual, p): (&Vector2<f64>, &Pointing)| residual.norm() <= GATE_SIGMA * p.sigma_px * fit.scale.max(1.0);
        let agreeing: Vec<FoundPoint> = found
            .iter()
            .zip(fit.residuals_px.iter().zip(&pointings))
            .filter(|(_, r)| agrees(*r))
            .map(|(p, _)| *p)
            .collect();
        Some((fit.camera_from_site, agreeing, fit.scale.max(1.0)))
    }

    /// Covariance of what a point's pixel has in common with all others, px²: a shift, and heights above the map's.
    fn common_px2(&self, camera: &Camera, camera_from_site: &Isometry3<f64>, point: &FoundPoint) -> Matrix2<f64> {
        let Meeting { point_in_site_m, footprint_m, .. } = point.meeting;
        let pixel = |height_m: f64| {
            let raised_m = point_in_site_m + Vector3::z() * height_m;
            camera.project(&(camera_from_site * nalgebra::Point3::from(raised_m)).coords)
        };
        let rises_px = pixel(footprint_m).zip(pixel(0.0)).map_or(Vector2::zeros(), |(above, on)| above - on);
        let out_px = rises_px * self.config.noise.standing_out_sigma;
        Matrix2::identity() * self.config.noise.common_sigma_px.powi(2) + out_px * out_px.transpose()
    }

    /// Height of the camera above the ground beneath it, or above the mean ground where the map ends; `None` if it is not
    /// above.
    fn height_m(&self, camera_from_site: &Isometry3<f64>) -> Option<f64> {
        let place_m = camera_from_site.inverse().translation.vector;
        let ground_m = self.ground.height_m(&place_m.xy(), 0.0).map_or(self.ground.mean_height_m(), |(_, h)| h);
        Some(place_m.z - ground_m).filter(|height_m| *height_m > 0.5)
    }

    /// How often an image is halved before it is compared with the map.
    fn halvings(&self, camera: &Camera, camera_from_site: &Isometry3<f64>, height_m: f64) -> u32 {
        let (width, height) = camera.size_px();
        let place_m = camera_from_site.inverse().translation.vector;
        let finest_m =
            self.ground.height_m(&place_m.xy(), 0.0).map_or(0.0, |(level, _)| self.ground.level(level).metres_per_px);
        let pixel_m = height_m / camera.mean_focal_px();
        let mut halvings = 0;
        while width.min(height) >> (halvings + 1) >= LEAST_SIDE_PX
            && (width.max(height) >> halvings > self.config.max_side_px
                || pixel_m * f64::from(1u32 << halvings) < self.config.least_pixel_ratio * finest_m)
        {
            halvings += 1;
        }
        halvings
    }
}

/// The image and its camera after some halvings: the pixel (u, v) becomes (u/2, v/2).
fn halved(image: &GrayImage, camera: &Camera, halvings: u32) -> Result<(GrayImage, Camera), VisionError> {
    let mut small = image.clone();
    let mut camera = *camera;
    for _ in 0..halvings {
        small = half(&small).map_err(VisionError::opencv("shrink a picture"))?;
        camera.focal_px *= 0.5;
        camera.center_px *= 0.5;
    }
    (camera.width_px, camera.height_px) = small.dimensions();
    Ok((small, camera))
}

fn half(image: &GrayImage) -> opencv::Result<GrayImage> {
    let mut half = Mat::default();
    pyr_down(&image_mat(image)?, &mut half, Size::default(), BORDER_REFLECT_101)?;
    grey_image(&half)
}
