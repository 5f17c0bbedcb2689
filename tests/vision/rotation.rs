//! The rotation of a pair from synthetic matches.

use super::bearings::*;
use nalgebra::{Matrix3, Vector3};
use opnav::geometry::so3;
use opnav::vision::*;

fn solve(scene: &Scene, pair: &MatchedPair, hints: &PairHints) -> PairSolution {
    let sigma = vec![0.3; pair.from_px.len()];
    let matches = PixelMatches { pair, sigma_px: &sigma };
    relative_rotation(matches, &scene.camera, hints, &RotationConfig::default()).unwrap()
}

fn prior(scene: &Scene) -> PairHints {
    let off = so3::exp(&Vector3::new(0.001, -0.0007, 0.0012));
    PairHints { camera_to_from_camera_from: Some(off * scene.rotation), ..PairHints::default() }
}

/// Median error over trials, relative to the Cramér-Rao bound, and the mean normalised error squared over three.
fn against_bound(make: impl Fn(u64) -> Scene, sigma_px: f64, hint: bool, trials: u64) -> (f64, f64, usize) {
    let (mut ratios, mut nees, mut ok) = (Vec::new(), Vec::new(), 0);
    for seed in 0..trials {
        let scene = make(seed);
        let pair = scene.matches(sigma_px, 0.2, seed);
        let hints = if hint { prior(&scene) } else { PairHints::default() };
        let solution = solve(&scene, &pair, &hints);
        let bound = median_angle_deg(&scene.bound(sigma_px, scene.points.len() / 5));
        if solution.status != PairStatus::Ok {
            continue;
        }
        ok += 1;
        ratios.push(angle_deg(&scene.rotation, &solution.camera_to_from_camera_from) / bound);
        let d = so3::log(&(scene.rotation * solution.camera_to_from_camera_from.inverse()));
        nees.push(d.dot(&(solution.covariance_rad2.try_inverse().unwrap() * d)) / 3.0);
    }
    let mean = nees.iter().sum::<f64>() / nees.len() as f64;
    (median(ratios), mean, ok)
}

#[test]
#[ignore = "a table to read"]
fn table_of_errors_over_bound() {
    for (name, relief) in [("10 %", 0.1), ("2 %", 0.02), ("plane", 0.0)] {
        for sigma in [0.1, 0.3, 0.5, 1.0] {
            for hint in [false, true] {
                let t = std::time::Instant::now();
                let (ratio, nees, ok) = against_bound(|seed| descent(200, relief, seed), sigma, hint, 40);
                let bound =
                    if relief > 0.0 { median_angle_deg(&descent(200, relief, 0).bound(sigma, 40)) } else { 0.0 };
                println!(
                    "{name} {sigma} hint {hint}: bound {bound:.4} ratio {ratio:.2} nees {nees:.2} ok {ok}/40 {:?}",
                    t.elapsed() / 40
                );
            }
        }
    }
    for sigma in [0.1, 0.3, 0.5, 1.0] {
        let make = |seed| ellipsoid(camera(), 200, &Vector3::new(0.02, 0.08, 0.03), seed);
        let (ratio, nees, ok) = against_bound(make, sigma, false, 40);
        let bound = median_angle_deg(&make(0).bound(sigma, 40));
        println!("asteroid {sigma}: bound {bound:.4} ratio {ratio:.2} nees {nees:.2} ok {ok}/40");
    }
    let _ = Matrix3::<f64>::identity();
}

#[test]
#[ignore = "debug"]
fn debug_pairs() {
    for (relief, sigma) in [(0.1, 0.3), (0.1, 0.5), (0.02, 0.5), (0.0, 0.5)] {
        for seed in 0..40 {
            let scene = descent(200, relief, seed);
            let pair = scene.matches(sigma, 0.2, seed);
            for (k, h) in [PairHints::default(), prior(&scene)].into_iter().enumerate() {
                let s = solve(&scene, &pair, &h);
                if s.status != PairStatus::Ok {
                    continue;
                }
                let d = so3::log(&(scene.rotation * s.camera_to_from_camera_from.inverse()));
                let nees = d.dot(&(s.covariance_rad2.try_inverse().unwrap() * d)) / 3.0;
                let sg = s.covariance_rad2.diagonal().map(|v| v.sqrt().to_degrees());
                if nees > 4.0 {
                    println!(
                        "{relief} {sigma} {seed} hint {k} nees {nees:.1} {:?} err {:.4} sigma {:.4?} inl {} scale {:.3} dir {:.3?}",
                        s.model,
                        d.norm().to_degrees(),
                        sg.as_slice(),
                        s.inlier_count(),
                        s.noise_scale,
                        s.direction_in_to.map(|d| d.into_inner()).unwrap().as_slice()
                    );
                }
            }
        }
    }
}
