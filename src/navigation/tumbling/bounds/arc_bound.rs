//! What the best estimator could reach on an arc: the Cramér–Rao bound of pairs of images.

use super::determinacy::{UndeterminedDirection, scaled_units, undetermined_directions};
use crate::navigation::observability::FisherInformation;
use crate::navigation::tumbling::motion::{InertiaRatios, SpinState, TrajectoryPoint, propagate};
use nalgebra::{DMatrix, UnitQuaternion, Vector3};

/// Images at equal steps and the pairs that are matched between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcDesign {
    /// Length of the arc in s.
    pub arc_s: f64,
    /// Time between images in s.
    pub interval_s: f64,
    /// 1σ of a pair's rotation, each axis, in rad.
    pub sigma_rad: f64,
    /// Pairs of each image with its keyframe, up to this turn in rad; `None` for neighbours only.
    pub keyframe_turn_rad: Option<f64>,
    /// Pairs of each image with earlier ones that show the same face again, within this turn in rad; `None` for none.
    pub loop_turn_rad: Option<f64>,
}

/// Numbers of the images of each pair (first, second) of a design, for the attitudes of a motion: neighbours, then
/// keyframes, then loop closures.
pub fn planned_pairs(attitudes: &[UnitQuaternion<f64>], design: &ArcDesign) -> Vec<(usize, usize)> {
    let mut pairs: Vec<(usize, usize)> = (1..attitudes.len()).map(|k| (k - 1, k)).collect();
    if let Some(most_rad) = design.keyframe_turn_rad {
        let mut keyframe = 0;
        for k in 1..attitudes.len() {
            if attitudes[keyframe].angle_to(&attitudes[k]) > most_rad {
                keyframe = k - 1;
            }
            if keyframe + 1 < k {
                pairs.push((keyframe, k));
            }
        }
    }
    if let Some(most_rad) = design.loop_turn_rad {
        pairs.extend(loop_closures(attitudes, most_rad));
    }
    pairs
}

/// For each image and each earlier return of the same face, the closest view of that return.
fn loop_closures(attitudes: &[UnitQuaternion<f64>], most_rad: f64) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    for k in 1..attitudes.len() {
        let turn: Vec<f64> = attitudes[..=k].iter().map(|a| a.angle_to(&attitudes[k])).collect();
        // Images just before k belong to the pass that is still going on.
        let Some(left) = (0..k).rev().find(|&i| turn[i] > most_rad) else { continue };
        for i in 0..left {
            let closest = turn[i] <= turn[i + 1] && (i == 0 || turn[i] < turn[i - 1]);
            if closest && turn[i] <= most_rad {
                pairs.push((i, k));
            }
        }
    }
    pairs
}

/// What an arc can tell.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcBound {
    /// Least 1σ of the initial rate (asteroid axes, rad/s); `None` if something is not determined at all.
    pub rate_sigma_rad_s: Option<[f64; 3]>,
    /// Least 1σ of the inertia ratios.
    pub inertia_sigma: Option<[f64; 5]>,
    /// Eigenvalues of the information, smallest first, in units |ω| and 0.3.
    pub information: Vec<f64>,
    /// Directions of the inertia that the arc does not determine.
    pub undetermined: Vec<UndeterminedDirection>,
    /// Number of pairs.
    pub pairs: usize,
}

/// The Cramér–Rao bound of a motion that starts at the identity with `rate_rad_s` (asteroid axes), observed by `design`;
/// `least_information` as in [`TumblingConfig`](crate::navigation::tumbling::config::TumblingConfig). `None` if the motion cannot be integrated.
pub fn arc_bound(
    rate_rad_s: &Vector3<f64>,
    inertia: &InertiaRatios,
    design: &ArcDesign,
    least_information: f64,
) -> Option<ArcBound> {
    let steps = (design.arc_s / design.interval_s + 1e-9).floor() as usize;
    let times_s: Vec<f64> = (0..=steps).map(|k| k as f64 * design.interval_s).collect();
    let start = SpinState { asteroid_from_inertial: UnitQuaternion::identity(), rate_in_asteroid_rad_s: *rate_rad_s };
    let points = propagate(&start, inertia, &times_s)?;
    let attitudes: Vec<_> = points.iter().map(|p| p.state.asteroid_from_inertial).collect();
    let pairs = planned_pairs(&attitudes, design);
    let information = pair_information(&points, &pairs, design.sigma_rad);
    let scaled = information.in_units(&scaled_units(rate_rad_s.norm()));
    let bound = scaled.weak_directions(least_information * 1e-9).is_empty().then(|| information.cramer_rao_bound());
    let sigma = bound.flatten().map(|b| b.diagonal().map(f64::sqrt));
    Some(ArcBound {
        rate_sigma_rad_s: sigma.as_ref().map(|s| [s[0], s[1], s[2]]),
        inertia_sigma: sigma.as_ref().map(|s| [s[3], s[4], s[5], s[6], s[7]]),
        undetermined: undetermined_directions(&information, rate_rad_s.norm(), least_information),
        information: scaled.eigenvalues(),
        pairs: pairs.len(),
    })
}

fn pair_information(points: &[TrajectoryPoint], pairs: &[(usize, usize)], sigma_rad: f64) -> FisherInformation {
    let mut information = FisherInformation::zero(8);
    for &(from, to) in pairs {
        let (a, b) = (&points[from], &points[to]);
        let predicted = b.state.asteroid_from_inertial.inverse() * a.state.asteroid_from_inertial;
        let moves = predicted.to_rotation_matrix().matrix() * a.sensitivity.fixed_rows::<3>(0)
            - b.sensitivity.fixed_rows::<3>(0);
        information.add_whitened(&DMatrix::from_fn(3, 8, |i, j| moves[(i, j)] / sigma_rad));
    }
    information
}
