//! The two-view models: general motion, a plane, a pure rotation, and a body that turns about a fixed centre.
//!
//! A point `x` in the first camera is `R x + t` in the second. Rotations move as `exp(d) R`, `d` in the second camera's
//! axes.

use super::residual::{PairModel, Relation};
use crate::geometry::so3::{exp, hat, tangent_basis};
use nalgebra::{Matrix3, SVector, Unit, UnitQuaternion, Vector2, Vector3};

fn axis(j: usize) -> Vector3<f64> {
    Vector3::ith(j, 1.0)
}

fn moved_direction(direction: &Unit<Vector3<f64>>, step: &Vector2<f64>) -> Unit<Vector3<f64>> {
    Unit::new_normalize(direction.into_inner() + tangent_basis(direction) * step)
}

/// General motion, `E = [t]× R`: rotation (3) and direction of translation (2). Longuet-Higgins 1981.
#[derive(Debug, Clone, Copy)]
pub(super) struct General {
    pub(super) rotation: UnitQuaternion<f64>,
    pub(super) direction: Unit<Vector3<f64>>,
}

impl PairModel<5> for General {
    const RELATION: Relation = Relation::Epipolar;

    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; 5]) {
        let r = self.rotation.to_rotation_matrix().into_inner();
        let t = hat(&self.direction);
        let basis = tangent_basis(&self.direction);
        let derivative = |j: usize| {
            if j < 3 { t * hat(&axis(j)) * r } else { hat(&basis.column(j - 3).into_owned()) * r }
        };
        (t * r, std::array::from_fn(derivative))
    }

    fn moved(&self, step: &SVector<f64, 5>) -> Self {
        General {
            rotation: exp(&step.fixed_rows::<3>(0).into_owned()) * self.rotation,
            direction: moved_direction(&self.direction, &step.fixed_rows::<2>(3).into_owned()),
        }
    }
}

/// A plane, `H = R + m nᵀ`: rotation (3), translation over the plane's distance (3), the plane's normal in the first
/// camera (2). Faugeras and Lustman 1988.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub(super) rotation: UnitQuaternion<f64>,
    pub(super) translation: Vector3<f64>,
    pub(super) normal: Unit<Vector3<f64>>,
}

impl PairModel<8> for Plane {
    const RELATION: Relation = Relation::Transfer;

    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; 8]) {
        let r = self.rotation.to_rotation_matrix().into_inner();
        let basis = tangent_basis(&self.normal);
        let derivative = |j: usize| match j {
            0..3 => hat(&axis(j)) * r,
            3..6 => axis(j - 3) * self.normal.transpose(),
            _ => self.translation * basis.column(j - 6).transpose(),
        };
        (r + self.translation * self.normal.transpose(), std::array::from_fn(derivative))
    }

    fn moved(&self, step: &SVector<f64, 8>) -> Self {
        Plane {
            rotation: exp(&step.fixed_rows::<3>(0).into_owned()) * self.rotation,
            translation: self.translation + step.fixed_rows::<3>(3),
            normal: moved_direction(&self.normal, &step.fixed_rows::<2>(6).into_owned()),
        }
    }
}

/// A plane whose normal is taken as known: rotation (3) and translation over the plane's distance (3).
#[derive(Debug, Clone, Copy)]
pub(super) struct KnownPlane(pub(super) Plane);

impl PairModel<6> for KnownPlane {
    const RELATION: Relation = Relation::Transfer;

    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; 6]) {
        let (matrix, all) = self.0.matrix();
        (matrix, std::array::from_fn(|j| all[j]))
    }

    fn moved(&self, step: &SVector<f64, 6>) -> Self {
        KnownPlane(self.0.moved(&step.fixed_resize::<8, 1>(0.0)))
    }
}

/// A pure rotation (3).
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn(pub(super) UnitQuaternion<f64>);

impl PairModel<3> for Turn {
    const RELATION: Relation = Relation::Transfer;

    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; 3]) {
        let r = self.0.to_rotation_matrix().into_inner();
        (r, std::array::from_fn(|j| hat(&axis(j)) * r))
    }

    fn moved(&self, step: &SVector<f64, 3>) -> Self {
        Turn(exp(step) * self.0)
    }
}

/// A body that turns about a centre in direction `T` of the camera: `t = (I - R) T`, `E = [(I - R) T]× R`, rotation (3);
/// the scale cancels.
#[derive(Debug, Clone, Copy)]
pub(super) struct AboutCenter {
    pub(super) rotation: UnitQuaternion<f64>,
    pub(super) center: Unit<Vector3<f64>>,
}

impl AboutCenter {
    /// Translation in units of the centre's distance.
    pub(super) fn translation(&self) -> Vector3<f64> {
        self.center.into_inner() - self.rotation * self.center.into_inner()
    }
}

impl PairModel<3> for AboutCenter {
    const RELATION: Relation = Relation::Epipolar;

    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; 3]) {
        let (matrix, all) = WithCenter(*self).matrix();
        (matrix, std::array::from_fn(|j| all[j]))
    }

    fn moved(&self, step: &SVector<f64, 3>) -> Self {
        AboutCenter { rotation: exp(step) * self.rotation, center: self.center }
    }
}

/// [`AboutCenter`] with the centre's direction free as well: rotation (3), direction (2).
#[derive(Debug, Clone, Copy)]
pub(super) struct WithCenter(pub(super) AboutCenter);

impl PairModel<5> for WithCenter {
    const RELATION: Relation = Relation::Epipolar;

    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; 5]) {
        let AboutCenter { rotation, center } = self.0;
        let r = rotation.to_rotation_matrix().into_inner();
        let t = hat(&self.0.translation());
        let turned = rotation * center.into_inner();
        let basis = tangent_basis(&center);
        let derivative = |j: usize| {
            if j < 3 {
                let e = axis(j);
                hat(&-e.cross(&turned)) * r + t * hat(&e) * r
            } else {
                let b = basis.column(j - 3).into_owned();
                hat(&(b - r * b)) * r
            }
        };
        (t * r, std::array::from_fn(derivative))
    }

    fn moved(&self, step: &SVector<f64, 5>) -> Self {
        let rotation = exp(&step.fixed_rows::<3>(0).into_owned()) * self.0.rotation;
        let center = moved_direction(&self.0.center, &step.fixed_rows::<2>(3).into_owned());
        WithCenter(AboutCenter { rotation, center })
    }
}
