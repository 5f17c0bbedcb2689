//! The rotations of a sequence in the order of the contract.

use super::image_chain::Chain;
use crate::observations::{PairStatus, RelativeRotation, RotationModel};
use crate::vision::front_end::FrameReport;
use crate::vision::pair::PairSolution;

/// Adjacent images first, those that cannot be used included, by status; then pairs over the gaps that those leave, and
/// keyframe pairs, together in order of time.
pub fn rotations_in_order(
    chain: &Chain,
    reports: &[FrameReport],
    keyframes: Vec<RelativeRotation>,
) -> Vec<RelativeRotation> {
    let mut rotations: Vec<RelativeRotation> = reports.windows(2).map(|w| adjacent(chain, &w[0], &w[1])).collect();
    let place = |k: usize| reports.partition_point(|r| r.index < chain.frames[k].report.index);
    let over_a_gap = (0..chain.pairs.len()).filter(|k| place(*k) + 1 < place(*k + 1));
    let mut others: Vec<RelativeRotation> = over_a_gap.map(|k| linked(chain, k)).chain(keyframes).collect();
    others.sort_by_key(|r| (r.t_ns_from, r.t_ns_to));
    rotations.append(&mut others);
    rotations
}

fn adjacent(chain: &Chain, from: &FrameReport, to: &FrameReport) -> RelativeRotation {
    let place = |report: &FrameReport| chain.frames.binary_search_by_key(&report.index, |f| f.report.index);
    match (place(from), place(to)) {
        (Ok(k), Ok(_)) => linked(chain, k),
        _ => as_relative_rotation((from.t_ns, to.t_ns), 0, &PairSolution::failed(PairStatus::NoFeatures, 0)),
    }
}

/// The rotation of an image and the next usable one.
fn linked(chain: &Chain, k: usize) -> RelativeRotation {
    let times = (chain.frames[k].report.t_ns, chain.frames[k + 1].report.t_ns);
    as_relative_rotation(times, chain.pairs[k].match_count, &chain.pairs[k].solution)
}

/// A pair's solution in the form of the contract.
pub(super) fn as_relative_rotation(
    (t_ns_from, t_ns_to): (i64, i64),
    matches: usize,
    solution: &PairSolution,
) -> RelativeRotation {
    let ok = solution.status == PairStatus::Ok;
    RelativeRotation {
        t_ns_from,
        t_ns_to,
        camera_to_from_camera_from: solution.camera_to_from_camera_from,
        covariance_rad2: solution.covariance_rad2,
        matches,
        inliers: solution.inlier_count(),
        model: if ok { solution.model } else { RotationModel::None },
        status: solution.status,
    }
}
