//! Verified matches chain into tracks.

use super::matching::IndexMatch;
use super::{Feature, TrackObservation};

/// Track number of every feature of every picture; `None` for features that never matched.
pub(super) struct TrackNumbers {
    numbers: Vec<Vec<Option<u64>>>,
    next: u64,
}

impl TrackNumbers {
    /// No tracks yet; numbers start after the designated point's.
    pub(super) fn new(features: impl Iterator<Item = usize>) -> Self {
        TrackNumbers { numbers: features.map(|n| vec![None; n]).collect(), next: TrackObservation::DESIGNATED + 1 }
    }

    /// Carries numbers from picture `from` to the next one along verified matches; new ones where none was.
    pub(super) fn chain(&mut self, from: usize, matches: impl Iterator<Item = IndexMatch>) {
        for m in matches {
            let number = self.numbers[from][m.from].unwrap_or_else(|| {
                self.next += 1;
                self.next - 1
            });
            self.numbers[from][m.from] = Some(number);
            self.numbers[from + 1][m.to] = Some(number);
        }
    }

    /// Features with the same number in two pictures, as indices, in order of the number.
    pub(super) fn shared(&self, from: usize, to: usize) -> Vec<(usize, usize)> {
        let sorted = |frame: usize| {
            let all = self.numbers[frame].iter().enumerate();
            let mut known: Vec<(u64, usize)> = all.filter_map(|(i, n)| n.map(|n| (n, i))).collect();
            known.sort_unstable();
            known
        };
        let (a, b) = (sorted(from), sorted(to));
        let partner = |(n, i): &(u64, usize)| b.binary_search_by_key(n, |(n, _)| *n).ok().map(|j| (*i, b[j].1));
        a.iter().filter_map(partner).collect()
    }

    /// All observations of a picture, in order of the number.
    pub(super) fn observations(&self, frame: usize, t_ns: i64, features: &[Feature]) -> Vec<TrackObservation> {
        let known = self.numbers[frame].iter().zip(features).filter_map(|(n, f)| n.map(|n| (n, f)));
        let observation = |(track_id, f): (u64, &Feature)| TrackObservation {
            t_ns,
            track_id,
            pixel_px: f.pixel_px,
            sigma_px: f.sigma_px,
            response: f.response,
        };
        let mut all: Vec<TrackObservation> = known.map(observation).collect();
        all.sort_unstable_by_key(|o| o.track_id);
        all
    }
}
