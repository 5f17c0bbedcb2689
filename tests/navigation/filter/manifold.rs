//! The laws of [`Manifold`], for every state of the crate that is one.

use super::{stream, white};
use crate::navigation::landing::chart::{Chart, KINDS, state};
use nalgebra::{SVector, UnitQuaternion, Vector3};
use opnav::geometry::Manifold;
use opnav::geometry::so3::{exp, log};
use opnav::navigation::tumbling::{InertiaRatios, PaperState, SpinState};

/// By how much, at most, a state breaks a law within steps of about `size`: `x.plus(0) = x`, `x.plus(y.minus(x)) = y`,
/// `x.plus(d).minus(x) = d`. States are compared by `minus`.
fn violation<S: Manifold<N>, const N: usize>(x: &S, size: f64) -> f64 {
    let mut random = stream(50);
    let mut worst = x.plus(&SVector::zeros()).minus(x).norm();
    for _ in 0..50 {
        let d = white::<N>(&mut random) * size;
        let y = x.plus(&(white::<N>(&mut random) * size));
        worst = worst.max((x.plus(&d).minus(x) - d).norm());
        worst = worst.max(x.plus(&y.minus(x)).minus(&y).norm());
    }
    worst
}

/// A test a state.
macro_rules! keeps_the_laws {
    ($($name:ident: $state:expr, $size:expr;)*) => {$(
        #[test]
        fn $name() {
            let worst = violation(&$state, $size);
            assert!(worst < 1e-9, "{worst}");
        }
    )*};
}

keeps_the_laws! {
    a_vector_is_a_manifold: SVector::<f64, 5>::new(1.0, -2.0, 3.0, 0.0, 1e3), 10.0;
    an_attitude_is_a_manifold: UnitQuaternion::from_euler_angles(0.3, -0.8, 2.9), 0.5;
    a_spin_is_a_manifold: spin(), 0.5;
    the_papers_state_is_a_manifold: PaperState { spin: spin(), inertia: InertiaRatios::SPHERE }, 0.25;
    a_descent_in_hybrid_coordinates_is_a_manifold: Chart(KINDS[0], state()), 0.3;
    a_descent_in_standard_coordinates_is_a_manifold: Chart(KINDS[1], state()), 0.3;
}

fn spin() -> SpinState {
    SpinState {
        asteroid_from_inertial: UnitQuaternion::from_euler_angles(0.1, 1.2, -2.0),
        rate_in_asteroid_rad_s: Vector3::new(0.1, -0.2, 0.3),
    }
}

/// Steps on one side of the rotation, differences on the other: no law holds.
struct Broken(UnitQuaternion<f64>);

impl Manifold<3> for Broken {
    fn plus(&self, d: &Vector3<f64>) -> Self {
        Broken(exp(d) * self.0)
    }
    fn minus(&self, other: &Self) -> Vector3<f64> {
        log(&(other.0.inverse() * self.0))
    }
}

#[test]
fn a_broken_law_is_noticed() {
    assert!(violation(&Broken(UnitQuaternion::from_euler_angles(0.3, -0.8, 2.9)), 0.5) > 0.1);
}
