//! The constants of pairs: how large smooth errors are, how they grow, and how they weigh.
//!
//! **Growth.** The coefficients of a pair's true errors, divided by the noise, have the variance `S + b`: `b` is the share of
//! white noise (known), `S(v) = S₀ (1 + g v / (1 + v/f))` the truth. `S₀`, `g`, `f` minimise
//! `Σ |ln q − ln(S(v) + b) − ln m|`, `q` the mean square of a pair's coefficients and `m` the median of χ²₂₀ over 20: a median
//! regression. `g` and `f` are kept.
//!
//! **Weight and size.** A pair's motion depends on the expected share `s` alone, its covariance on `s o`. The truth holds much
//! that no motion imitates, so that `S₀` is only a measure to begin from: pairs are solved for several `s` and `s o`. The `s`
//! whose motions err least (mean logarithm of the error) is taken, and with it the `o` at which the median of the rotations'
//! normalised squared errors is that of χ²₃.

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
/// Expected shares over the true one at which pairs are solved…
const SHARES: [f64; 4] = [0.003, 0.01, 0.03, 0.15];
/// …and the sizes of the covariance's share over the true one.
const SIZES: [f64; 5] = [0.01, 0.04, 0.15, 0.6, 2.4];
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

/// A pair solved for every expected share and size: logarithm of the rotation's error, and its normalised squared error;
/// NaN where there is no usable solution.
pub struct Solved {
    pub group: usize,
    ln_error: [f64; SHARES.len()],
    normalized: [[f64; SIZES.len()]; SHARES.len()],
}

impl Solved {
    /// Solved by a function of the expected share over the true one, and of the size over it.
    fn by(group: usize, truth: &UnitQuaternion<f64>, solve: impl Fn(f64, f64) -> Option<PairSolution>) -> Self {
        let of = |share: f64, size: f64| {
            let Some(solution) = solve(share, size) else { return (f64::NAN, f64::NAN) };
            let error = so3::log(&(truth * solution.camera_to_from_camera_from.inverse()));
            let inverse = solution.covariance_rad2.try_inverse();
            (error.norm().ln(), inverse.map_or(f64::NAN, |inverse| error.dot(&(inverse * error))))
        };
        let all = SHARES.map(|share| SIZES.map(|size| of(share, size)));
        Solved { group, ln_error: all.map(|sizes| sizes[0].0), normalized: all.map(|sizes| sizes.map(|s| s.1)) }
    }

    pub fn is_usable(&self) -> bool {
        self.ln_error.iter().all(|e| e.is_finite())
    }
}

/// Pairs over ground, solved with free relief, the truth telling rival motions apart.
pub fn over_ground(pairs: &[TruePair], camera: &Camera, [truth, growth, far]: [f64; 3]) -> Vec<Solved> {
    let solve = |p: &TruePair, share: f64, size: f64| {
        let noise = PairNoise {
            correlated_error_share: share * truth,
            growth_by_view: growth,
            far_view: far,
            over_likeliest: size / share,
        };
        let config = RotationConfig { noise, ..RotationConfig::default() };
        let hints = PairHints { camera_to_from_camera_from: Some(p.true_rotation), ..PairHints::default() };
        let solved = relative_rotation(p.pixels(), camera, &hints, &config).expect("OpenCV works");
        Some(solved).filter(|s| s.status == PairStatus::Ok && s.model == RotationModel::Essential)
    };
    pairs.par_iter().map(|p| Solved::by(p.group, &p.true_rotation, |share, size| solve(p, share, size))).collect()
}

/// Pairs of one body, solved about their common centre.
pub fn about_center(pairs: &[TruePair], camera: &Camera, guess: Unit<Vector3<f64>>, truth: f64) -> Vec<Solved> {
    let centered: Vec<CenteredPair> = pairs
        .iter()
        .map(|p| CenteredPair { matches: p.pixels(), dt_s: p.dt_s, predicted: Some(p.true_rotation) })
        .collect();
    let rotation = RotationConfig::default();
    let solve = |share: f64, size: f64| {
        let noise = BodyNoise { correlated_error_share: share * truth, over_likeliest: size / share };
        let config = FixedCenterConfig { noise, ..FixedCenterConfig::default() };
        let problem = CenterProblem { camera, center_guess: guess, config: &config, rotation: &rotation };
        rotations_about_center(&centered, &problem).pairs
    };
    let all: Vec<Vec<Vec<PairSolution>>> =
        SHARES.par_iter().map(|share| SIZES.map(|size| solve(*share, size)).to_vec()).collect();
    let place = |of: &[f64], value: f64| of.iter().position(|v| *v == value).expect("a value of the grid");
    let one = |(i, p): (usize, &TruePair)| {
        let found = |share, size| Some(all[place(&SHARES, share)][place(&SIZES, size)][i].clone());
        Solved::by(p.group, &p.true_rotation, |share, size| found(share, size).filter(|s| s.status == PairStatus::Ok))
    };
    pairs.iter().enumerate().map(one).collect()
}

/// Medians over that of χ²₃ along the sizes.
fn ratios(all: &[&Solved], share: usize) -> [f64; SIZES.len()] {
    let at = |k: usize| all.iter().map(|n| n.normalized[share][k]).filter(|v| v.is_finite()).collect::<Vec<_>>();
    std::array::from_fn(|k| median(&at(k)) / MEDIAN_3)
}

/// The size at which the median is right, between the grid's ends.
fn fit_size(ratios: [f64; SIZES.len()]) -> f64 {
    let ratio = ratios.map(f64::ln);
    let crossing = (1..SIZES.len()).find(|k| (ratio[*k - 1] >= 0.0) != (ratio[*k] >= 0.0));
    match crossing {
        Some(k) => {
            let share = ratio[k - 1] / (ratio[k - 1] - ratio[k]);
            SIZES[k - 1] * (SIZES[k] / SIZES[k - 1]).powf(share)
        }
        None if ratio[0] < 0.0 => SIZES[0],
        None => SIZES[SIZES.len() - 1],
    }
}

/// Mean logarithm of the errors by each expected share.
fn accuracy(all: &[&Solved]) -> [f64; SHARES.len()] {
    let usable: Vec<&&Solved> = all.iter().filter(|s| s.is_usable()).collect();
    std::array::from_fn(|k| usable.iter().map(|s| s.ln_error[k]).sum::<f64>() / usable.len().max(1) as f64)
}

/// `[s, o]` over the true share: the most exact motions, then the right covariance.
pub fn fit_weight(all: &[&Solved]) -> [f64; 2] {
    let accuracy = accuracy(all);
    let best = (0..SHARES.len()).min_by(|a, b| accuracy[*a].total_cmp(&accuracy[*b])).unwrap_or(0);
    [SHARES[best], fit_size(ratios(all, best)) / SHARES[best]]
}

/// Constants of a kind of scene with intervals: `[s, g, f, o]`.
pub struct Constants {
    pub value: [f64; 4],
    pub intervals: [[f64; 2]; 4],
    pub pairs: usize,
}

pub fn constants(
    (measured, solved): (&[Measured], &[Solved]),
    truth: [f64; 3],
    grows: bool,
    purpose: &str,
) -> Constants {
    let all: Vec<&Solved> = solved.iter().collect();
    for (k, share) in SHARES.iter().enumerate() {
        let (error, ratios) = (accuracy(&all)[k].exp().to_degrees(), ratios(&all, k));
        println!("    share {share} of the truth: mean error {error:.5}°, normalised {ratios:.2?} for sizes {SIZES:?}");
    }
    let together = |truth: [f64; 3], [share, over]: [f64; 2]| [share * truth[0], truth[1], truth[2], over];
    let mut groups: Vec<usize> = solved.iter().map(|n| n.group).collect();
    groups.sort_unstable();
    groups.dedup();
    let again = |drawn: &[usize]| {
        let some: Vec<&Measured> = drawn.iter().flat_map(|g| measured.iter().filter(move |m| m.group == *g)).collect();
        let pairs: Vec<&Solved> = drawn.iter().flat_map(|g| solved.iter().filter(move |n| n.group == *g)).collect();
        together(fit_share(&some, truth, grows), fit_weight(&pairs))
    };
    Constants {
        value: together(truth, fit_weight(&all)),
        intervals: intervals(&groups, (ROUNDS, purpose), again),
        pairs: all.iter().filter(|s| s.is_usable()).count(),
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

    /// Pairs whose motions are best by the second share, and whose covariance is right at so much of the truth.
    fn pairs(right: f64) -> Vec<Solved> {
        let one = |k: usize| {
            let factor = 0.5 + (k % 11) as f64 / 10.0;
            Solved {
                group: k,
                ln_error: [0.1, 0.0, 0.2, 0.3].map(|e| e + factor),
                normalized: [SIZES.map(|size| MEDIAN_3 * (right / size) * factor); SHARES.len()],
            }
        };
        (0..110).map(one).collect()
    }

    #[test]
    fn the_most_exact_share_is_taken_and_the_size_at_which_the_median_is_right() {
        let all = pairs(0.3);
        let [share, over] = fit_weight(&all.iter().collect::<Vec<_>>());
        assert_eq!(share, SHARES[1]);
        assert!((share * over / 0.3 - 1.0).abs() < 0.02, "{share} {over}");
        let all = pairs(1e-4);
        let [share, over] = fit_weight(&all.iter().collect::<Vec<_>>());
        assert!((share * over / SIZES[0] - 1.0).abs() < 1e-9, "pessimistic all the way: the grid's end");
    }
}
