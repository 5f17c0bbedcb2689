//! The rotation of a pair from synthetic matches.

use super::bearings::*;
use nalgebra::{Vector2, Vector3};
use opnav::geometry::so3;
use opnav::observations::*;
use opnav::stats::random_stream;
use opnav::vision::*;
use rand_distr::{Distribution, StandardNormal};

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
fn relief_gives_the_rotation_near_the_bound_without_a_hint() {
    for (sigma_px, most) in [(0.1, 1.5), (0.3, 1.6)] {
        let (ratio, nees, ok) = against_bound(|seed| descent(200, 0.1, seed), sigma_px, false, 30);
        assert!(ratio < most && nees < 2.5 && ok >= 24, "{sigma_px} px: ratio {ratio}, NEES/3 {nees}, {ok} of 30 ok");
    }
}

#[test]
fn near_planes_give_the_rotation_near_the_bound_with_a_hint() {
    for (relief, sigma_px) in [(0.1, 0.5), (0.02, 0.3), (0.0, 0.1), (0.0, 0.5)] {
        let (ratio, nees, ok) = against_bound(|seed| descent(200, relief, seed), sigma_px, true, 30);
        assert!(
            ratio < 1.5 && nees < 2.0 && ok == 30,
            "relief {relief}, {sigma_px} px: ratio {ratio}, NEES/3 {nees}, {ok} of 30 ok"
        );
    }
}

#[test]
fn a_turning_body_gives_the_rotation_at_the_bound() {
    for sigma_px in [0.1, 0.5] {
        let make = |seed| ellipsoid(camera(), 200, &Vector3::new(0.02, 0.08, 0.03), seed);
        let (ratio, nees, ok) = against_bound(make, sigma_px, false, 30);
        assert!(ratio < 1.3 && nees < 1.6 && ok == 30, "{sigma_px} px: ratio {ratio}, NEES/3 {nees}, {ok} of 30 ok");
    }
}

/// Two views of a plane leave two motions (Faugeras and Lustman 1988): the second has the first's direction of translation
/// and normal in each other's place. Where the camera moves across the normal, the second puts points behind the camera, so
/// every pair has to be solved. Where it moves along the normal the two are one, which noise parts again in many pairs (by
/// the root of its size): a quarter at least has to be solved. In between the second is as good as the first, and no pair
/// may be, unless chance tells. What is solved has to be right.
#[test]
fn a_plane_without_a_hint_is_solved_where_one_motion_is_left_and_never_confidently_wrong() {
    let motions = [
        ("along the normal", Vector3::new(0.0, 0.0, -0.03), 10..=40),
        ("across the normal", Vector3::new(0.03, 0.02, 0.0), 40..=40),
        ("in between", Vector3::new(0.012, 0.009, -0.03), 0..=4),
    ];
    for (motion, translation, expected) in motions {
        let mut ok = 0;
        for seed in 0..40 {
            let scene = descent_by(300, 0.0, translation, seed);
            let solution = solve(&scene, &scene.matches(0.3, 0.2, seed), &PairHints::default());
            if solution.status == PairStatus::Ok {
                ok += 1;
                let d = so3::log(&(scene.rotation * solution.camera_to_from_camera_from.inverse()));
                let chi2 = d.dot(&(solution.covariance_rad2.try_inverse().unwrap() * d));
                assert!(chi2 < 40.0, "{motion}, seed {seed}: χ² {chi2}");
            } else {
                assert_eq!(solution.camera_to_from_camera_from, nalgebra::UnitQuaternion::identity());
            }
        }
        assert!(expected.contains(&ok), "{motion}: {ok} of 40 ok, {expected:?} expected");
    }
}

#[test]
fn outliers_up_to_six_in_ten_do_not_matter() {
    for outliers in [0.0, 0.2, 0.4, 0.6] {
        let scene = descent(400, 0.1, 7);
        let solution = solve(&scene, &scene.matches(0.3, outliers, 7), &prior(&scene));
        assert_eq!(solution.status, PairStatus::Ok, "{outliers}");
        let error_deg = angle_deg(&scene.rotation, &solution.camera_to_from_camera_from);
        let sigma_deg = solution.covariance_rad2.trace().sqrt().to_degrees();
        assert!(error_deg < 0.15 && error_deg < 3.0 * sigma_deg, "{outliers}: {error_deg} at {sigma_deg} degrees");
        let wrong = (outliers * 400.0) as usize;
        assert!(solution.inliers[..wrong].iter().filter(|i| **i).count() <= 3);
    }
}

#[test]
fn a_pure_rotation_is_found_and_does_not_pretend_to_a_direction() {
    let scene = Scene { translation: Vector3::zeros(), ..descent(300, 0.1, 3) };
    let solution = solve(&scene, &scene.matches(0.3, 0.2, 3), &PairHints::default());
    assert_eq!((solution.status, solution.model), (PairStatus::Ok, RotationModel::Homography));
    assert_eq!(solution.direction_in_to, None);
    assert!(angle_deg(&scene.rotation, &solution.camera_to_from_camera_from) < 0.02);
}

#[test]
fn a_camera_at_rest_is_no_motion_with_or_without_noise() {
    let still = nalgebra::UnitQuaternion::identity();
    for seed in 0..44 {
        let scene = Scene { translation: Vector3::zeros(), rotation: still, ..descent(300, 0.1, seed) };
        for sigma_px in [0.0, 0.05, 0.3, 1.0] {
            let solution = solve(&scene, &scene.matches(sigma_px, 0.1, seed), &PairHints::default());
            assert_eq!(solution.status, PairStatus::NoMotion, "{sigma_px} px, seed {seed}");
        }
    }
}

#[test]
fn a_mirror_image_is_refused() {
    let scene = descent(300, 0.0, 5);
    let mut pair = scene.matches(0.3, 0.1, 5);
    pair.to_px.iter_mut().for_each(|p| p.x = 1023.0 - p.x);
    assert_ne!(solve(&scene, &pair, &PairHints::default()).status, PairStatus::Ok);
}

#[test]
fn random_matches_give_no_rotation() {
    for seed in 0..10 {
        let scene = descent(200, 0.1, seed);
        let status = solve(&scene, &scene.matches(0.3, 1.0, seed), &PairHints::default()).status;
        assert_ne!(status, PairStatus::Ok, "seed {seed}");
    }
}

#[test]
fn swapping_the_images_inverts_the_rotation() {
    let scene = ellipsoid(camera(), 300, &Vector3::new(0.02, 0.08, 0.03), 6);
    let pair = scene.matches(0.2, 0.2, 6);
    let swapped = MatchedPair { from_px: pair.to_px.clone(), to_px: pair.from_px.clone() };
    let there = solve(&scene, &pair, &PairHints::default());
    let back = solve(&scene, &swapped, &PairHints::default());
    let off = angle_deg(&there.camera_to_from_camera_from, &back.camera_to_from_camera_from.inverse());
    let sigma_deg = there.covariance_rad2.trace().sqrt().to_degrees();
    assert!(off < 0.3 * sigma_deg, "{off} against a sigma of {sigma_deg} degrees");
}

#[test]
fn turning_both_images_conjugates_the_rotation() {
    let scene = ellipsoid(camera(), 300, &Vector3::new(0.02, 0.08, 0.03), 8);
    let pair = scene.matches(0.2, 0.2, 8);
    let quarter = |p: &nalgebra::Vector2<f64>| nalgebra::Vector2::new(1023.0 - p.y, p.x);
    let turned = MatchedPair {
        from_px: pair.from_px.iter().map(quarter).collect(),
        to_px: pair.to_px.iter().map(quarter).collect(),
    };
    let roll = so3::exp(&Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2));
    let plain = solve(&scene, &pair, &PairHints::default());
    let other = solve(&scene, &turned, &PairHints::default());
    let off = angle_deg(&(roll * plain.camera_to_from_camera_from * roll.inverse()), &other.camera_to_from_camera_from);
    let sigma_deg = plain.covariance_rad2.trace().sqrt().to_degrees();
    assert!(off < 0.3 * sigma_deg, "{off} against a sigma of {sigma_deg} degrees");
}

#[test]
fn too_few_matches_are_too_few() {
    let scene = descent(15, 0.1, 1);
    assert_eq!(solve(&scene, &scene.matches(0.1, 0.0, 1), &PairHints::default()).status, PairStatus::FewMatches);
}

/// Mean normalised error squared over three where the matches' errors vary smoothly over the picture besides their noise,
/// with coefficients of `share` of the noise's variance.
fn nees_with_smooth_errors(share: f64, config: &RotationConfig) -> f64 {
    const TRIALS: u64 = 40;
    const NOISE_PX: f64 = 0.1;
    let mut sum = 0.0;
    for seed in 0..TRIALS {
        let scene = ellipsoid(camera(), 500, &Vector3::new(0.02, 0.08, 0.03), seed);
        let mut pair = scene.matches(NOISE_PX, 0.0, seed);
        let mut random = random_stream(seed, "smooth errors", 0);
        let mut draw = || -> f64 { StandardNormal.sample(&mut random) };
        let field: [Vector2<f64>; 6] =
            std::array::from_fn(|_| Vector2::new(draw(), draw()) * NOISE_PX * (2.0 * share).sqrt());
        for (from, to) in pair.from_px.iter().zip(&mut pair.to_px) {
            let p = (from - Vector2::repeat(511.5)) / 180.0;
            let modes = [1.0, p.x, p.y, p.x * p.y, 0.7 * (p.x * p.x - 1.0), 0.7 * (p.y * p.y - 1.0)];
            *to += field.iter().zip(modes).map(|(f, m)| f * m).sum::<Vector2<f64>>();
        }
        let sigma_px = vec![0.3; pair.from_px.len()];
        let matches = PixelMatches { pair: &pair, sigma_px: &sigma_px };
        let solution = relative_rotation(matches, &scene.camera, &PairHints::default(), config).expect("OpenCV");
        let d = so3::log(&(scene.rotation * solution.camera_to_from_camera_from.inverse()));
        sum += d.dot(&(solution.covariance_rad2.try_inverse().unwrap() * d)) / 3.0;
    }
    sum / TRIALS as f64
}

#[test]
fn errors_that_vary_smoothly_are_in_the_covariance_up_to_what_images_show() {
    let default = RotationConfig::default();
    let white =
        RotationConfig { noise: PairNoise { correlated_error_share: 0.0, ..PairNoise::default() }, ..default.clone() };
    let none = nees_with_smooth_errors(0.0, &white);
    let (usual, absurd) = (nees_with_smooth_errors(0.007, &default), nees_with_smooth_errors(0.3, &default));
    assert!((0.7..1.4).contains(&none) && (0.6..1.6).contains(&usual), "{none}, {usual}");
    let unexpected = nees_with_smooth_errors(0.007, &white);
    assert!(unexpected > 1.6, "taken for white noise, they are too large: {unexpected}");
    assert!(absurd > 3.0, "{absurd}");
}
