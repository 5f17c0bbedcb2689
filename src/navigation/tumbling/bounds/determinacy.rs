//! Which directions of the inertia an arc determines.

use crate::navigation::observability::{FisherInformation, WeakDirection};
use crate::navigation::tumbling::motion::INERTIA_NAMES;
use nalgebra::{DMatrix, SMatrix, SVector};

/// Inertia ratios are counted in this unit when directions are compared: what a guess without data would be wrong by.
pub const INERTIA_UNIT: f64 = 0.3;

/// Share of an element that may lie in undetermined directions before the element itself counts as undetermined.
const MOST_SHARE: f64 = 0.01;

/// A direction of the inertia ratios of which the data say nothing useful; there is no number for it.
#[derive(Debug, Clone, PartialEq)]
pub struct UndeterminedDirection {
    /// The direction in words, such as `+0.71 Lxx +0.71 Lyy`.
    pub name: String,
    /// Unit vector over (Lxx, Lyy, Lxy, Lxz, Lyz).
    pub direction: [f64; 5],
    /// Information along it in units of 0.3⁻².
    pub information: f64,
}

/// Directions of the ratios with less than `least_information` in units |ω| and 0.3, the rate being unknown too.
pub fn undetermined_directions(
    information: &FisherInformation,
    speed_rad_s: f64,
    least_information: f64,
) -> Vec<UndeterminedDirection> {
    let marginal = information.in_units(&scaled_units(speed_rad_s)).marginal_from(3);
    name_all(marginal.unwrap_or_else(|| FisherInformation::zero(5)).weak_directions(least_information))
}

/// Directions of the ratios with less than `least_information`, from their information in units of 0.3⁻².
pub fn weak_ratios(information: &SMatrix<f64, 5, 5>, least_information: f64) -> Vec<UndeterminedDirection> {
    let matrix = DMatrix::from_fn(5, 5, |i, j| information[(i, j)]);
    name_all(FisherInformation::from_matrix(matrix).weak_directions(least_information))
}

fn name_all(weak: Vec<WeakDirection>) -> Vec<UndeterminedDirection> {
    weak.into_iter()
        .map(|w| {
            let direction: [f64; 5] = std::array::from_fn(|i| w.direction[i]);
            UndeterminedDirection { name: name_of(&direction), direction, information: w.information }
        })
        .collect()
}

/// The projector on the undetermined directions.
pub fn projector(undetermined: &[UndeterminedDirection]) -> SMatrix<f64, 5, 5> {
    let mut sum = SMatrix::zeros();
    for u in undetermined {
        let v = SVector::<f64, 5>::from(u.direction);
        sum += v * v.transpose();
    }
    sum
}

/// Which elements keep clear of the undetermined directions.
pub fn determined_elements(undetermined: &[UndeterminedDirection]) -> [bool; 5] {
    let p = projector(undetermined);
    std::array::from_fn(|i| p[(i, i)] < MOST_SHARE)
}

fn name_of(direction: &[f64; 5]) -> String {
    let largest = direction.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
    let parts: Vec<String> = direction
        .iter()
        .zip(INERTIA_NAMES)
        .filter(|(c, _)| c.abs() > 0.1)
        .map(|(c, name)| format!("{:+.2} {name}", c * largest.signum()))
        .collect();
    parts.join(" ")
}

/// |ω| for the rate and 0.3 for the ratios.
pub(super) fn scaled_units(speed_rad_s: f64) -> [f64; 8] {
    let mut units = [INERTIA_UNIT; 8];
    units[..3].fill(speed_rad_s);
    units
}
