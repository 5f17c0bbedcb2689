//! The constants of pairs: how large smooth errors truly are, and how much of them residuals show.
//!
//! The coefficients of a pair's true errors, divided by the noise, have the variance `S + b`: `b` is the share of white noise
//! (known), `S(v) = S₀ (1 + g v / (1 + v/f))` the truth. `S₀`, `g`, `f` minimise `Σ |ln q − ln(S(v) + b) − ln m|`, `q` the
//! mean square of a pair's coefficients and `m` the median of χ²₂₀ over 20: a median regression. The expected share is
//! `S₀ / o`, and `o`, the truth over what residuals show, is where the median of the rotations' normalised squared errors
//! is that of χ²₃; both enter the covariance of a pair's rotation, which is solved again for each `o`.

use super::components::{intervals, median};
use super::matches::{SmoothError, TruePair};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use opnav::geometry::{Camera, so3};
use opnav::observations::{PairStatus, RotationModel};
use opnav::vision::*;
use rayon::prelude::*;

/// Median of χ² with three degrees of freedom.
pub const MEDIAN_3: f64 = 2.365_974;
/// Median of χ² with twenty degrees of freedom, over twenty.
const MEDIAN_20: f64 = 0.966_835;
/// Truth over what residuals show, at which pairs are solved.
const GRID: [f64; 4] = [1.0, 2.2, 5.0, 11.0];
const ROUNDS: usize = 100;

/// A measured pair: scene, squared translation over the distance, its smooth error.
pub struct Measured {
    pub group: usize,
    view: f64,
    smooth: SmoothError,
}

pub fn measured(pairs: &[TruePair]) -> Vec<Measured> {
    let one = |p: &TruePair| Some(Measured { group: p.group, view: p.view, smooth: p.smooth_error()? });
    pairs.par_iter().filter_map(one).collect()
}

/// `[S₀, g, f]` of the truth.
pub fn fit_share(all: &[&Measured], start: [f64; 3], grows: bool) -> [f64; 3] {
    let cost = |p: &[f64; 3]| {
        let [share, growth, far] = p.map(f64::exp);
        let of = |m: &&Measured| {
            let truth = share * (1.0 + growth * m.view / (1.0 + m.view / far));
            (m.smooth.mean_square / (truth + m.smooth.of_white_noise) / MEDIAN_20).ln().abs()
        };
        all.iter().map(of).sum::<f64>()
    };
    // A search by steps along each logarithm, halved where none helps: the cost has kinks.
    let mut best = start.map(f64::ln);
    let (mut least, mut step) = (cost(&best), 0.8);
    while step > 5e-3 {
        let before = least;
        for k in 0..if grows { 3 } else { 1 } {
            for sign in [1.0, -1.0] {
                let mut candidate = best;
                candidate[k] = (candidate[k] + sign * step).clamp(-18.0, 12.0);
                let value = cost(&candidate);
                if value < least {
                    (best, least) = (candidate, value);
                }
            }
        }
        if least >= before {
            step *= 0.5;
        }
    }
    best.map(f64::exp)
}

/// A scene's normalised squared rotation errors at each `o` of the grid; NaN where a pair has no usable solution.
pub struct Normalized {
    pub group: usize,
    at: [f64; GRID.len()],
}

fn normalized(solution: &PairSolution, truth: &UnitQuaternion<f64>) -> f64 {
    let error = so3::log(&(truth * solution.camera_to_from_camera_from.inverse()));
    solution.covariance_rad2.try_inverse().map_or(f64::NAN, |inverse| error.dot(&(inverse * error)))
}

/// Pairs over ground, solved with free relief, the truth telling rival motions apart.
pub fn over_ground(pairs: &[TruePair], camera: &Camera, [share, growth, far]: [f64; 3]) -> Vec<Normalized> {
    let solve = |p: &TruePair, over: f64| {
        let noise = PairNoise {
            correlated_error_share: share / over,
            growth_by_view: growth,
            far_view: far,
            over_likeliest: over,
        };
        let config = RotationConfig { noise, ..RotationConfig::default() };
        let hints = PairHints { camera_to_from_camera_from: Some(p.true_rotation), ..PairHints::default() };
        let solved = relative_rotation(p.pixels(), camera, &hints, &config).expect("OpenCV works");
        let usable = solved.status == PairStatus::Ok && solved.model == RotationModel::Essential;
        if usable { normalized(&solved, &p.true_rotation) } else { f64::NAN }
    };
    pairs.par_iter().map(|p| Normalized { group: p.group, at: GRID.map(|over| solve(p, over)) }).collect()
}

/// Pairs of one body, solved about their common centre.
pub fn about_center(pairs: &[TruePair], camera: &Camera, guess: Unit<Vector3<f64>>, share: f64) -> Vec<Normalized> {
    let centered: Vec<CenteredPair> = pairs
        .iter()
        .map(|p| CenteredPair { matches: p.pixels(), dt_s: p.dt_s, predicted: Some(p.true_rotation) })
        .collect();
    let rotation = RotationConfig::default();
    let at = GRID.map(|over| {
        let noise = BodyNoise { correlated_error_share: share / over, over_likeliest: over };
        let config = FixedCenterConfig { noise, ..FixedCenterConfig::default() };
        let problem = CenterProblem { camera, center_guess: guess, config: &config, rotation: &rotation };
        let solved = rotations_about_center(&centered, &problem).pairs;
        let one = |(p, s): (&TruePair, &PairSolution)| {
            if s.status == PairStatus::Ok { normalized(s, &p.true_rotation) } else { f64::NAN }
        };
        pairs.iter().zip(&solved).map(one).collect::<Vec<f64>>()
    });
    let of = |(i, p): (usize, &TruePair)| Normalized { group: p.group, at: std::array::from_fn(|k| at[k][i]) };
    pairs.iter().enumerate().map(of).collect()
}

/// Medians over that of χ²₃ along the grid.
fn ratios(all: &[&Normalized]) -> [f64; GRID.len()] {
    let at = |k: usize| all.iter().map(|n| n.at[k]).filter(|v| v.is_finite()).collect::<Vec<_>>();
    std::array::from_fn(|k| median(&at(k)) / MEDIAN_3)
}

/// The `o` at which the median is right, between the grid's ends.
pub fn fit_over(all: &[&Normalized]) -> f64 {
    let ratio = ratios(all).map(f64::ln);
    let crossing = (1..GRID.len()).find(|k| (ratio[*k - 1] >= 0.0) != (ratio[*k] >= 0.0));
    match crossing {
        Some(k) => {
            let share = ratio[k - 1] / (ratio[k - 1] - ratio[k]);
            GRID[k - 1] * (GRID[k] / GRID[k - 1]).powf(share)
        }
        None if ratio[0] < 0.0 => GRID[0],
        None => GRID[GRID.len() - 1],
    }
}

/// Constants of a kind of scene with intervals: `[S₀/o, g, f, o]`.
pub struct Constants {
    pub value: [f64; 4],
    pub intervals: [[f64; 2]; 4],
    pub pairs: usize,
    /// Median normalised squared errors over that of χ²₃ along the grid.
    pub ratios: [f64; GRID.len()],
}

pub fn constants(
    (measured, normalized): (&[Measured], &[Normalized]),
    share: [f64; 3],
    grows: bool,
    purpose: &str,
) -> Constants {
    let (all, solved): (Vec<&Measured>, Vec<&Normalized>) = (measured.iter().collect(), normalized.iter().collect());
    let together = |share: [f64; 3], over: f64| [share[0] / over, share[1], share[2], over];
    let mut groups: Vec<usize> = solved.iter().map(|n| n.group).collect();
    groups.sort_unstable();
    groups.dedup();
    let again = |drawn: &[usize]| {
        let some: Vec<&Measured> =
            drawn.iter().flat_map(|g| all.iter().filter(move |m| m.group == *g)).copied().collect();
        let over: Vec<&Normalized> =
            drawn.iter().flat_map(|g| solved.iter().filter(move |n| n.group == *g)).copied().collect();
        together(fit_share(&some, share, grows), fit_over(&over))
    };
    Constants {
        value: together(share, fit_over(&solved)),
        intervals: intervals(&groups, (ROUNDS, purpose), again),
        pairs: solved.iter().filter(|n| n.at[0].is_finite()).count(),
        ratios: ratios(&solved),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_share_and_its_growth_are_recovered() {
        let truth = [0.002, 300.0, 0.04];
        let share = |view: f64| truth[0] * (1.0 + truth[1] * view / (1.0 + view / truth[2]));
        let one = |k: usize| {
            let view = 1e-4 * 10f64.powf(3.3 * (k % 97) as f64 / 97.0);
            // Half of the pairs above the median and half below, by various factors.
            let factor = (0.3 * ((k * 37 % 101) as f64 / 50.0 - 1.0)).exp();
            let smooth = SmoothError { mean_square: MEDIAN_20 * factor * (share(view) + 0.001), of_white_noise: 0.001 };
            Measured { group: k % 10, view, smooth }
        };
        let all: Vec<Measured> = (0..400).map(one).collect();
        let found = fit_share(&all.iter().collect::<Vec<_>>(), [0.001, 100.0, 0.1], true);
        for k in 0..3 {
            assert!((found[k] / truth[k]).ln().abs() < 0.25, "{found:?}");
        }
        let still = fit_share(&all.iter().collect::<Vec<_>>(), [0.001, 1e-6, 0.1], false);
        assert!(still[0] > 2.0 * truth[0], "without growth the share has to be larger: {still:?}");
    }

    #[test]
    fn the_grid_is_crossed_where_the_median_is_right() {
        let one = |k: usize| Normalized {
            group: k,
            at: GRID.map(|over| MEDIAN_3 * (4.0 / over) * (0.5 + (k % 11) as f64 / 10.0)),
        };
        let all: Vec<Normalized> = (0..110).map(one).collect();
        let all: Vec<&Normalized> = all.iter().collect();
        assert!((fit_over(&all) / 4.0 - 1.0).abs() < 0.02, "{}", fit_over(&all));
        let small: Vec<Normalized> = (0..9).map(|k| Normalized { group: k, at: [0.1; GRID.len()] }).collect();
        assert_eq!(fit_over(&small.iter().collect::<Vec<_>>()), GRID[0], "pessimistic all the way: the grid's end");
    }
}
