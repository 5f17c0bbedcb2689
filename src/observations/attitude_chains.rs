//! Attitudes chained from the rotations between images.

use super::rotation::{PairStatus, RelativeRotation};
use crate::dataset::StampedPose;
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use std::collections::BTreeMap;

/// Attitudes of the camera, each chain in the axes that the camera had in the chain's own first image
/// (`first_from_camera`, no translation), in order of time.
///
/// Each image is tied to the latest earlier one from which a rotation with status ok leads to it, so a broken link is
/// bridged by the shortest pair that spans it. An image to which none leads begins a chain of its own: how it is turned
/// against the chains before is not known. Chains of one image are left out.
pub fn attitude_chains(times_ns: &[i64], rotations: &[RelativeRotation]) -> Vec<Vec<StampedPose>> {
    let mut into: BTreeMap<i64, &RelativeRotation> = BTreeMap::new();
    for r in rotations.iter().filter(|r| r.status == PairStatus::Ok && r.t_ns_from < r.t_ns_to) {
        let latest = into.entry(r.t_ns_to).or_insert(r);
        if r.t_ns_from > latest.t_ns_from {
            *latest = r;
        }
    }
    let mut chains: Vec<Vec<StampedPose>> = Vec::new();
    let mut known: BTreeMap<i64, (usize, UnitQuaternion<f64>)> = BTreeMap::new();
    for t_ns in times_ns {
        let tied = into.get(t_ns).and_then(|r| known.get(&r.t_ns_from).map(|(chain, first)| (*chain, *first, r)));
        let (chain, first_from_camera) = match tied {
            Some((chain, first, r)) => (chain, first * r.camera_to_from_camera_from.inverse()),
            None => {
                chains.push(Vec::new());
                (chains.len() - 1, UnitQuaternion::identity())
            }
        };
        let pose = Isometry3::from_parts(Translation3::identity(), first_from_camera);
        chains[chain].push(StampedPose { t_ns: *t_ns, reference_from_moving: pose });
        known.insert(*t_ns, (chain, first_from_camera));
    }
    chains.retain(|chain| chain.len() > 1);
    chains
}
