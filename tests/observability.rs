//! Tests of the room `observability`.
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use opnav::navigation::observability::{ObservabilityRank, rank_by_order};
use opnav::navigation::tumbling::{InertiaRatios, SpinState, lie_derivatives};

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

#[test]
fn singular_values_of_the_papers_case() {
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
    let found = ranks(UnitQuaternion::identity(), paper_rate(), &PAPER, 4);
    for (i, &value) in expected.iter().enumerate() {
        println!("{value} {}", found[4].singular_values[i]);
    }
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
    let found = ranks(q, paper_rate(), &PAPER, 4);
    for (i, &value) in expected.iter().enumerate() {
        println!("{value} {}", found[4].singular_values[i]);
    }
}
