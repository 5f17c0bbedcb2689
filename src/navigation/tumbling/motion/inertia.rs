//! The five inertia ratios of a rigid body, and a form of them that is always physical.

use nalgebra::{Matrix3, SMatrix, SVector, SymmetricEigen, Vector3, Vector6};

/// Names of the ratios, in the order used everywhere.
pub const INERTIA_NAMES: [&str; 5] = ["Lxx", "Lyy", "Lxy", "Lxz", "Lyz"];

/// Inertia ratios (Lxx, Lyy, Lxy, Lxz, Lyz) = J / Jzz in asteroid axes, elements of the tensor (products of inertia with
/// their sign in the matrix); Lzz = 1. A torque-free motion shows no more (Deng et al. 2024, equation 13).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InertiaRatios(pub [f64; 5]);

impl InertiaRatios {
    /// A sphere.
    pub const SPHERE: InertiaRatios = InertiaRatios([1.0, 1.0, 0.0, 0.0, 0.0]);

    /// Ratios of an inertia tensor of any scale; `None` if Jzz is not positive.
    pub fn from_tensor(j: &Matrix3<f64>) -> Option<Self> {
        let zz = j[(2, 2)];
        (zz > 0.0)
            .then(|| InertiaRatios([j[(0, 0)] / zz, j[(1, 1)] / zz, j[(0, 1)] / zz, j[(0, 2)] / zz, j[(1, 2)] / zz]))
    }

    /// The tensor L with Lzz = 1.
    pub fn tensor(&self) -> Matrix3<f64> {
        let [xx, yy, xy, xz, yz] = self.0;
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, 1.0)
    }

    /// The ratios as a vector.
    pub fn vector(&self) -> SVector<f64, 5> {
        SVector::from(self.0)
    }

    /// Principal moments over Jzz, smallest first.
    pub fn principal_moments(&self) -> [f64; 3] {
        let mut moments: [f64; 3] = self.tensor().symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        moments
    }

    /// Whether a body of positive mass can have these: positive moments that keep the triangle inequality.
    pub fn is_physical(&self) -> bool {
        let [a, b, c] = self.principal_moments();
        a > 0.0 && a + b >= c
    }
}

/// Derivative of `L v` by the ratios: Ξ(v), 3×5.
pub fn xi(v: &Vector3<f64>) -> SMatrix<f64, 3, 5> {
    SMatrix::<f64, 3, 5>::from_row_slice(&[
        v.x, 0.0, v.y, v.z, 0.0, //
        0.0, v.y, v.x, 0.0, v.z, //
        0.0, 0.0, 0.0, v.x, v.y,
    ])
}

/// Places of the entries of C in [`InertiaShape`].
const LOWER: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];

/// Smallest share of the trace that an eigenvalue of Σ keeps when a tensor is made physical.
const LEAST_SHARE: f64 = 0.01;

/// Smallest diagonal entry of a C of unit norm: a needle 50 times longer than thick.
const LEAST_DIAGONAL: f64 = 0.02;

/// Inertia as Σ = ½ tr(J) I - J = C Cᵀ with C lower triangular: the second moments of mass, so every C is a possible body
/// (positive definite, triangle inequality). The six entries of C have unit norm, which fixes the free scale of J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InertiaShape(Vector6<f64>);

impl InertiaShape {
    /// The shape of a body, or of the nearest possible one.
    pub fn nearest(tensor: &Matrix3<f64>) -> Self {
        let j = if tensor.trace() < 0.0 { -tensor } else { *tensor };
        let sigma = Matrix3::identity() * (0.5 * j.trace()) - j;
        let mut eigen = SymmetricEigen::new(sigma);
        let floor = LEAST_SHARE * eigen.eigenvalues.abs().sum().max(f64::MIN_POSITIVE);
        eigen.eigenvalues.apply(|e| *e = e.max(floor));
        let possible = eigen.recompose();
        let c = possible.cholesky().map_or(Matrix3::identity(), |c| c.l());
        InertiaShape(Vector6::from_fn(|i, _| c[LOWER[i]])).normalized()
    }

    /// The shape moved by `d`, its diagonal positive (the signs of C's columns mean nothing; no body
    /// is a line or a leaf) and its norm 1.
    pub fn moved(&self, d: &Vector6<f64>) -> Self {
        InertiaShape(self.0 + d).normalized()
    }

    /// Entries of C by rows.
    pub fn entries(&self) -> &Vector6<f64> {
        &self.0
    }

    /// The ratios, and their derivative by the entries of C; `None` for a rod along z.
    pub fn ratios(&self) -> Option<(InertiaRatios, SMatrix<f64, 5, 6>)> {
        let c = self.factor();
        let tensor = inertia_of(&(c * c.transpose()));
        let ratios = InertiaRatios::from_tensor(&tensor)?;
        let zz = tensor[(2, 2)];
        let mut by_entries = SMatrix::<f64, 5, 6>::zeros();
        for (column, &(row, col)) in LOWER.iter().enumerate() {
            let mut unit = Matrix3::zeros();
            unit[(row, col)] = 1.0;
            let change = inertia_of(&(unit * c.transpose() + c * unit.transpose()));
            let elements = [change[(0, 0)], change[(1, 1)], change[(0, 1)], change[(0, 2)], change[(1, 2)]];
            let relative = (SVector::<f64, 5>::from(elements) - ratios.vector() * change[(2, 2)]) / zz;
            by_entries.set_column(column, &relative);
        }
        Some((ratios, by_entries))
    }

    fn factor(&self) -> Matrix3<f64> {
        let mut c = Matrix3::zeros();
        for (i, &place) in LOWER.iter().enumerate() {
            c[place] = self.0[i];
        }
        c
    }

    fn normalized(self) -> Self {
        let mut c = self.factor() / self.0.norm();
        for i in 0..3 {
            if c[(i, i)] < 0.0 {
                let flipped = -c.column(i);
                c.set_column(i, &flipped);
            }
            c[(i, i)] = c[(i, i)].max(LEAST_DIAGONAL);
        }
        InertiaShape(Vector6::from_fn(|i, _| c[LOWER[i]]).normalize())
    }
}

/// J = tr(Σ) I - Σ.
fn inertia_of(sigma: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::identity() * sigma.trace() - sigma
}
