//! From the ideal direction to a feature that is really there.

use nalgebra::{Unit, Vector3};

/// A feature in the image that could become the unknown landmark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The feature's track.
    pub track_id: u64,
    /// Its bearing in site axes, by the estimated attitude.
    pub direction_in_site: Unit<Vector3<f64>>,
}

/// The candidate whose bearing is nearest the ideal direction among those that `survives` says will stay in view
/// (Li et al. 2023, section 2.2); `None` if none does. Of equals the first wins.
pub fn choose<'a>(
    ideal_direction_in_site: &Unit<Vector3<f64>>,
    candidates: &'a [Candidate],
    survives: impl Fn(&Candidate) -> bool,
) -> Option<&'a Candidate> {
    let distance_rad = |c: &Candidate| c.direction_in_site.angle(ideal_direction_in_site);
    candidates.iter().filter(|c| survives(c)).min_by(|a, b| distance_rad(a).total_cmp(&distance_rad(b)))
}
