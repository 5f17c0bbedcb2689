//! Lie derivatives of the attitude of a free body as Taylor coefficients, with their gradients.

use crate::geometry::so3::hat;
use crate::navigation::tumbling::motion::{InertiaRatios, SpinState, xi};
use nalgebra::{DMatrix, Matrix3, Matrix4, SMatrix, Vector3, Vector4};

type Gradient<const R: usize> = SMatrix<f64, R, 11>;

/// Gradients (3×11 each) of the Lie derivatives of order 0 to `highest_order` of the measured quaternion's vector part,
/// for [`rank_by_order`](crate::navigation::observability::rank_by_order). Rows are Taylor coefficients over the power of
/// the rate, `c_k / |ω|^k`; columns are (δq_v, δω / |ω|, δl), all without unit. Source: Deng et al. 2024, equations 15 to
/// 20. `None` at rest, for a singular tensor, and at half a turn, where the vector part is no chart of the rotations.
pub fn lie_derivatives(state: &SpinState, inertia: &InertiaRatios, highest_order: usize) -> Option<Vec<DMatrix<f64>>> {
    let speed = state.rate_in_asteroid_rad_s.norm();
    let tensor = inertia.tensor();
    let inverse = tensor.try_inverse()?;
    if speed == 0.0 || state.asteroid_from_inertial.w == 0.0 {
        return None;
    }
    let mut rate = Series::start_rate(&(state.rate_in_asteroid_rad_s / speed));
    let mut attitude = Series::start_attitude(state);
    for order in 0..highest_order {
        let next = rate.next_rate(order, &tensor, &inverse);
        rate.push(next);
        let next = attitude.next_attitude(order, &rate);
        attitude.push(next);
    }
    let blocks = attitude.gradients.iter().map(|g| DMatrix::from_fn(3, 11, |i, j| g[(i, j)]));
    Some(blocks.collect())
}

/// Taylor coefficients in the time counted in 1/|ω|, and their gradients.
struct Series<const R: usize> {
    values: Vec<SMatrix<f64, R, 1>>,
    gradients: Vec<Gradient<R>>,
}

impl<const R: usize> Series<R> {
    fn push(&mut self, (value, gradient): (SMatrix<f64, R, 1>, Gradient<R>)) {
        self.values.push(value);
        self.gradients.push(gradient);
    }
}

impl Series<3> {
    fn start_rate(rate: &Vector3<f64>) -> Self {
        let mut gradient = Gradient::<3>::zeros();
        gradient.fixed_columns_mut::<3>(3).fill_with_identity();
        Series { values: vec![*rate], gradients: vec![gradient] }
    }

    /// `(n+1) L ω_{n+1} = -Σ ω_i × L ω_{n-i}`.
    fn next_rate(&self, order: usize, tensor: &Matrix3<f64>, inverse: &Matrix3<f64>) -> (Vector3<f64>, Gradient<3>) {
        let factor = 1.0 / (order + 1) as f64;
        let mut momentum = Vector3::zeros();
        let mut gradient = Gradient::<3>::zeros();
        for i in 0..=order {
            let (w, v) = (self.values[i], self.values[order - i]);
            momentum -= w.cross(&(tensor * v)) * factor;
            let mut momentum_gradient = tensor * self.gradients[order - i];
            add_inertia_columns(&mut momentum_gradient, &xi(&v));
            gradient -= (hat(&w) * momentum_gradient - hat(&(tensor * v)) * self.gradients[i]) * factor;
        }
        let value = inverse * momentum;
        add_inertia_columns(&mut gradient, &-xi(&value));
        (value, inverse * gradient)
    }
}

impl Series<4> {
    /// Shuster's quaternion, scalar last, the scalar following from the vector part by the unit norm.
    fn start_attitude(state: &SpinState) -> Self {
        let h = state.asteroid_from_inertial.quaternion();
        let q = Vector4::new(-h.i, -h.j, -h.k, h.w);
        let mut gradient = Gradient::<4>::zeros();
        for i in 0..3 {
            gradient[(i, i)] = 1.0;
            gradient[(3, i)] = -q[i] / q.w;
        }
        Series { values: vec![q], gradients: vec![gradient] }
    }

    /// `(n+1) q_{n+1} = ½ Σ [ω_i; 0] ⊗ q_{n-i}` (equation 11).
    fn next_attitude(&self, order: usize, rate: &Series<3>) -> (Vector4<f64>, Gradient<4>) {
        let factor = 0.5 / (order + 1) as f64;
        let mut value = Vector4::zeros();
        let mut gradient = Gradient::<4>::zeros();
        for i in 0..=order {
            let by_rate = rate_matrix(&rate.values[i]);
            value += by_rate * self.values[order - i] * factor;
            gradient += by_rate * self.gradients[order - i] * factor;
            for column in 0..11 {
                let change: Vector3<f64> = rate.gradients[i].column(column).into_owned();
                let sum = gradient.column(column) + rate_matrix(&change) * self.values[order - i] * factor;
                gradient.set_column(column, &sum);
            }
        }
        (value, gradient)
    }
}

/// The matrix of `[w; 0] ⊗` on Shuster's quaternions (equation 11).
fn rate_matrix(w: &Vector3<f64>) -> Matrix4<f64> {
    Matrix4::new(
        0.0, w.z, -w.y, w.x, //
        -w.z, 0.0, w.x, w.y, //
        w.y, -w.x, 0.0, w.z, //
        -w.x, -w.y, -w.z, 0.0,
    )
}

fn add_inertia_columns(gradient: &mut Gradient<3>, by_inertia: &SMatrix<f64, 3, 5>) {
    let mut columns = gradient.fixed_columns_mut::<5>(6);
    columns += by_inertia;
}
