//! Features of one image, and their matches with the next.

use super::context::{TrackingContext, milliseconds};
use crate::dataset::Frame;
use crate::geometry::Camera;
use crate::observations::FrameStatus;
use crate::vision::config::{FrontEndConfig, FrontEndMode};
use crate::vision::error::VisionError;
use crate::vision::features::{Feature, detect_features};
use crate::vision::front_end::FrameReport;
use crate::vision::masks::{bright_centroid_px, inside_silhouette};
use crate::vision::matching::{
    Described, DescriptorSet, IndexMatch, MatcherConfig, Orientation, describe_features, match_features,
    match_features_guided,
};
use image::GrayImage;
use nalgebra::{UnitQuaternion, Vector2};
use std::borrow::Cow;
use std::sync::OnceLock;
use std::time::Instant;

/// An image's features and descriptors; the image itself until its pairs are solved.
pub struct FrameFeatures {
    pub(super) features: Vec<Feature>,
    pub centroid_px: Option<Vector2<f64>>,
    pub report: FrameReport,
    pub(super) image: GrayImage,
    upright: OnceLock<DescriptorSet>,
    turned: OnceLock<DescriptorSet>,
}

impl FrameFeatures {
    /// Loads an image, finds its features and describes them; an image that cannot be loaded is an outcome.
    pub(super) fn find(context: &TrackingContext, frame: &Frame) -> Result<Self, VisionError> {
        let config = context.config;
        let start = Instant::now();
        let image = match context.sequence.load(frame) {
            Ok(image) => image,
            Err(error) => return Ok(FrameFeatures::none(FrameReport::unusable(frame, &error))),
        };
        let load_ms = milliseconds(start);
        let start = Instant::now();
        let (mask, centroid_px) = where_to_look(context, &image)?;
        let features = detect_features(&image, mask.as_deref(), &config.detector)?;
        let detect_ms = milliseconds(start);
        let start = Instant::now();
        let upright = describe_features(&image, &features, Orientation::Upright, &config.matcher)?.into();
        let describe_ms = milliseconds(start);
        let (index, t_ns) = (frame.index, frame.t_ns);
        let enough = features.len() >= config.rotation.min_matches;
        let report = FrameReport {
            index,
            t_ns,
            status: if enough { FrameStatus::Ok } else { FrameStatus::NoFeatures },
            features: features.len(),
            load_ms,
            detect_ms,
            describe_ms,
            ..FrameReport::default()
        };
        Ok(FrameFeatures { features, centroid_px, report, image, upright, turned: OnceLock::new() })
    }

    fn none(report: FrameReport) -> Self {
        let (upright, turned) = (OnceLock::new(), OnceLock::new());
        FrameFeatures { features: vec![], centroid_px: None, report, image: GrayImage::default(), upright, turned }
    }

    /// Features with their descriptors, which are made when they are first asked for: most pairs need none turned.
    fn described(&self, orientation: Orientation, config: &MatcherConfig) -> Result<Described<'_>, VisionError> {
        let kept = match orientation {
            Orientation::Upright => &self.upright,
            Orientation::Centroid => &self.turned,
        };
        if kept.get().is_none() {
            // Two pairs may come here at once: both make the same.
            let _ = kept.set(describe_features(&self.image, &self.features, orientation, config)?);
        }
        Ok(Described { features: &self.features, descriptors: kept.get().expect("it is set just above") })
    }

    /// Drops what only the pairs need.
    pub(super) fn forget_image(&mut self) {
        self.image = GrayImage::default();
        self.upright = OnceLock::new();
        self.turned = OnceLock::new();
    }
}

/// Where features may lie (everywhere if `None`), and the middle of the body.
type Outlook<'a> = (Option<Cow<'a, GrayImage>>, Option<Vector2<f64>>);

/// All over the image, or inside a body's silhouette, and always clear of what the mask leaves out.
fn where_to_look<'a>(context: &'a TrackingContext, image: &GrayImage) -> Result<Outlook<'a>, VisionError> {
    let keep_out = context.keep_out.as_ref();
    if context.config.mode == FrontEndMode::Auto {
        return Ok((keep_out.map(|k| Cow::Borrowed(k.clear())), None));
    }
    let seen = keep_out.map_or(Cow::Borrowed(image), |k| Cow::Owned(k.blackened(image)));
    let mut inside = inside_silhouette(&seen, context.config.fixed_center.limb_margin_px)?;
    if let Some(keep_out) = keep_out {
        inside.iter_mut().zip(keep_out.clear().iter()).for_each(|(inside, clear)| *inside = (*inside).min(*clear));
    }
    Ok((Some(Cow::Owned(inside)), bright_centroid_px(&seen)?))
}

/// Ways to match, the most selective first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MatchStrategy {
    Guided,
    Upright,
    Turned,
}

/// Matches two images by one strategy; without a prediction the guided strategy finds nothing.
pub(super) fn match_pair(
    (from, to): (&FrameFeatures, &FrameFeatures),
    strategy: MatchStrategy,
    (camera, predicted): (&Camera, Option<UnitQuaternion<f64>>),
    config: &FrontEndConfig,
) -> Result<Vec<IndexMatch>, VisionError> {
    let orientation = match strategy {
        MatchStrategy::Guided if predicted.is_some_and(|q| roll_rad(&q).abs() < 0.2) => Orientation::Upright,
        MatchStrategy::Upright => Orientation::Upright,
        _ => Orientation::Centroid,
    };
    let matcher = &config.matcher;
    let (from, to) = (from.described(orientation, matcher)?, to.described(orientation, matcher)?);
    if strategy != MatchStrategy::Guided {
        return match_features(from, to, matcher);
    }
    let Some(rotation) = predicted else { return Ok(Vec::new()) };
    let predict =
        |pixel: &Vector2<f64>| camera.unproject(pixel).and_then(|ray| camera.project(&(rotation * ray.into_inner())));
    match_features_guided(from, to, &predict, matcher)
}

/// Turn of the image about its axis.
fn roll_rad(rotation: &UnitQuaternion<f64>) -> f64 {
    2.0 * rotation.k.atan2(rotation.w)
}
