//! Tests of the terrain in the room `scene`.

mod features;
#[cfg(all(feature = "render", feature = "vision"))]
mod realism;
#[cfg(all(feature = "render", feature = "vision"))]
mod texture;

use nalgebra::{Unit, Vector2, Vector3};
use opnav::scene::{
    GroundDetail, NOISE_2D_RMS, NOISE_2D_SLOPE_RMS, NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS, NoiseOctave, Scatter,
    Terrain, TerrainConfig, noise_2d, noise_3d,
};
use opnav::stats::random_stream;
use rand::RngExt;

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v * v, count + 1.0));
    (sum / count).sqrt()
}

#[test]
fn the_origin_lies_on_the_ground() {
    for seed in 0..20 {
        assert_eq!(Terrain::new(&TerrainConfig::default(), seed).height_m(0.0, 0.0), 0.0);
    }
}

#[test]
fn terrain_is_reproducible_and_its_seed_matters() {
    let config = TerrainConfig::default();
    let heights = |seed| {
        let terrain = Terrain::new(&config, seed);
        (1..50).map(|k| terrain.height_m(f64::from(k) * 13.7, f64::from(k) * -5.1)).collect::<Vec<_>>()
    };
    assert_eq!(heights(3), heights(3));
    assert!(heights(3).iter().zip(heights(4)).all(|(a, b)| (a - b).abs() > 1e-6));
}

#[test]
fn ground_stays_near_the_plane_that_the_lander_assumes() {
    let config = TerrainConfig::default();
    for distance_m in [2.0, 5.0, 20.0, 50.0, 200.0, 500.0, 1000.0, 3000.0, 6000.0] {
        let departure_m = rms((0..150).flat_map(|seed| {
            let terrain = Terrain::new(&config, seed);
            let turn = f64::from(seed as u32) * 0.7;
            (0..4).map(move |k| {
                let angle = turn + f64::from(k) * std::f64::consts::FRAC_PI_2;
                terrain.height_m(distance_m * angle.cos(), distance_m * angle.sin())
            })
        }));
        let allowed_m = f64::min(25.0, 0.06 * distance_m);
        assert!(departure_m < allowed_m, "{departure_m:.2} m at {distance_m} m, {allowed_m:.2} m allowed");
        assert!(departure_m > 0.1 * allowed_m, "{departure_m:.3} m at {distance_m} m is flat");
    }
}

#[test]
fn slope_of_the_relief_is_the_one_configured() {
    for (hurst, rms_slope, slope_scale_m) in [(0.8, 0.11, 1.0), (0.6, 0.05, 10.0)] {
        let config = TerrainConfig { hurst, rms_slope, slope_scale_m, ..bare() };
        let detail = GroundDetail { height_m: 0.99 * slope_scale_m, ..GroundDetail::default() };
        let measured = rms((0..8).flat_map(|seed| {
            let terrain = Terrain::new(&config, seed);
            let mut random = random_stream(seed, "place", 0);
            (0..1000)
                .map(|_| {
                    let (x, y) = (random.random_range(-2e4..2e4), random.random_range(-2e4..2e4));
                    terrain.sample(x, y, &detail).gradient.norm()
                })
                .collect::<Vec<_>>()
        }));
        assert!((measured / rms_slope - 1.0).abs() < 0.06, "{measured} for {rms_slope}");
    }
}

/// Fractal relief alone.
fn bare() -> TerrainConfig {
    TerrainConfig::default().without_features()
}

#[test]
fn noise_has_the_strength_that_its_constants_state() {
    let mut random = random_stream(5, "noise", 0);
    let points: Vec<Vector3<f64>> =
        (0..60_000).map(|_| Vector3::from_fn(|_, _| random.random_range(-5e4..5e4))).collect();
    let planar: Vec<_> = points.iter().map(|p| noise_2d(&p.xy(), 77)).collect();
    let solid: Vec<_> = points.iter().map(|p| noise_3d(p, 77)).collect();
    let near = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 0.02, "{value} for {expected}");
    near(rms(planar.iter().map(|n| n.relief)), NOISE_2D_RMS);
    near(rms(planar.iter().map(|n| n.albedo)), NOISE_2D_RMS);
    near(rms(planar.iter().map(|n| n.relief_gradient.norm())), NOISE_2D_SLOPE_RMS);
    near(rms(solid.iter().map(|n| n.relief)), NOISE_3D_RMS);
    near(rms(solid.iter().map(|n| n.albedo)), NOISE_3D_RMS);
    near(rms(solid.iter().map(|n| n.relief_gradient.xy().norm())), NOISE_3D_TANGENT_SLOPE_RMS);
    let both = planar.iter().map(|n| n.relief * n.albedo).sum::<f64>() / planar.len() as f64;
    assert!(both.abs() < 0.03 * NOISE_2D_RMS.powi(2), "relief and albedo are independent");
}

#[test]
fn gradients_are_the_derivatives_of_heights() {
    let terrain = Terrain::new(&TerrainConfig::default(), 11);
    let mut random = random_stream(1, "gradient", 0);
    let step_m = 1e-6;
    for _ in 0..3000 {
        let (x, y) = (random.random_range(-60.0..60.0), random.random_range(-60.0..60.0));
        let slope =
            |dx: f64, dy: f64| (terrain.height_m(x + dx, y + dy) - terrain.height_m(x - dx, y - dy)) / (2.0 * step_m);
        let numeric = Vector2::new(slope(step_m, 0.0), slope(0.0, step_m));
        let off = (terrain.gradient(x, y) - numeric).norm();
        assert!(off < 2e-3, "gradient off by {off} at {x}, {y}");
    }
}

#[test]
fn a_patch_is_exactly_its_piece_of_terrain() {
    let terrain = Terrain::new(&TerrainConfig::default(), 6);
    let mut random = random_stream(6, "patch", 0);
    for _ in 0..60 {
        let edge_m = 10.0_f64.powf(random.random_range(-1.0..4.0));
        let low = Vector2::from_fn(|_, _| random.random_range(-3e3..3e3));
        let details = [0.01, 0.02].map(|share| share * edge_m);
        let detail =
            GroundDetail { height_m: details[0], feature_m: details[1], rock_m: details[0], ..GroundDetail::default() };
        let patch = terrain.patch(&low, &low.add_scalar(edge_m), &detail);
        for _ in 0..50 {
            let at = low + Vector2::from_fn(|_, _| random.random_range(0.0..=1.0)) * edge_m;
            assert_eq!(patch.sample(at.x, at.y), terrain.sample(at.x, at.y, &detail), "edge {edge_m} m");
        }
    }
}

#[test]
fn a_ray_meets_the_ground_where_it_first_crosses_it() {
    let terrain = Terrain::new(&TerrainConfig::default(), 2);
    let mut random = random_stream(2, "ray", 0);
    for _ in 0..60 {
        let height_m = 10.0_f64.powf(random.random_range(0.5..3.8));
        let (x, y) = (random.random_range(-1e3..1e3), random.random_range(-1e3..1e3));
        let origin = Vector3::new(x, y, terrain.height_m(x, y) + height_m);
        // From steep to grazing.
        let level = 10.0_f64.powf(random.random_range(-1.0..1.2));
        let turn = random.random_range(0.0..std::f64::consts::TAU);
        let direction = Unit::new_normalize(Vector3::new(level * turn.cos(), level * turn.sin(), -1.0));
        let range_m = terrain.ray_cast(&origin, &direction).expect("a descending ray meets the ground");
        let hit = origin + direction.as_ref() * range_m;
        assert!((hit.z - terrain.height_m(hit.x, hit.y)).abs() < 1e-6 * (1.0 + range_m));
        for k in 0..400 {
            let p = origin + direction.as_ref() * (range_m * (1.0 - 1e-6) * f64::from(k) / 400.0);
            assert!(p.z > terrain.height_m(p.x, p.y), "the ray is below the ground before its hit");
        }
    }
    let up = Unit::new_normalize(Vector3::new(0.1, 0.0, 1.0));
    assert_eq!(terrain.ray_cast(&Vector3::new(0.0, 0.0, 5.0), &up), None);
    assert_eq!(terrain.ray_cast(&Vector3::new(0.0, 0.0, -5.0), &-Vector3::z_axis()), None);
}

/// Centres and diameters of all features in a square around the origin.
fn features(classes: &[Scatter], half_m: f64) -> Vec<(Vector2<f64>, f64)> {
    let mut found = Vec::new();
    for class in classes {
        let step_m = 2.0 * class.smallest_m;
        let steps = (half_m / step_m).ceil() as i64;
        let mut all = std::collections::BTreeMap::new();
        for (i, j) in (-steps..=steps).flat_map(|i| (-steps..=steps).map(move |j| (i, j))) {
            for f in class.near(i as f64 * step_m, j as f64 * step_m) {
                all.insert([f.center_m.x.to_bits(), f.center_m.y.to_bits()], (f.center_m, f.diameter_m));
            }
        }
        found.extend(all.into_values().filter(|(c, _)| c.amax() < half_m));
    }
    found
}

#[test]
fn sizes_follow_their_power_law() {
    for exponent in [2.0, 2.8] {
        let classes = Scatter::classes([1.0, 16.0], 0.5, exponent, |index| [17 + index as u32, 99]);
        let all = features(&classes, 400.0);
        let larger = |than_m: f64| all.iter().filter(|(_, d)| *d > than_m).count() as f64;
        for diameter_m in [1.0, 1.5, 2.0, 3.0, 4.0] {
            // N(>D) - N(>16) is D^-b - 16^-b.
            let law = |d: f64| d.powf(-exponent) - 16.0_f64.powf(-exponent);
            let expected = larger(1.0) * law(diameter_m) / law(1.0);
            let off = (larger(diameter_m) - expected).abs();
            assert!(off < 4.0 * expected.sqrt() + 1.0, "{} of {expected} above {diameter_m} m", larger(diameter_m));
        }
    }
}

#[test]
fn features_show_at_every_place_that_they_reach() {
    let classes = Scatter::classes([1.0, 4.0], 0.5, 2.0, |index| [index as u32, 5]);
    let all = features(&classes, 60.0);
    assert!(all.len() > 500);
    for (center, diameter_m) in &all {
        for k in 0..8 {
            let angle = f64::from(k) * std::f64::consts::FRAC_PI_4 + 0.1;
            let at =
                center + Vector2::new(angle.cos(), angle.sin()) * (0.999 * 0.5 * diameter_m * Scatter::REACH_RADII);
            let seen = classes.iter().any(|c| c.near(at.x, at.y).any(|f| f.center_m == *center));
            assert!(seen, "the feature at {center} is missed at {at}");
        }
    }
}

#[test]
fn every_scale_has_texture_of_its_own() {
    let terrain = Terrain::new(&TerrainConfig::default(), 8);
    for footprint_m in [18.0, 2.0, 0.2, 0.02] {
        let detail = |footprint_m| GroundDetail { footprint_m, ..GroundDetail::default() };
        let mut random = random_stream(8, "scale", 0);
        let change = (0..500).map(|_| {
            let (x, y) = (random.random_range(-2e3..2e3), random.random_range(-2e3..2e3));
            let (fine, coarse) =
                (terrain.sample(x, y, &detail(footprint_m)), terrain.sample(x, y, &detail(4.0 * footprint_m)));
            (fine.gradient - coarse.gradient).norm()
        });
        let slope = rms(change);
        assert!((0.015..0.3).contains(&slope), "r.m.s. slope {slope} between 1 and 4 footprints of {footprint_m} m");
    }
}

#[test]
fn octaves_fade_in_smoothly() {
    let shown = |footprint_m| NoiseOctave::visibility(1.0, footprint_m);
    assert_eq!((shown(1.0), shown(0.1)), (0.0, 1.0));
    let steps: Vec<f64> = (0..1000).map(|k| shown(1.1 - 1e-3 * f64::from(k))).collect();
    assert!(steps.windows(2).all(|w| w[1] >= w[0] && w[1] - w[0] < 0.02));
}

#[test]
fn relief_has_no_preferred_direction() {
    let terrain = Terrain::new(&bare(), 21);
    let mut random = random_stream(21, "direction", 0);
    let gradients: Vec<Vector2<f64>> =
        (0..4000).map(|_| terrain.gradient(random.random_range(-1e4..1e4), random.random_range(-1e4..1e4))).collect();
    let along = |angle: f64| {
        let axis = Vector2::new(angle.cos(), angle.sin());
        rms(gradients.iter().map(|g| g.dot(&axis)))
    };
    let spread: Vec<f64> = (0..8).map(|k| along(f64::from(k) * std::f64::consts::FRAC_PI_8)).collect();
    let (low, high) = spread.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(*v), h.max(*v)));
    assert!(high / low < 1.08, "slopes by direction: {spread:?}");
}

#[test]
fn bad_parameters_are_named() {
    let refused = |config: TerrainConfig| config.validate().expect_err("refused").to_string();
    assert!(refused(TerrainConfig { hurst: 1.5, ..TerrainConfig::default() }).contains("hurst is 1.5"));
    assert!(refused(TerrainConfig { albedo: f64::NAN, ..TerrainConfig::default() }).contains("albedo is NaN"));
    let upside_down =
        TerrainConfig { smallest_wavelength_m: 50.0, largest_wavelength_m: 5.0, ..TerrainConfig::default() };
    assert!(refused(upside_down).contains("smallest_wavelength_m"));
    assert_eq!(TerrainConfig::default().validate(), Ok(()));
}
