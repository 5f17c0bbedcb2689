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

/// The track of every feature of every picture; `None` for features that never matched.
pub(super) struct Tracks {
    points: Vec<Vec<Option<TrackPoint>>>,
    next: u64,
}

impl Tracks {
    /// No tracks yet; numbers start after the designated point's.
    pub(super) fn new(features: impl Iterator<Item = usize>) -> Self {
        Tracks { points: features.map(|n| vec![None; n]).collect(), next: TrackObservation::DESIGNATED + 1 }
    }

    /// Carries points from picture `from` to the next one along verified matches; new ones where none was.
    pub(super) fn chain(
        &mut self,
        from: usize,
        (features, next): (&[Feature], &[Feature]),
        matches: impl Iterator<Item = (IndexMatch, Option<Link>)>,
    ) {
        for (m, link) in matches {
            let corner_px = features[m.from].pixel_px;
            let start = self.points[from][m.from].unwrap_or_else(|| {
                self.next += 1;
                TrackPoint { number: self.next - 1, pixel_px: corner_px, sigma_px: FIRST_SIGMA_PX }
            });
            self.points[from][m.from] = Some(start);
            let carried = carry(&start, &corner_px, (&next[m.to], link));
            let parted = (carried.pixel_px - next[m.to].pixel_px).norm() > PARTED_PX;
            self.points[from + 1][m.to] = (!parted).then_some(carried);
        }
    }

    /// Points seen in two pictures, in order of the number.
    pub(super) fn shared(&self, from: usize, to: usize) -> Vec<SharedPoint> {
        let sorted = |frame: usize| {
            let mut known: Vec<TrackPoint> = self.points[frame].iter().flatten().copied().collect();
            known.sort_unstable_by_key(|p| p.number);
            known
        };
        let b = sorted(to);
        let partner = |a: TrackPoint| {
            let end = b[b.binary_search_by_key(&a.number, |p| p.number).ok()?];
            let variance_px2 = end.sigma_px.powi(2) - a.sigma_px.powi(2);
            Some((a.pixel_px, end.pixel_px, variance_px2.max(FIRST_SIGMA_PX.powi(2)).sqrt()))
        };
        sorted(from).into_iter().filter_map(partner).collect()
    }

    /// All observations of a picture, in order of the number.
    pub(super) fn observations(&self, frame: usize, t_ns: i64, features: &[Feature]) -> Vec<TrackObservation> {
        let known = self.points[frame].iter().zip(features).filter_map(|(p, f)| p.map(|p| (p, f)));
        let observation = |(p, f): (TrackPoint, &Feature)| TrackObservation {
            t_ns,
            track_id: p.number,
            pixel_px: p.pixel_px,
            sigma_px: p.sigma_px,
            response: f.response,
        };
        let mut all: Vec<TrackObservation> = known.map(observation).collect();
        all.sort_unstable_by_key(|o| o.track_id);
        all
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
