//! Features of one picture, and their matches with the next.

use super::refined_match::Link;
use super::tracks::SharedPoint;
use crate::dataset::Frame;
use crate::geometry::Camera;
use crate::vision::config::{FrontEndConfig, FrontEndMode};
use crate::vision::error::VisionError;
use crate::vision::features::{Feature, detect_harris};
use crate::vision::front_end::FrameReport;
use crate::vision::masks::{bright_centroid_px, inside_silhouette};
use crate::vision::matching::{Descriptions, IndexMatch, MatcherConfig, Orientation, match_described};
use crate::vision::pair::PixelMatches;
use crate::vision::result::{FrameStatus, MatchedPair};
use crate::vision::sequence::Job;
use image::GrayImage;
use nalgebra::{UnitQuaternion, Vector2};
use std::borrow::Cow;
use std::sync::OnceLock;
use std::time::Instant;

/// A picture's features and descriptors; the picture itself until its pairs are solved.
pub struct FrameFeatures {
    pub(super) features: Vec<Feature>,
    pub centroid_px: Option<Vector2<f64>>,
    pub report: FrameReport,
    pub(super) picture: GrayImage,
    upright: OnceLock<Descriptions>,
    turned: OnceLock<Descriptions>,
}

pub fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

impl FrameFeatures {
    /// Loads a picture, finds its features and describes them; a picture that cannot be loaded is an outcome.
    pub(super) fn find(job: &Job, frame: &Frame) -> Result<Self, VisionError> {
        let config = job.config;
        let start = Instant::now();
        let picture = match job.sequence.load(frame) {
            Ok(picture) => picture,
            Err(error) => return Ok(FrameFeatures::none(FrameReport::unusable(frame, &error))),
        };
        let load_ms = milliseconds(start);
        let start = Instant::now();
        let (mask, centroid_px) = where_to_look(job, &picture)?;
        let features = detect_harris(&picture, mask.as_deref(), &config.detector)?;
        let detect_ms = milliseconds(start);
        let start = Instant::now();
        let upright = Descriptions::find(&picture, &features, Orientation::Upright, &config.matcher)?.into();
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
        Ok(FrameFeatures { features, centroid_px, report, picture, upright, turned: OnceLock::new() })
    }

    fn none(report: FrameReport) -> Self {
        let (upright, turned) = (OnceLock::new(), OnceLock::new());
        FrameFeatures { features: vec![], centroid_px: None, report, picture: GrayImage::default(), upright, turned }
    }

    /// Features with their descriptors, which are made when they are first asked for: most pairs need none turned.
    fn described(
        &self,
        orientation: Orientation,
        config: &MatcherConfig,
    ) -> Result<(&[Feature], &Descriptions), VisionError> {
        let kept = match orientation {
            Orientation::Upright => &self.upright,
            Orientation::Centroid => &self.turned,
        };
        if kept.get().is_none() {
            // Two pairs may come here at once: both make the same.
            let _ = kept.set(Descriptions::find(&self.picture, &self.features, orientation, config)?);
        }
        Ok((&self.features, kept.get().expect("it is set just above")))
    }

    /// Drops what only the pairs need.
    pub(super) fn forget_picture(&mut self) {
        self.picture = GrayImage::default();
        self.upright = OnceLock::new();
        self.turned = OnceLock::new();
    }
}

/// Where features may lie (everywhere if `None`), and the middle of the body.
type Outlook<'a> = (Option<Cow<'a, GrayImage>>, Option<Vector2<f64>>);

/// All over the picture, or inside a body's silhouette, and always clear of what the mask leaves out.
fn where_to_look<'a>(job: &'a Job, picture: &GrayImage) -> Result<Outlook<'a>, VisionError> {
    let keep_out = job.keep_out.as_ref();
    if job.config.mode == FrontEndMode::Auto {
        return Ok((keep_out.map(|k| Cow::Borrowed(k.clear())), None));
    }
    let seen = keep_out.map_or(Cow::Borrowed(picture), |k| Cow::Owned(k.blackened(picture)));
    let mut inside = inside_silhouette(&seen, job.config.fixed_center.limb_margin_px)?;
    if let Some(keep_out) = keep_out {
        inside.iter_mut().zip(keep_out.clear().iter()).for_each(|(inside, clear)| *inside = (*inside).min(*clear));
    }
    Ok((Some(Cow::Owned(inside)), bright_centroid_px(&seen)?))
}

/// Ways to match, the most selective first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    Guided,
    Upright,
    Turned,
}

/// Matches two pictures in one way; without a prediction the guided way finds nothing.
pub(super) fn match_pair(
    (from, to): (&FrameFeatures, &FrameFeatures),
    way: Way,
    (camera, predicted): (&Camera, Option<UnitQuaternion<f64>>),
    config: &FrontEndConfig,
) -> Result<Vec<IndexMatch>, VisionError> {
    let orientation = match way {
        Way::Guided if predicted.is_some_and(|q| roll_rad(&q).abs() < 0.2) => Orientation::Upright,
        Way::Upright => Orientation::Upright,
        _ => Orientation::Centroid,
    };
    let matcher = &config.matcher;
    let (from, to) = (from.described(orientation, matcher)?, to.described(orientation, matcher)?);
    if way != Way::Guided {
        return Ok(match_described(from, to, None, matcher));
    }
    let Some(rotation) = predicted else { return Ok(Vec::new()) };
    let predict =
        |pixel: &Vector2<f64>| camera.unproject(pixel).and_then(|ray| camera.project(&(rotation * ray.into_inner())));
    Ok(match_described(from, to, Some(&predict), matcher))
}

/// Turn of the picture about its axis.
fn roll_rad(rotation: &UnitQuaternion<f64>) -> f64 {
    2.0 * rotation.k.atan2(rotation.w)
}

/// Matched pixels with their noise, owned.
#[derive(Debug, Clone, Default)]
pub struct PairPixels {
    pub(super) pair: MatchedPair,
    pub(super) sigma_px: Vec<f64>,
}

impl PairPixels {
    pub(super) fn new(from: &[Feature], to: &[Feature], matches: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut pixels = PairPixels::default();
        for (i, j) in matches {
            pixels.pair.from_px.push(from[i].pixel_px);
            pixels.pair.to_px.push(to[j].pixel_px);
            pixels.sigma_px.push((0.5 * (from[i].sigma_px.powi(2) + to[j].sigma_px.powi(2))).sqrt());
        }
        pixels
    }

    /// Pixels of the same points, each with the 1σ of the second given the first.
    pub(super) fn from_shared(points: &[SharedPoint]) -> Self {
        let mut pixels = PairPixels::default();
        for (from_px, to_px, sigma_px) in points {
            pixels.pair.from_px.push(*from_px);
            pixels.pair.to_px.push(*to_px);
            pixels.sigma_px.push(sigma_px * std::f64::consts::FRAC_1_SQRT_2);
        }
        pixels
    }

    /// The same matches with the second pixels where the links put them.
    pub(super) fn sharpened(&self, links: &[Option<Link>]) -> Self {
        let mut pixels = self.clone();
        for (i, link) in links.iter().enumerate() {
            if let Some(link) = link {
                pixels.pair.to_px[i] = link.to_px;
                pixels.sigma_px[i] = link.sigma_px * std::f64::consts::FRAC_1_SQRT_2;
            }
        }
        pixels
    }

    pub fn view(&self) -> PixelMatches<'_> {
        PixelMatches { pair: &self.pair, sigma_px: &self.sigma_px }
    }
}
