//! First guess of the motion in closed form, without differentiating anything.

use crate::geometry::so3::{exp, log};
use crate::navigation::tumbling::motion::{FreeBody, InertiaShape};
use crate::navigation::tumbling::pair::RotationPair;
use crate::stats::upper_median;
use nalgebra::{Matrix3, SMatrix, SymmetricEigen, UnitQuaternion, Vector3};

/// Pairs that span more images than this are not taken as a rate: their rotation may exceed half a turn.
const LONGEST_SPAN: usize = 5;

/// A rate that leaves the median of its neighbours by more than this share of it is replaced by the median.
const RATE_GATE: f64 = 0.35;

/// A guess of the unknowns.
#[derive(Debug, Clone, Copy)]
pub struct Guess {
    pub rate_rad_s: Vector3<f64>,
    pub shape: InertiaShape,
}

/// Guesses of the motion over the images at `times_s`: the closed form, then a sphere; none if no interval has a pair.
pub(super) fn initial_guesses(pairs: &[RotationPair], times_s: &[f64]) -> Vec<Guess> {
    let Some(rates) = interval_rates(pairs, times_s) else { return Vec::new() };
    let (midpoint_attitudes, midpoint_rates) = chained_midpoints(&rates, times_s);
    let tensor = inertia_from_momentum(&midpoint_attitudes, &midpoint_rates);
    let half_first_s = 0.5 * (times_s[1] - times_s[0]);
    [tensor, Matrix3::identity()]
        .iter()
        .map(|tensor| {
            let shape = InertiaShape::nearest(tensor);
            let body = shape.ratios().and_then(|(ratios, _)| FreeBody::new(&ratios));
            let slope = body.map_or(Vector3::zeros(), |b| b.acceleration_rad_s2(&midpoint_rates[0]));
            Guess { rate_rad_s: midpoint_rates[0] - slope * half_first_s, shape }
        })
        .collect()
}

/// Rate in inertial axes over each interval between images, from the shortest pair that covers it, gated against its
/// neighbours; intervals without a pair take their neighbours' median.
fn interval_rates(pairs: &[RotationPair], times_s: &[f64]) -> Option<Vec<Vector3<f64>>> {
    let intervals = times_s.len() - 1;
    let mut shortest: Vec<Option<&RotationPair>> = vec![None; intervals];
    for pair in pairs.iter().filter(|p| p.to <= intervals && p.to - p.from <= LONGEST_SPAN) {
        for slot in &mut shortest[pair.from..pair.to] {
            if slot.is_none_or(|s| s.to - s.from > pair.to - pair.from) {
                *slot = Some(pair);
            }
        }
    }
    // The body turns by exp(ω dt) in inertial axes, and so does the pair's rotation.
    let raw: Vec<Option<Vector3<f64>>> =
        shortest.iter().map(|s| s.map(|p| log(&p.measured) / (times_s[p.to] - times_s[p.from]))).collect();
    (0..intervals).map(|k| gated_rate(&raw, k)).collect()
}

fn gated_rate(raw: &[Option<Vector3<f64>>], k: usize) -> Option<Vector3<f64>> {
    let mut reach = 2;
    let neighbours: Vec<Vector3<f64>> = loop {
        let found: Vec<_> =
            raw[k.saturating_sub(reach)..(k + reach + 1).min(raw.len())].iter().flatten().copied().collect();
        if found.len() >= 3 || reach > raw.len() {
            break found;
        }
        reach += 1;
    };
    let median = median_vector(&neighbours)?;
    match raw[k] {
        Some(rate) if (rate - median).norm() <= RATE_GATE * median.norm() => Some(rate),
        _ => Some(median),
    }
}

fn median_vector(vectors: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let along = |axis: usize| upper_median(&mut vectors.iter().map(|v| v[axis]).collect::<Vec<f64>>());
    Some(Vector3::new(along(0)?, along(1)?, along(2)?))
}

/// Attitudes and rates (asteroid axes) at the middle of the intervals: `A_k = A_{k-1} R_Δkᵀ`.
fn chained_midpoints(
    rates_in_inertial: &[Vector3<f64>],
    times_s: &[f64],
) -> (Vec<UnitQuaternion<f64>>, Vec<Vector3<f64>>) {
    let mut asteroid_from_inertial = UnitQuaternion::identity();
    let mut attitudes = Vec::with_capacity(rates_in_inertial.len());
    for (k, rate) in rates_in_inertial.iter().enumerate() {
        let half_turn_back = exp(&(rate * (-0.5 * (times_s[k + 1] - times_s[k]))));
        attitudes.push(asteroid_from_inertial * half_turn_back);
        asteroid_from_inertial = asteroid_from_inertial * half_turn_back * half_turn_back;
    }
    let rates = attitudes.iter().zip(rates_in_inertial).map(|(a, w)| a * w).collect();
    (attitudes, rates)
}

/// The inertia tensor (any scale) from `L ω_k = A_k h`: the angular momentum h is constant in inertial axes. Nine
/// homogeneous unknowns; the vector that the equations contradict least.
fn inertia_from_momentum(attitudes: &[UnitQuaternion<f64>], rates: &[Vector3<f64>]) -> Matrix3<f64> {
    let scale = rates.iter().map(Vector3::norm).sum::<f64>() / rates.len() as f64;
    let mut normal = SMatrix::<f64, 9, 9>::zeros();
    for (attitude, rate) in attitudes.iter().zip(rates) {
        let w = rate / scale;
        let mut row = SMatrix::<f64, 3, 9>::zeros();
        // Elements (xx, yy, zz, xy, xz, yz), then h.
        row.fixed_columns_mut::<6>(0).copy_from(&SMatrix::<f64, 3, 6>::from_row_slice(&[
            w.x, 0.0, 0.0, w.y, w.z, 0.0, //
            0.0, w.y, 0.0, w.x, 0.0, w.z, //
            0.0, 0.0, w.z, 0.0, w.x, w.y,
        ]));
        row.fixed_columns_mut::<3>(6).copy_from(&(attitude.to_rotation_matrix().matrix() * -1.0));
        normal += row.transpose() * row;
    }
    let eigen = SymmetricEigen::new(normal);
    let x = eigen.eigenvectors.column(eigen.eigenvalues.imin());
    Matrix3::new(x[0], x[3], x[4], x[3], x[1], x[5], x[4], x[5], x[2])
}
