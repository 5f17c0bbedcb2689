//! The tumbling body of Deng et al. (2024), and numbers about it that come from outside of this code.
//!
//! The case is that of section 4 of R. R. Deng, D. Y. Wang, D. M. Ge et al., "Estimation of motion state of small celestial
//! bodies based on system observability analysis", Journal of Deep Space Exploration 11(6), 570-577 (2024). The paper
//! prints the case and its equations, but no values of them. The values here were computed from the equations twice, by
//! programs that share nothing with this code or with each other; each constant names its equation and the methods.

use nalgebra::{Matrix3, Quaternion, SMatrix, UnitQuaternion, Vector3};
use opnav::navigation::tumbling::InertiaRatios;

/// The inertia matrix of section 4, over its Lzz.
pub const RATIOS: InertiaRatios = InertiaRatios([0.85, 1.37, 0.13, 0.17, -0.11]);

/// The same as a matrix, as the paper prints it.
pub fn tensor() -> Matrix3<f64> {
    Matrix3::new(0.85, 0.13, 0.17, 0.13, 1.37, -0.11, 0.17, -0.11, 1.0)
}

/// The initial rate of section 4, in asteroid axes. The asteroid's axes are the camera's at the start.
pub fn rate_rad_s() -> Vector3<f64> {
    Vector3::new(5.0, 2.3, 3.5).map(f64::to_radians)
}

/// Equation (14), `-L⁻¹ (ω × L ω)` in rad/s²: by exact rational arithmetic, and in double precision by Cramer's rule.
pub fn acceleration_rad_s2() -> Vector3<f64> {
    Vector3::new(1.217511829e-3, 2.93714897e-4, -1.773544285e-3)
}

/// M of equation (24), the derivative of equation (14) by the rate, in 1/s: by exact rational arithmetic, and by complex
/// steps through equation (14).
pub fn acceleration_by_rate() -> Matrix3<f64> {
    Matrix3::from_row_slice(
        &[
            [0.005038761047, 0.028564731271, 0.013892540408],
            [0.021810000755, -0.018034745273, -0.009689383329],
            [-0.035301389804, -0.031396608872, 0.012995984226],
        ]
        .concat(),
    )
}

/// N of equation (24), the derivative of equation (14) by (Lxx, Lyy, Lxy, Lxz, Lyz), in rad/s²: as M.
pub fn acceleration_by_ratios() -> SMatrix<f64, 3, 5> {
    SMatrix::from_row_slice(
        &[
            [-0.001579831847, 0.003879219443, 0.008116078247, -0.00295674056, 0.00318858645],
            [-0.003468990953, -0.000924880967, -0.004077608013, 0.003284006074, 0.003081084495],
            [0.003390082737, -0.004264304539, -0.007832279528, 0.002098544964, -0.005827660146],
        ]
        .concat(),
    )
}

/// Eigenvalues of the inertia matrix: the roots of its characteristic polynomial, by bisection.
pub const PRINCIPAL_MOMENTS: [f64; 3] = [0.696715583, 1.109482306, 1.413802111];

/// Where the motion is at one time, from the identity at the start.
pub struct KnownState {
    pub t_s: f64,
    /// As the paper writes it: scalar last, passive.
    pub scalar_last: [f64; 4],
    pub rate_in_asteroid_deg_s: [f64; 3],
}

impl KnownState {
    pub fn asteroid_from_inertial(&self) -> UnitQuaternion<f64> {
        from_scalar_last(self.scalar_last)
    }

    pub fn rate_in_asteroid_rad_s(&self) -> Vector3<f64> {
        Vector3::from(self.rate_in_asteroid_deg_s).map(f64::to_radians)
    }
}

/// Equations (11) and (14) integrated: by Taylor series of order 20 in steps of 1 s, and by the classical fourth-order
/// Runge-Kutta method at 1/40 s. The two agree to 1e-11.
pub const STATES: [KnownState; 2] = [
    KnownState {
        t_s: 60.0,
        scalar_last: [0.649734687738, -0.32839425578, -0.348376965468, 0.590453671554],
        rate_in_asteroid_deg_s: [0.519253989963, 2.152258543697, -6.26030457059],
    },
    KnownState {
        t_s: 600.0,
        scalar_last: [-0.025368477055, 0.097716333999, -0.180070744049, 0.978459240633],
        rate_in_asteroid_deg_s: [1.629255771355, 3.64362201528, 5.21732795192],
    },
];

/// Deng et al. write attitudes as q = [q_v, q_4], scalar last, with the passive matrix of equation (10),
/// A(q) = (2 q_4² - 1) I + 2 q_v q_vᵀ - 2 q_4 [q_v×]: the active Hamilton quaternion of A is (q_4, -q_v).
pub fn from_scalar_last(q: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(q[3], -q[0], -q[1], -q[2]))
}

/// Singular values of Q_4, equation (20) with the Lie derivatives of equation (19), at q = (0, 0, 0, 1); rows as Taylor
/// coefficients over powers of |ω|, columns (δq_v, δω/|ω|, δl). By power series with 60 digits, and in double precision by
/// complex steps through the power series of equations (11) and (14) with Jacobi's one-sided rotations.
pub const SINGULAR_VALUES: [f64; 11] = [
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

/// The last three of Q_3, by the same methods: full rank is reached one order before equation (21) claims it.
pub const LAST_SINGULAR_VALUES_OF_ORDER_3: [f64; 3] = [0.02024346282, 0.01371649164, 4.835448174e-4];

/// Another attitude, scalar last.
pub const TURNED: [f64; 4] = [0.2, 0.4, 0.4, 0.8];

/// Singular values of Q_4 there, by the same methods.
pub const SINGULAR_VALUES_WHEN_TURNED: [f64; 11] = [
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

/// The Cramér-Rao bound of an arc of pairs of neighbours, one a second, each with 0.05° (1σ, each axis).
pub struct KnownBound {
    pub arc_s: f64,
    /// Root of the summed variances of the initial rate.
    pub rate_deg_s: f64,
    /// 1σ of the worst inertia ratio.
    pub worst_ratio: f64,
}

/// The inverse of the information of (ω₀, l) in the relative rotations A_kᵀ A_{k-1} of equation (9), the start's attitude
/// known: by central differences of motions from the Runge-Kutta method at 1/8 s; an earlier simulation gave the same to
/// two or three digits.
pub const BOUNDS: [KnownBound; 4] = [
    KnownBound { arc_s: 60.0, rate_deg_s: 0.027637, worst_ratio: 0.048431 },
    KnownBound { arc_s: 120.0, rate_deg_s: 0.012283, worst_ratio: 0.0063669 },
    KnownBound { arc_s: 300.0, rate_deg_s: 0.0081459, worst_ratio: 0.0036676 },
    KnownBound { arc_s: 600.0, rate_deg_s: 0.0058652, worst_ratio: 0.0024214 },
];
