//! Verified matches chain into tracks, each of one surface point.

use super::matching::IndexMatch;
use super::sharpen::Link;
use super::{Feature, TrackObservation};
use nalgebra::Vector2;

/// 1σ of the first sight of a track, px: the point is whatever is there, so only later sights have errors.
const FIRST_SIGMA_PX: f64 = 0.05;
/// A track ends where its point and the corner that it is matched by have parted by this much, px.
const PARTED_PX: f64 = 3.0;

/// Where a track is in one picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrackPoint {
    pub(super) number: u64,
    pub(super) pixel_px: Vector2<f64>,
    /// 1σ of the drift off the point of the first sight, px.
    pub(super) sigma_px: f64,
}

/// A point in two pictures, with the 1σ of the second pixel given the first, px.
pub(super) type SharedPoint = (Vector2<f64>, Vector2<f64>, f64);

/// Tracks that grow picture by picture. What is kept of each picture is what is reported of it.
pub(super) struct Tracks {
    /// Points of the last picture by feature; `None` for features that never matched.
    here: Vec<Option<TrackPoint>>,
    next: u64,
    observations: Vec<TrackObservation>,
    /// Where each picture's observations start.
    starts: Vec<usize>,
}

impl Tracks {
    /// No tracks yet; numbers start after the designated point's.
    pub(super) fn new() -> Self {
        let next = TrackObservation::DESIGNATED + 1;
        Tracks { here: Vec::new(), next, observations: Vec::new(), starts: Vec::new() }
    }

    /// Carries points from the last picture, taken at `t_ns`, to the next one along verified matches; new ones where none
    /// was.
    pub(super) fn chain(
        &mut self,
        t_ns: i64,
        (features, next): (&[Feature], &[Feature]),
        matches: impl Iterator<Item = (IndexMatch, Option<Link>)>,
    ) {
        self.here.resize(features.len(), None);
        let mut there = vec![None; next.len()];
        for (m, link) in matches {
            let corner_px = features[m.from].pixel_px;
            let start = self.here[m.from].unwrap_or_else(|| {
                self.next += 1;
                TrackPoint { number: self.next - 1, pixel_px: corner_px, sigma_px: FIRST_SIGMA_PX }
            });
            self.here[m.from] = Some(start);
            let carried = carry(&start, &corner_px, (&next[m.to], link));
            let parted = (carried.pixel_px - next[m.to].pixel_px).norm() > PARTED_PX;
            there[m.to] = (!parted).then_some(carried);
        }
        self.report(t_ns, features);
        self.here = there;
    }

    /// Reports the points of the last picture, in order of the number; [`Tracks::chain`] does so for all before it.
    pub(super) fn report(&mut self, t_ns: i64, features: &[Feature]) {
        let start = self.observations.len();
        self.starts.push(start);
        let known = self.here.iter().zip(features).filter_map(|(p, f)| p.map(|p| (p, f)));
        self.observations.extend(known.map(|(p, f)| TrackObservation {
            t_ns,
            track_id: p.number,
            pixel_px: p.pixel_px,
            sigma_px: p.sigma_px,
            response: f.response,
        }));
        self.observations[start..].sort_unstable_by_key(|o| o.track_id);
    }

    /// All observations of a picture, in order of the number.
    pub(super) fn observations(&self, picture: usize) -> &[TrackObservation] {
        let end = self.starts.get(picture + 1).copied().unwrap_or(self.observations.len());
        &self.observations[self.starts[picture]..end]
    }

    /// Points seen in two pictures, in order of the number.
    pub(super) fn shared(&self, from: usize, to: usize) -> Vec<SharedPoint> {
        let b = self.observations(to);
        let partner = |a: &TrackObservation| {
            let end = b[b.binary_search_by_key(&a.track_id, |o| o.track_id).ok()?];
            let variance_px2 = end.sigma_px.powi(2) - a.sigma_px.powi(2);
            Some((a.pixel_px, end.pixel_px, variance_px2.max(FIRST_SIGMA_PX.powi(2)).sqrt()))
        };
        self.observations(from).iter().filter_map(partner).collect()
    }

    /// Every picture's observations, in order of the picture.
    pub(super) fn into_observations(self) -> Vec<TrackObservation> {
        self.observations
    }
}

/// The point in the next picture: through the patch where there is a link, else as the corner moved.
fn carry(start: &TrackPoint, corner_px: &Vector2<f64>, (next, link): (&Feature, Option<Link>)) -> TrackPoint {
    let off = start.pixel_px - corner_px;
    let (pixel_px, sigma_px, scale) = match link {
        Some(l) => (l.to_px + l.linear * off, l.sigma_px, l.linear.determinant().abs().sqrt()),
        None => (next.pixel_px + off, std::f64::consts::SQRT_2 * next.sigma_px, 1.0),
    };
    TrackPoint { number: start.number, pixel_px, sigma_px: (scale * start.sigma_px).hypot(sigma_px) }
}
