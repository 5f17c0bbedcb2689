//! What a fit is not left to itself in: a nutation that is only noise, and directions that the images do not show.

use super::fit::{Fit, FitProblem};
use super::initial::Guess;
use crate::navigation::observability::FisherInformation;
use crate::navigation::tumbling::bounds::{INERTIA_UNIT, UndeterminedDirection, projector, undetermined_directions};
use crate::navigation::tumbling::config::TumblingConfig;
use crate::navigation::tumbling::motion::InertiaShape;
use crate::navigation::tumbling::pair::RotationPair;
use nalgebra::{DMatrix, Matrix3, SMatrix};

/// Weak information that keeps the ratios within reason while the arc is short: 1σ of 1.
pub(super) const SHORT_ARC_PRIOR: f64 = 1.0;

/// Directions with less than this many times the least information are held loosely.
const LOOSE_MARGIN: f64 = 10.0;

/// Information that ties the ratios to a sphere's, so that the motion is a pure spin.
const SPHERE_PRIOR: f64 = 1e12;

/// Drop of χ² that a tumble must bring over a pure spin to be believed: its five more unknowns bring 5 by noise alone,
/// and 30 once in 70 000 times.
const NUTATION_SIGNIFICANCE: f64 = 30.0;

/// A pure spin if that explains the pairs as well: a fit that follows noise into a small nutation would find inertia in
/// it that the images do not show.
pub(super) fn simplest_motion(pairs: &[RotationPair], times_s: &[f64], tumble: Fit) -> Fit {
    let free = SMatrix::zeros();
    let as_sphere = SMatrix::identity() * SPHERE_PRIOR;
    let problem = FitProblem { pairs, times_s, huber: f64::INFINITY, prior: &as_sphere };
    let sphere = Guess { rate_rad_s: tumble.guess.rate_rad_s, shape: InertiaShape::nearest(&Matrix3::identity()) };
    let Some(spin) = problem.solve(&sphere) else { return tumble };
    let Some(tumble_again) = (FitProblem { prior: &free, ..problem }).start(&tumble.guess) else { return tumble };
    let variance_factor = (2.0 * tumble_again.cost / (3 * pairs.len()) as f64).max(1.0);
    if 2.0 * (spin.cost - tumble_again.cost) < NUTATION_SIGNIFICANCE * variance_factor { spin } else { tumble }
}

/// Directions of the ratios that a fit is not left to itself in.
pub(super) struct HeldDirections {
    /// Held as a guess would be, 1σ of 0.3, and reported without a number.
    pub undetermined: Vec<UndeterminedDirection>,
    /// Determined, but so little that the fit could run off along them: held with 1σ of 1.
    loose: Vec<UndeterminedDirection>,
}

impl HeldDirections {
    pub fn of(fit: &Fit, config: &TumblingConfig) -> Self {
        let loose = weak_directions(fit, LOOSE_MARGIN * config.least_information);
        let (undetermined, loose) = loose.into_iter().partition(|w| w.information < config.least_information);
        HeldDirections { undetermined, loose }
    }

    /// Undetermined directions first.
    pub fn count(&self) -> (usize, usize) {
        (self.undetermined.len(), self.undetermined.len() + self.loose.len())
    }

    pub fn prior(&self) -> SMatrix<f64, 5, 5> {
        projector(&self.undetermined) / INERTIA_UNIT.powi(2) + projector(&self.loose) * SHORT_ARC_PRIOR
    }
}

pub(super) fn weak_directions(fit: &Fit, least_information: f64) -> Vec<UndeterminedDirection> {
    let information = DMatrix::from_fn(8, 8, |i, j| fit.information[(i, j)]);
    let speed = fit.guess.rate_rad_s.norm();
    undetermined_directions(&FisherInformation::from_matrix(information), speed, least_information)
}
