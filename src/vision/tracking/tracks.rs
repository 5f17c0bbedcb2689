//! Verified matches chain into tracks, each of one surface point.

use super::coasted_tracks::{CoastedSpan, CoastedTrack, carried_coasted};
use super::link::{Link, SharedPoint, TrackPoint};
use crate::observations::TrackObservation;
use crate::vision::features::Feature;
use crate::vision::matching::IndexMatch;
use nalgebra::Vector2;

/// 1σ of the first sight of a track, px: the point is whatever is there, so only later sights have errors.
const FIRST_SIGMA_PX: f64 = 0.05;
/// A track ends where its point and the corner that it is matched by have parted by this much, px.
const PARTED_PX: f64 = 3.0;

/// Tracks that grow image by image. What is kept of each image is what is reported of it.
pub struct Tracks {
    /// Points of the last image by feature; `None` for features that never matched.
    here: Vec<Option<TrackPoint>>,
    /// Points of the last image that have no corner there.
    coasted: Vec<CoastedTrack>,
    next: u64,
    observations: Vec<TrackObservation>,
    /// Of each observation, the links of its track so far that no matched corner made.
    followed: Vec<u32>,
    /// Where each image's observations start.
    starts: Vec<usize>,
}

impl Tracks {
    /// No tracks yet; numbers start after the designated point's.
    pub fn new() -> Self {
        let next = TrackObservation::DESIGNATED + 1;
        Tracks { here: Vec::new(), coasted: Vec::new(), next, observations: vec![], followed: vec![], starts: vec![] }
    }

    /// Carries points from the last image, taken at `t_ns`, to the next one along verified matches; new ones where none
    /// was. Points that no match carries go by `passage`, where there is one.
    pub(super) fn chain(
        &mut self,
        t_ns: i64,
        (features, next): (&[Feature], &[Feature]),
        matches: impl Iterator<Item = (IndexMatch, Option<Link>)>,
        passage: Option<&CoastedSpan>,
    ) {
        self.here.resize(features.len(), None);
        let mut there = vec![None; next.len()];
        let mut lost = self.here.clone();
        for (m, link) in matches {
            let corner_px = features[m.from].pixel_px;
            let start = self.here[m.from].unwrap_or_else(|| {
                self.next += 1;
                TrackPoint { number: self.next - 1, pixel_px: corner_px, sigma_px: FIRST_SIGMA_PX, followed: 0 }
            });
            self.here[m.from] = Some(start);
            lost[m.from] = None;
            let carried = carry(&start, &corner_px, (&next[m.to], link));
            let parted = (carried.pixel_px - next[m.to].pixel_px).norm() > PARTED_PX;
            there[m.to] = (!parted).then_some(carried);
        }
        let lost: Vec<CoastedTrack> =
            lost.iter().zip(features).filter_map(with_response).chain(self.coasted.clone()).collect();
        let coasted = passage.map_or(Vec::new(), |passage| carried_coasted(lost, passage, (next, &mut there)));
        self.report(t_ns, features);
        (self.here, self.coasted) = (there, coasted);
    }

    /// Reports the points of the last image, in order of the number; [`Tracks::chain`] does so for all before it.
    pub(super) fn report(&mut self, t_ns: i64, features: &[Feature]) {
        self.starts.push(self.observations.len());
        let cornered = self.here.iter().zip(features).filter_map(with_response);
        let mut all: Vec<CoastedTrack> = cornered.chain(self.coasted.iter().copied()).collect();
        all.sort_unstable_by_key(|l| l.point.number);
        self.followed.extend(all.iter().map(|l| l.point.followed));
        self.observations.extend(all.iter().map(|l| TrackObservation {
            t_ns,
            track_id: l.point.number,
            pixel_px: l.point.pixel_px,
            sigma_px: l.point.sigma_px,
            response: l.response,
        }));
    }

    /// All observations of an image, in order of the number.
    pub(super) fn observations(&self, image: usize) -> &[TrackObservation] {
        let end = self.starts.get(image + 1).copied().unwrap_or(self.observations.len());
        &self.observations[self.starts[image]..end]
    }

    /// Points seen in two images, in order of the number.
    pub fn shared(&self, from: usize, to: usize) -> Vec<SharedPoint> {
        self.shared_where(from, to, |_, _| true)
    }

    /// Points seen in two images, and carried all the way between them by matched corners. Those that their patches alone
    /// carried err alike with their neighbours: more of them would make a rotation look surer than it is.
    pub(super) fn shared_by_corners(&self, from: usize, to: usize) -> Vec<SharedPoint> {
        self.shared_where(from, to, |a, b| a == b)
    }

    /// Points seen in two images whose links without a corner, counted up to either, are accepted.
    fn shared_where(&self, from: usize, to: usize, accept: impl Fn(u32, u32) -> bool) -> Vec<SharedPoint> {
        let (a, b) = (self.observations(from), self.observations(to));
        let followed = |image: usize, i: usize| self.followed[self.starts[image] + i];
        let partner = |(i, a): (usize, &TrackObservation)| {
            let j = b.binary_search_by_key(&a.track_id, |o| o.track_id).ok()?;
            let variance_px2 = b[j].sigma_px.powi(2) - a.sigma_px.powi(2);
            let sigma_px = variance_px2.max(FIRST_SIGMA_PX.powi(2)).sqrt();
            accept(followed(from, i), followed(to, j)).then_some((a.pixel_px, b[j].pixel_px, sigma_px))
        };
        a.iter().enumerate().filter_map(partner).collect()
    }

    /// Every image's observations, in order of the image.
    pub fn into_observations(self) -> Vec<TrackObservation> {
        self.observations
    }
}

/// The point in the next image: through the patch where there is a link, else as the corner moved.
fn carry(start: &TrackPoint, corner_px: &Vector2<f64>, (next, link): (&Feature, Option<Link>)) -> TrackPoint {
    let off = start.pixel_px - corner_px;
    let (pixel_px, sigma_px, scale) = match link {
        Some(l) => (l.to_px + l.linear * off, l.sigma_px, l.linear.determinant().abs().sqrt()),
        None => (next.pixel_px + off, std::f64::consts::SQRT_2 * next.sigma_px, 1.0),
    };
    TrackPoint { pixel_px, sigma_px: (scale * start.sigma_px).hypot(sigma_px), ..*start }
}

fn with_response((point, feature): (&Option<TrackPoint>, &Feature)) -> Option<CoastedTrack> {
    point.map(|point| CoastedTrack { point, response: feature.response })
}
