//! Craters, rocks, ripples and geological units: their laws, shapes and gradients.

use super::{features, rms};
use nalgebra::Vector2;
use opnav::scene::{
    CraterClass, Feature, FeatureSample, GroundDetail, Scatter, Terrain, TerrainConfig, rock_density_1_m2,
};
use opnav::stats::random_stream;
use rand::RngExt;

/// Golombek's cumulative share of the ground covered by rocks of at least a diameter.
fn golombek(abundance: f64, diameter_m: f64) -> f64 {
    abundance * (-(1.79 + 0.152 / abundance) * diameter_m).exp()
}

#[test]
fn rocks_cover_what_golombeks_law_says() {
    for abundance in [0.05, 0.1, 0.3] {
        let classes = Scatter::classes_of_density(
            [0.0625, 4.0],
            |diameter_m| rock_density_1_m2(abundance, diameter_m),
            |index| [23 + index as u32, 7],
        );
        let half_m = 60.0;
        let all = features(&classes, half_m);
        let share = |least_m: f64| {
            let covered = all.iter().filter(|(_, d)| *d >= least_m).map(|(_, d)| 0.25 * std::f64::consts::PI * d * d);
            covered.sum::<f64>() / (4.0 * half_m * half_m)
        };
        for least_m in [0.0625, 0.1, 0.2, 0.3] {
            let expected = golombek(abundance, least_m) - golombek(abundance, 4.0);
            let off = share(least_m) / expected - 1.0;
            println!("k {abundance}, D >= {least_m} m: {:.5}, law {expected:.5}", share(least_m));
            assert!(off.abs() < 0.06, "k {abundance}, D >= {least_m} m: off by {off:.3}");
            // The check can tell a tenth more rocks.
            assert!((share(least_m) / (golombek(1.1 * abundance, least_m)) - 1.0).abs() > 0.06);
        }
    }
}

#[test]
fn the_ground_stands_up_where_rocks_are() {
    let rocky = TerrainConfig { rock_abundance: 0.1, site_slope: 1.0, ..TerrainConfig::level() };
    let terrain = Terrain::new(&rocky, 4);
    let mut random = random_stream(4, "rocks", 0);
    let (mut covered, mut steep, mut count) = (0.0, 0.0, 0.0);
    let mut highest_m: f64 = 0.0;
    for _ in 0..200_000 {
        let at = Vector2::from_fn(|_, _| random.random_range(100.0..2000.0));
        let ground = terrain.sample(at.x, at.y, &GroundDetail::default());
        count += 1.0;
        if ground.height_m > 0.0 {
            covered += 1.0;
            steep += f64::from(u8::from(ground.gradient.norm() > 1.0));
            highest_m = highest_m.max(ground.height_m);
        }
    }
    let expected = golombek(0.1, rocky.smallest_rock_m) - golombek(0.1, rocky.largest_rock_m);
    // The classes end at the first octave that would begin below the smallest rock.
    let share = covered / count;
    println!("share under rocks {share:.4}, law {expected:.4}; {:.2} of it steep", steep / covered);
    assert!((share / expected - 1.0).abs() < 0.12, "share {share} for {expected}");
    assert!(steep / covered > 0.3, "rocks have steep sides");
    assert!(highest_m > 0.3 && highest_m < 0.7 * rocky.largest_rock_m, "highest rock {highest_m} m");
}

/// Height and gradient that one crater of 10 m gives at `t` radii from its centre.
fn crater(age: f64, t: f64) -> FeatureSample {
    let scatter = Scatter::classes([8.0, 16.0], 0.5, 2.0, |_| [0, 0]).remove(0);
    let class = CraterClass { scatter, depth_ratio: 0.2, site_slope: 10.0, albedo_contrast: 0.3 };
    let feature = Feature { center_m: Vector2::new(900.0, 0.0), diameter_m: 10.0, random: [age, 0.5, 0.5, 0.5] };
    let mut total = FeatureSample::default();
    class.add(&feature, &mut total, 900.0 + 5.0 * t, 0.0);
    total
}

#[test]
fn craters_age_from_sharp_bowls_to_shallow_dishes() {
    let depth_over_diameter = |age| (crater(age, 1.0).height_m - crater(age, 0.0).height_m) / 10.0;
    let rim_over_diameter = |age| crater(age, 1.0).height_m / 10.0;
    assert!((depth_over_diameter(1.0) - 0.2).abs() < 0.01, "fresh depth {}", depth_over_diameter(1.0));
    assert!((rim_over_diameter(1.0) - 0.04).abs() < 0.005, "fresh rim {}", rim_over_diameter(1.0));
    assert!(depth_over_diameter(0.0) < 0.025 && depth_over_diameter(0.0) > 0.005);
    let ages: Vec<f64> = (0..=20).map(|k| depth_over_diameter(f64::from(k) / 20.0)).collect();
    assert!(ages.windows(2).all(|w| w[1] >= w[0]), "younger craters are deeper: {ages:?}");
    // Ejecta thin with the third power of the distance, then end.
    let ejecta = |t: f64| crater(1.0, t).height_m;
    assert!((ejecta(1.2) / ejecta(1.0) * 1.2_f64.powi(3) - 1.0).abs() < 0.12);
    assert_eq!(ejecta(2.01), 0.0);
    // Fresh walls are steep, old ones are not.
    let steepest = |age| (0..200).map(|k| crater(age, f64::from(k) / 100.0).gradient.norm()).fold(0.0, f64::max);
    assert!(steepest(1.0) > 0.5 && steepest(1.0) < 1.2, "fresh wall {}", steepest(1.0));
    assert!(steepest(0.0) < 0.15, "old wall {}", steepest(0.0));
}

#[test]
fn ripples_cover_their_share_and_no_more_than_their_height() {
    let config = TerrainConfig {
        ripple_cover: 0.3,
        largest_ripple_m: 4.0,
        smallest_ripple_m: 4.0,
        site_slope: 1.0,
        ..TerrainConfig::level()
    };
    let (mut sandy, mut count, mut highest_m) = (0.0, 0.0, 0.0_f64);
    for seed in 0..6 {
        let terrain = Terrain::new(&config, seed);
        let mut random = random_stream(seed, "sand", 0);
        for _ in 0..5000 {
            let at = Vector2::from_fn(|_, _| random.random_range(50.0..6000.0));
            let height_m = terrain.height_m(at.x, at.y);
            highest_m = highest_m.max(height_m);
            sandy += f64::from(u8::from(height_m > 0.0));
            count += 1.0;
        }
    }
    println!("share {:.3}, highest {highest_m:.3} m", sandy / count);
    assert!((sandy / count - 0.3).abs() < 0.05, "share {}", sandy / count);
    assert!((highest_m / (4.0 * config.ripple_height_ratio) - 1.0).abs() < 0.05, "height {highest_m}");
}

#[test]
fn units_divide_the_ground_into_light_and_dark_with_scarps_between() {
    let config = TerrainConfig {
        unit_contrast: 0.3,
        scarp_ratio: 0.01,
        largest_unit_m: 1000.0,
        smallest_unit_m: 1000.0,
        albedo_contrast: 0.0,
        site_slope: 0.2,
        ..TerrainConfig::level()
    };
    let (mut upper, mut contact, mut count) = (0.0, 0.0, 0.0);
    for seed in 0..8 {
        let terrain = Terrain::new(&config, seed);
        let mut random = random_stream(seed, "unit", 0);
        for _ in 0..4000 {
            let at = Vector2::from_fn(|_, _| random.random_range(500.0..2e4));
            let ground = terrain.sample(at.x, at.y, &GroundDetail::default());
            count += 1.0;
            if (ground.albedo_change.abs() - 0.15).abs() > 1e-9 {
                contact += 1.0;
                assert!(ground.gradient.norm() < 4.0, "slope {}", ground.gradient.norm());
                continue;
            }
            // The light side is the upper one.
            upper += f64::from(u8::from(ground.height_m > 0.0));
            assert_eq!(ground.height_m > 0.0, ground.albedo_change > 0.0);
            assert!(ground.height_m.abs() > 4.5 && ground.height_m.abs() < 5.0, "height {}", ground.height_m);
        }
    }
    println!("upper {:.3}, contact {:.3}", upper / count, contact / count);
    assert!((upper / count - 0.5).abs() < 0.1);
    assert!(contact / count > 0.01 && contact / count < 0.15);
}

#[test]
fn gradients_of_all_features_are_the_derivatives_of_heights() {
    let mut random = random_stream(12, "gradient", 0);
    let terrain = Terrain::new(&TerrainConfig::default(), 12);
    let (mut off, mut off_scaled, mut steep) = (0, 0, Vec::new());
    const PLACES: usize = 4000;
    for _ in 0..PLACES {
        let reach_m = 10.0_f64.powf(random.random_range(0.0..3.5));
        let (x, y) = (random.random_range(-reach_m..reach_m), random.random_range(-reach_m..reach_m));
        let step_m = 2e-5;
        let slope =
            |dx: f64, dy: f64| (terrain.height_m(x + dx, y + dy) - terrain.height_m(x - dx, y - dy)) / (2.0 * step_m);
        let numeric = Vector2::new(slope(step_m, 0.0), slope(0.0, step_m));
        let gradient = terrain.gradient(x, y);
        off += usize::from((gradient - numeric).norm() > 1e-4);
        off_scaled += usize::from((gradient * 1.02 - numeric).norm() > 1e-4);
        steep.push(numeric.norm());
    }
    // The edges of rocks and fresh rims are creases.
    assert!(off <= PLACES / 1000, "{off} of {PLACES} gradients are off");
    assert!(off_scaled > PLACES * 9 / 10, "the test cannot tell 2 % of slope: {off_scaled}");
    assert!(rms(steep.into_iter()) > 0.1);
}

#[test]
fn relief_has_the_chosen_hurst_exponent() {
    for hurst in [0.5, 0.75, 0.9] {
        let config = TerrainConfig { hurst, rms_slope: 0.1, ..TerrainConfig::default() }.without_features();
        // R.m.s. height difference over a distance: distance to the power of the exponent.
        let difference_m = |distance_m: f64| {
            rms((0..6).flat_map(|seed| {
                let terrain = Terrain::new(&config, seed);
                let mut random = random_stream(seed, "structure", 0);
                (0..500)
                    .map(|_| {
                        let (x, y) = (random.random_range(-2e4..2e4), random.random_range(-2e4..2e4));
                        let angle = random.random_range(0.0..std::f64::consts::TAU);
                        terrain.height_m(x + distance_m * angle.cos(), y + distance_m * angle.sin())
                            - terrain.height_m(x, y)
                    })
                    .collect::<Vec<_>>()
            }))
        };
        let measured = (difference_m(256.0) / difference_m(1.0)).ln() / 256.0_f64.ln();
        println!("Hurst exponent {hurst}: {measured:.3}");
        assert!((measured - hurst).abs() < 0.06, "{measured} for {hurst}");
    }
}

#[test]
fn no_tile_repeats() {
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let mut random = random_stream(3, "repeat", 0);
    let places: Vec<Vector2<f64>> =
        (0..400).map(|_| Vector2::from_fn(|_, _| random.random_range(-1000.0..1000.0))).collect();
    let slopes = |shift: Vector2<f64>| -> Vec<f64> {
        places.iter().map(|p| terrain.gradient(p.x + shift.x, p.y + shift.y).x.clamp(-0.5, 0.5)).collect()
    };
    let here = slopes(Vector2::zeros());
    let correlation = |there: &[f64]| {
        here.iter().zip(there).map(|(a, b)| a * b).sum::<f64>() / here.iter().map(|a| a * a).sum::<f64>()
    };
    assert!(correlation(&here) > 0.999);
    for power in 4..18 {
        let shift_m = 2.0_f64.powi(power);
        for shift in [Vector2::new(shift_m, 0.0), Vector2::new(0.0, shift_m), Vector2::new(shift_m, shift_m)] {
            let found = correlation(&slopes(shift));
            assert!(found.abs() < 0.25, "the ground repeats after {shift}: correlation {found}");
        }
    }
}

#[test]
fn the_tallest_of_overlapping_rocks_is_seen() {
    let rocky = TerrainConfig { rock_abundance: 0.3, site_slope: 1.0, ..TerrainConfig::level() };
    let terrain = Terrain::new(&rocky, 4);
    let (low_m, high_m) = (Vector2::new(200.0, 200.0), Vector2::new(215.0, 215.0));
    let margin_m = rocky.largest_rock_m;
    let rocks = terrain.rocks_in(&low_m.add_scalar(-margin_m), &high_m.add_scalar(margin_m), [0.0, f64::INFINITY]);
    let bare = GroundDetail { rock_m: f64::INFINITY, ..GroundDetail::default() };
    let (mut stacked, mut random) = (0, random_stream(4, "stacks", 0));
    for _ in 0..5000 {
        let at = Vector2::new(random.random_range(low_m.x..high_m.x), random.random_range(low_m.y..high_m.y));
        let heights: Vec<f64> = rocks.iter().map(|r| r.sample(&at).height_m).filter(|h| *h > 0.0).collect();
        let tallest_m = heights.iter().copied().fold(0.0, f64::max);
        let found_m = terrain.height_m(at.x, at.y) - terrain.sample(at.x, at.y, &bare).height_m;
        assert!((found_m - tallest_m).abs() < 1e-9, "{found_m} m for {heights:?}");
        stacked += usize::from(heights.len() > 1);
    }
    assert!(stacked > 50, "only {stacked} places under several rocks");
}
