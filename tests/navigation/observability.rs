//! Tests of the room `observability`, on the free body of the room `tumbling`.

use nalgebra::{DMatrix, Quaternion, UnitQuaternion, Vector3};
use opnav::navigation::observability::{FisherInformation, ObservabilityRank, rank_by_order};
use opnav::navigation::tumbling::{ArcDesign, FreeBody, InertiaRatios, SpinState, arc_bound, lie_derivatives};

const PAPER: InertiaRatios = InertiaRatios([0.85, 1.37, 0.13, 0.17, -0.11]);

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

fn paper_rate() -> [f64; 3] {
    [5.0_f64.to_radians(), 2.3_f64.to_radians(), 3.5_f64.to_radians()]
}

#[test]
fn ranks_by_order_follow_the_exact_ones() {
    let cases: [(&str, [f64; 3], InertiaRatios, [usize; 5]); 9] = [
        ("paper", paper_rate(), PAPER, [3, 6, 9, 11, 11]),
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
    let at_identity = ranks(UnitQuaternion::identity(), paper_rate(), &PAPER, 4);
    let expected = [
        1.153880927,
        1.150140876,
        1.008764957,
        0.5176927282,
        0.4508358405,
        0.4419192279,
        0.2944349703,
        0.1323276688,
        0.0211379186,
        0.01407170818,
        8.891680583e-4,
    ];
    assert_singular_values(&at_identity[4], 0, &expected);
    assert_singular_values(&at_identity[3], 8, &[0.02024346282, 0.01371649164, 4.835448174e-4]);
    // Shuster's (1, 2, 2, 4)/5, scalar last.
    let q = UnitQuaternion::from_quaternion(Quaternion::new(4.0, -1.0, -2.0, -2.0));
    let expected = [
        1.177706363,
        1.149725144,
        1.056739881,
        0.495179156,
        0.4349874019,
        0.4032570396,
        0.2721611539,
        0.1282449485,
        0.02060594552,
        0.0135287325,
        8.933485177e-4,
    ];
    assert_singular_values(&ranks(q, paper_rate(), &PAPER, 4)[4], 0, &expected);
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
    let table = [(60.0, 0.028, 0.048), (120.0, 0.0123, 0.0064), (300.0, 0.0082, 0.0037), (600.0, 0.0059, 0.0024)];
    for (arc_s, rate_deg_s, ratio) in table {
        let bound = |keyframe: Option<f64>, revisit: Option<f64>, sigma_deg: f64| {
            let design = ArcDesign {
                arc_s,
                interval_s: 1.0,
                sigma_rad: sigma_deg.to_radians(),
                keyframe_turn_rad: keyframe.map(f64::to_radians),
                loop_turn_rad: revisit.map(f64::to_radians),
            };
            let bound = arc_bound(&Vector3::from(paper_rate()), &PAPER, &design, 10.0).unwrap();
            let rate = bound.rate_sigma_rad_s.unwrap().iter().map(|s| s * s).sum::<f64>().sqrt().to_degrees();
            (rate, bound.inertia_sigma.unwrap().into_iter().fold(0.0, f64::max))
        };
        let neighbours = bound(None, None, 0.05);
        assert!((neighbours.0 / rate_deg_s - 1.0).abs() < 0.02, "T = {arc_s}: {neighbours:?}");
        assert!((neighbours.1 / ratio - 1.0).abs() < 0.02, "T = {arc_s}: {neighbours:?}");
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
