//! Tests of the wing `navigation::observability`, on the free body of the wing `tumbling`.

use crate::reference_body::{
    BOUNDS, KnownBound, LAST_SINGULAR_VALUES_OF_ORDER_3, RATIOS, SINGULAR_VALUES, SINGULAR_VALUES_WHEN_TURNED, TURNED,
    from_scalar_last, rate_rad_s,
};
use nalgebra::{DMatrix, UnitQuaternion, Vector3};
use opnav::navigation::observability::{FisherInformation, ObservabilityRank, rank_by_order};
use opnav::navigation::tumbling::{ArcDesign, FreeBody, InertiaRatios, SpinState, arc_bound, lie_derivatives};

fn principal(j: [f64; 3]) -> InertiaRatios {
    InertiaRatios([j[0] / j[2], j[1] / j[2], 0.0, 0.0, 0.0])
}

fn ranks(
    attitude: UnitQuaternion<f64>,
    rate: [f64; 3],
    inertia: &InertiaRatios,
    order: usize,
) -> Vec<ObservabilityRank> {
    let state = SpinState { asteroid_from_inertial: attitude, rate_in_asteroid_rad_s: Vector3::from(rate) };
    rank_by_order(&lie_derivatives(&state, inertia, order).unwrap())
}

fn rank_numbers(rate: [f64; 3], inertia: &InertiaRatios) -> Vec<usize> {
    ranks(UnitQuaternion::identity(), rate, inertia, 4).iter().map(|r| r.rank).collect()
}

/// Ranks of the observability matrix by exact rational arithmetic (Q_k of equation (20), Deng et al. 2024). They follow from
/// the space that the rates span over time: what hides is every symmetric matrix on its complement, 0, 1 or 3 dimensions.
#[test]
fn ranks_by_order_follow_the_exact_ones() {
    let cases: [(&str, [f64; 3], InertiaRatios, [usize; 5]); 9] = [
        ("paper", rate_rad_s().into(), RATIOS, [3, 6, 9, 11, 11]),
        ("axisymmetric with nutation", [0.3, 0.0, 1.0], principal([1.0, 1.0, 1.5]), [3, 6, 9, 11, 11]),
        ("tumbling about the middle axis", [0.01, 1.0, 0.02], principal([1.0, 2.0, 2.5]), [3, 6, 9, 11, 11]),
        ("lamina in its plane", [0.6, 0.8, 0.0], principal([1.0, 2.0, 3.0]), [3, 6, 9, 10, 11]),
        ("separatrix", [0.75, 2.0, 1.0], principal([1.0, 2.0, 2.25]), [3, 6, 9, 10, 10]),
        ("separatrix at the turning point", [0.75, 0.0, 1.0], principal([1.0, 2.0, 2.25]), [3, 6, 9, 10, 10]),
        ("spin about a principal axis", [0.0, 0.04, 0.0], principal([0.85, 1.37, 1.0]), [3, 6, 8, 8, 8]),
        ("sphere", [0.3, -0.2, 0.5], InertiaRatios::SPHERE, [3, 6, 8, 8, 8]),
        ("transverse spin of an axisymmetric body", [0.6, 0.8, 0.0], principal([1.0, 1.0, 1.5]), [3, 6, 8, 8, 8]),
    ];
    for (name, rate, inertia, expected) in cases {
        assert_eq!(rank_numbers(rate, &inertia), expected, "{name}");
    }
}

fn assert_singular_values(found: &ObservabilityRank, first: usize, expected: &[f64]) {
    for (value, found) in expected.iter().zip(&found.singular_values[first..]) {
        assert!((found / value - 1.0).abs() < 2e-9, "{found} is not {value}");
    }
}

#[test]
fn singular_values_of_the_papers_case() {
    let at_identity = ranks(UnitQuaternion::identity(), rate_rad_s().into(), &RATIOS, 4);
    assert_singular_values(&at_identity[4], 0, &SINGULAR_VALUES);
    assert_singular_values(&at_identity[3], 8, &LAST_SINGULAR_VALUES_OF_ORDER_3);
    let q = from_scalar_last(TURNED);
    assert_singular_values(&ranks(q, rate_rad_s().into(), &RATIOS, 4)[4], 0, &SINGULAR_VALUES_WHEN_TURNED);
}

#[test]
fn what_hides_on_the_separatrix_is_along_the_normal_of_the_rates() {
    let inertia = principal([1.0, 2.0, 2.25]);
    let rate = Vector3::new(0.75, 2.0, 1.0);
    let acceleration = FreeBody::new(&inertia).unwrap().acceleration_rad_s2(&rate);
    let n = rate.cross(&acceleration).normalize();
    // Moments may change by nnᵀ unseen; Lzz = 1 is then restored by the scale.
    let hidden = n * n.transpose() - inertia.tensor() * (n.z * n.z);
    let hidden = [hidden[(0, 0)], hidden[(1, 1)], hidden[(0, 1)], hidden[(0, 2)], hidden[(1, 2)]];
    let norm = hidden.iter().map(|h| h * h).sum::<f64>().sqrt();
    let found = &ranks(UnitQuaternion::identity(), rate.into(), &inertia, 4)[4].unobservable;
    assert_eq!(found.ncols(), 1);
    let along: f64 = (0..5).map(|i| found[(6 + i, 0)] * hidden[i] / norm).sum();
    assert!((along.abs() - 1.0).abs() < 1e-9, "{found}");
}

#[test]
fn bounds_of_the_papers_case() {
    for KnownBound { arc_s, rate_deg_s, worst_ratio } in BOUNDS {
        let bound = |keyframe: Option<f64>, revisit: Option<f64>, sigma_deg: f64| {
            let design = ArcDesign {
                arc_s,
                interval_s: 1.0,
                sigma_rad: sigma_deg.to_radians(),
                keyframe_turn_rad: keyframe.map(f64::to_radians),
                loop_turn_rad: revisit.map(f64::to_radians),
            };
            let bound = arc_bound(&rate_rad_s(), &RATIOS, &design, 10.0).unwrap();
            let rate = bound.rate_sigma_rad_s.unwrap().iter().map(|s| s * s).sum::<f64>().sqrt().to_degrees();
            (rate, bound.inertia_sigma.unwrap().into_iter().fold(0.0, f64::max))
        };
        let neighbours = bound(None, None, 0.05);
        assert!((neighbours.0 / rate_deg_s - 1.0).abs() < 1e-4, "T = {arc_s}: {neighbours:?}");
        assert!((neighbours.1 / worst_ratio - 1.0).abs() < 1e-4, "T = {arc_s}: {neighbours:?}");
        let twice = bound(None, None, 0.10);
        assert!((twice.0 / neighbours.0 - 2.0).abs() < 1e-6 && (twice.1 / neighbours.1 - 2.0).abs() < 1e-6);
        let keyframes = bound(Some(30.0), None, 0.05);
        let loops = bound(Some(30.0), Some(25.0), 0.05);
        assert!(keyframes.0 < 0.6 * neighbours.0 && keyframes.1 < 0.6 * neighbours.1, "T = {arc_s}: {keyframes:?}");
        assert!(loops.0 <= keyframes.0 && loops.1 <= keyframes.1, "T = {arc_s}: {loops:?}");
    }
}

#[test]
fn information_is_marginal_over_what_else_is_unknown() {
    let jacobian = DMatrix::from_row_slice(3, 2, &[1.0, 2.0, 0.5, -1.0, 3.0, 0.0]);
    let mut information = FisherInformation::zero(2);
    information.add_whitened(&jacobian);
    let marginal = information.marginal_from(1).unwrap().matrix()[(0, 0)];
    assert!((marginal * information.cramer_rao_bound().unwrap()[(1, 1)] - 1.0).abs() < 1e-12);
    assert!(marginal < information.matrix()[(1, 1)]);
    assert_eq!(FisherInformation::zero(2).cramer_rao_bound(), None);
    let weak = information.in_units(&[1.0, 1e-3]).weak_directions(1.0);
    assert_eq!(weak.len(), 1);
    assert!(weak[0].direction[1].abs() > 0.999);
}
