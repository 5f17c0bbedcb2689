//! The rotations of a sequence in the order of the contract.

use super::front_end::FrameReport;
use super::sequence::{Chain, as_relative_rotation, linked};
use super::{PairSolution, PairStatus, RelativeRotation};

/// Adjacent pictures first, those that cannot be used included, by status; then pairs over the gaps that those leave, and
/// keyframe pairs, together in order of time.
pub(super) fn rotations_in_order(
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
