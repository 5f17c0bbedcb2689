//! Rotation of a pair against the floor of its likelihood, over scenes, noise and shares of wrong matches.

use super::likelihood::most_likely_rotation;
use crate::accuracy_bar::{Bar, check_table};
use crate::vision::pair::bearings::*;
use nalgebra::Vector3;
use opnav::geometry::so3;
use opnav::observations::*;
use opnav::vision::*;

const NOISE_PX: [f64; 4] = [0.1, 0.3, 0.5, 1.0];
const MATCHES: usize = 200;
const WRONG: f64 = 0.2;
/// Chance exceeds this in one trial of a million: an accepted twin exceeds it by far.
const WORST_NEES: f64 = 10.0;

/// A kind of scene, with the floor that a reference implementation reached at each noise, degrees.
struct Kind {
    name: &'static str,
    make: fn(u64) -> Scene,
    reference_deg: [f64; 4],
    /// Whether a gyroscope's prediction chooses between the two motions that a plane leaves.
    hinted: bool,
    /// Least share that must be accepted at every noise; the rest is refused as ambiguous.
    least_accepted: f64,
}

const KINDS: [Kind; 6] = [
    Kind {
        name: "asteroid, 5 deg",
        make: asteroid,
        reference_deg: [0.025, 0.075, 0.14, 0.23],
        hinted: false,
        least_accepted: 0.99,
    },
    Kind {
        name: "relief 10 %, gyro",
        make: high_relief,
        reference_deg: [0.009, 0.025, 0.044, 0.11],
        hinted: true,
        least_accepted: 1.0,
    },
    Kind {
        name: "relief 2 %, gyro",
        make: low_relief,
        reference_deg: [0.013, 0.036, 0.064, 0.15],
        hinted: true,
        least_accepted: 1.0,
    },
    Kind {
        name: "plane, gyro",
        make: plane,
        reference_deg: [0.013, 0.04, 0.07, 0.18],
        hinted: true,
        least_accepted: 1.0,
    },
    Kind {
        name: "relief 10 %",
        make: high_relief,
        reference_deg: [0.009, 0.025, 0.044, 0.11],
        hinted: false,
        least_accepted: 0.0,
    },
    Kind {
        name: "relief 2 %",
        make: low_relief,
        reference_deg: [0.013, 0.036, 0.064, 0.15],
        hinted: false,
        least_accepted: 0.0,
    },
];

fn asteroid(seed: u64) -> Scene {
    let axis = Vector3::new(0.23, 0.91, 0.34).normalize();
    ellipsoid(camera(), MATCHES, &(axis * 5f64.to_radians()), seed)
}

fn high_relief(seed: u64) -> Scene {
    descent_by(MATCHES, 0.1, Vector3::new(0.02, 0.015, -0.05), seed)
}

fn low_relief(seed: u64) -> Scene {
    descent_by(MATCHES, 0.02, Vector3::new(0.02, 0.015, -0.05), seed)
}

fn plane(seed: u64) -> Scene {
    descent_by(MATCHES, 0.0, Vector3::new(0.02, 0.015, -0.05), seed)
}

/// What came of all trials of a kind of scene at one noise.
#[derive(Default)]
struct Outcome {
    errors_deg: Vec<f64>,
    floors_deg: Vec<f64>,
    nees_per_dof: Vec<f64>,
    trials: usize,
}

/// Fewest accepted trials whose mean says something.
const FEWEST: usize = 20;

impl Outcome {
    fn of(kind: &Kind, noise_px: f64, trials: u64) -> Outcome {
        let mut outcome = Outcome { trials: trials as usize, ..Outcome::default() };
        for seed in 0..trials {
            outcome.add(kind, noise_px, seed);
        }
        outcome
    }

    fn add(&mut self, kind: &Kind, noise_px: f64, seed: u64) {
        let scene = (kind.make)(seed);
        let pair = scene.matches(noise_px, WRONG, 7000 + seed);
        let sigma_px = vec![0.3; pair.from_px.len()];
        let off = so3::exp(&Vector3::new(0.001, -0.0007, 0.0012));
        let hints =
            PairHints { camera_to_from_camera_from: kind.hinted.then(|| off * scene.rotation), ..PairHints::default() };
        let matches = PixelMatches { pair: &pair, sigma_px: &sigma_px };
        let white = RotationConfig {
            noise: PairNoise { correlated_error_share: 0.0, ..PairNoise::default() },
            ..RotationConfig::default()
        };
        let solution = relative_rotation(matches, &scene.camera, &hints, &white).expect("OpenCV");
        if solution.status != PairStatus::Ok {
            return;
        }
        let wrong = (WRONG * MATCHES as f64) as usize;
        let d = so3::log(&(scene.rotation * solution.camera_to_from_camera_from.inverse()));
        let weight = solution.covariance_rad2.try_inverse().expect("a covariance");
        self.errors_deg.push(d.norm().to_degrees());
        self.floors_deg.push(angle_deg(&scene.rotation, &most_likely_rotation(&scene, &pair, wrong)));
        self.nees_per_dof.push(d.dot(&(weight * d)) / 3.0);
    }

    fn bars(&self, kind: &Kind, noise_index: usize) -> Vec<Bar> {
        let (noise_px, reference_deg) = (NOISE_PX[noise_index], kind.reference_deg[noise_index]);
        let what = |figure: &str| format!("{}, {noise_px} px: {figure}", kind.name);
        let (error_deg, floor_deg) = (median(self.errors_deg.clone()), median(self.floors_deg.clone()));
        let times = if noise_px < 1.0 { 1.5 } else { 2.0 };
        let worst = self.nees_per_dof.iter().copied().fold(0.0, f64::max);
        let accepted = self.errors_deg.len();
        let mut bars = vec![
            Bar::at_least(what("accepted"), accepted as f64 / self.trials as f64, kind.least_accepted, ""),
            Bar::at_most(what("worst NEES per degree of freedom"), worst, WORST_NEES, ""),
        ];
        if accepted >= FEWEST {
            let nees = self.nees_per_dof.iter().sum::<f64>() / accepted as f64;
            bars.extend([
                Bar::at_most(what("median error over the floor"), error_deg / floor_deg, times, ""),
                Bar::stated(what("median error"), error_deg, "deg"),
                Bar::stated(what("floor"), floor_deg, "deg"),
                Bar::stated(what("floor of the reference"), reference_deg, "deg"),
                Bar::at_least(what("NEES per degree of freedom"), nees, 0.7, ""),
                Bar::at_most(what("NEES per degree of freedom"), nees, 1.5, ""),
            ]);
        }
        bars
    }
}

pub fn table(trials: u64) -> impl Iterator<Item = Vec<Bar>> {
    let all = KINDS.iter().flat_map(|kind| (0..NOISE_PX.len()).map(move |k| (kind, k)));
    all.map(move |(kind, k)| Outcome::of(kind, NOISE_PX[k], trials).bars(kind, k))
}

#[test]
fn rotations_of_a_few_pairs_are_near_the_floor() {
    let parts = KINDS.iter().map(|kind| Outcome::of(kind, NOISE_PX[1], FEWEST as u64).bars(kind, 1));
    check_table("rotation of a few pairs", parts);
}

#[test]
#[ignore = "minutes long: run by `make accuracy`"]
fn accuracy_of_a_pairs_rotation() {
    check_table("rotation of a pair, 200 matches, 20 % of them wrong", table(200));
}
