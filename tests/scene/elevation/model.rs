//! Elevation models in the site frame: interpolation, curvature, unknown posts, borders, and terrain on top of them.

use nalgebra::{Unit, Vector2, Vector3};
use opnav::scene::{
    AlbedoValues, ElevationModel, Georeference, GroundBase, GroundDetail, MapPlace, Orthoimage, Raster, Terrain,
    TerrainConfig,
};
use opnav::stats::random_stream;
use rand::RngExt;

const MARS_M: f64 = 3_396_190.0;

fn raster(georeference: Georeference, [columns, rows]: [usize; 2], height: impl Fn(f64, f64) -> f64) -> Raster {
    let at = |i: usize| height((i % columns) as f64, (i / columns) as f64) as f32;
    Raster { columns, values: (0..columns * rows).map(at).collect(), georeference }
}

fn metres(step_m: f64) -> Georeference {
    Georeference::Metres { first_m: [5000.0, -300.0], step_m: [step_m, 0.8 * step_m] }
}

fn degrees(step_deg: f64, first_deg: [f64; 2]) -> Georeference {
    Georeference::Degrees { first_deg, step_deg: [step_deg; 2], radius_m: MARS_M }
}

fn rough(column: f64, row: f64) -> f64 {
    -2500.0 + 90.0 * (1.7 * column).sin() * (1.1 * row).cos() + 30.0 * (0.31 * column * row).sin()
}

/// A place in the site frame of a point at a latitude, longitude and height, by spherical geometry written out anew.
fn tangent_m(site_deg: [f64; 2], site_height_m: f64, place_deg: [f64; 2], height_m: f64) -> Vector3<f64> {
    let on_sphere = |[lat, lon]: [f64; 2], radius_m: f64| {
        let (lat, lon) = (lat.to_radians(), lon.to_radians());
        Vector3::new(lat.cos() * lon.cos(), lat.cos() * lon.sin(), lat.sin()) * radius_m
    };
    let site = on_sphere(site_deg, MARS_M + site_height_m);
    let offset = on_sphere(place_deg, MARS_M + height_m) - site;
    let up = site.normalize();
    let east = Vector3::z().cross(&up).normalize();
    Vector3::new(offset.dot(&east), offset.dot(&up.cross(&east)), offset.dot(&up))
}

#[test]
fn posts_on_a_plane_are_met_exactly() {
    let site = MapPlace::Metres { x_m: 5000.0 + 7.0 * 20.0, y_m: -300.0 - 6.0 * 16.0 };
    let model = ElevationModel::new(raster(metres(20.0), [15, 13], rough), Some(&site)).unwrap();
    let site_m = f64::from(rough(7.0, 6.0) as f32);
    let mut most_m = 0.0_f64;
    for (column, row) in [(0, 0), (7, 6), (14, 12), (3, 11)].map(|(c, r)| (f64::from(c), f64::from(r))) {
        let (height_m, _) = model.sample((column - 7.0) * 20.0, (6.0 - row) * 16.0, 0.0);
        assert!((height_m - (f64::from(rough(column, row) as f32) - site_m)).abs() < 1e-9);
        let (shifted_m, _) = model.sample((column - 6.5) * 20.0, (6.0 - row) * 16.0, 0.0);
        most_m = most_m.max((shifted_m - height_m).abs());
    }
    assert!(most_m > 20.0, "half a post away it is another height");
    assert_eq!(model.summary().posts, [15, 13]);
    assert_eq!(model.summary().post_m, [20.0, 16.0]);
}

#[test]
fn posts_on_a_sphere_lie_at_their_latitude_and_longitude() {
    let first_deg = [137.0, -4.0];
    let raster = raster(degrees(0.25, first_deg), [40, 32], rough);
    let site = MapPlace::Degrees { latitude_deg: -6.1, longitude_deg: 141.3 - 360.0 };
    let model = ElevationModel::new(raster, Some(&site)).unwrap();
    let (mut most_m, mut round_m) = (0.0_f64, 0.0_f64);
    for (column, row) in [(0.0, 0.0), (12.0, 20.0), (39.0, 31.0), (17.0, 8.0)] {
        let place_deg = [first_deg[1] - 0.25 * row, first_deg[0] + 0.25 * column];
        let height_m = f64::from(rough(column, row) as f32);
        let expected_m = tangent_m([-6.1, 141.3], model.summary().site_height_m, place_deg, height_m);
        let (found_m, _) = model.sample(expected_m.x, expected_m.y, 0.0);
        assert!((found_m - expected_m.z).abs() < 1e-5, "{found_m} for {expected_m}");
        let off_deg = [place_deg[0] - 0.125, place_deg[1]];
        let off_m = tangent_m([-6.1, 141.3], model.summary().site_height_m, off_deg, height_m);
        most_m = most_m.max((model.sample(off_m.x, off_m.y, 0.0).0 - off_m.z).abs());
        round_m = round_m.max((found_m - (height_m - model.summary().site_height_m)).abs());
    }
    assert!(most_m > 20.0, "half a post away it is another height");
    assert!(round_m > 1000.0, "the planet is round");
    assert!(model.sample(0.0, 0.0, 0.0).0.abs() < 1e-8);
}

#[test]
fn gradients_are_the_derivatives_of_heights() {
    let plane = ElevationModel::new(raster(metres(20.0), [15, 13], rough), None).unwrap();
    let round = ElevationModel::new(raster(degrees(0.25, [10.0, 60.0]), [15, 13], rough), None).unwrap();
    let mut random = random_stream(3, "gradient", 0);
    for (model, reach_m, step_m) in [(&plane, 120.0, 1e-4), (&round, 40_000.0, 1e-2)] {
        for _ in 0..400 {
            let (x, y) = (random.random_range(-reach_m..reach_m), random.random_range(-reach_m..reach_m));
            let height = |dx: f64, dy: f64| model.sample(x + dx, y + dy, 0.0).0;
            let numeric =
                Vector2::new(height(step_m, 0.0) - height(-step_m, 0.0), height(0.0, step_m) - height(0.0, -step_m))
                    / (2.0 * step_m);
            let (_, gradient) = model.sample(x, y, 0.0);
            assert!((gradient - numeric).norm() < 1e-5 * (1.0 + numeric.norm()), "{gradient} for {numeric}");
            assert!((gradient + numeric).norm() > (gradient - numeric).norm(), "the sign is told");
        }
    }
}

#[test]
fn gradients_are_continuous_across_posts() {
    let model = ElevationModel::new(raster(metres(20.0), [15, 13], rough), None).unwrap();
    for k in 0..100 {
        let (x, y) = (20.0 * f64::from(k % 10 - 5), 0.37 * f64::from(k));
        let (before, after) = (model.sample(x - 1e-7, y, 0.0).1, model.sample(x + 1e-7, y, 0.0).1);
        assert!((before - after).norm() < 1e-6, "{before} {after}");
    }
}

#[test]
fn a_global_map_goes_around() {
    let raster = raster(degrees(4.0, [2.0, 88.0]), [90, 45], |c, _| 1000.0 * (c * 4.0_f64.to_radians()).cos());
    let site = MapPlace::Degrees { latitude_deg: 0.0, longitude_deg: -2.0 };
    let model = ElevationModel::new(raster, Some(&site)).unwrap();
    // The cosine is even about column 0, longitude 2: 4° east of the site.
    let height_m = |longitude_deg: f64| {
        let place = tangent_m([0.0, -2.0], model.summary().site_height_m, [0.0, longitude_deg], 1000.0);
        let (z_m, _) = model.sample(place.x, place.y, 0.0);
        (place.xy().push(z_m + MARS_M + model.summary().site_height_m)).norm() - MARS_M
    };
    assert!((height_m(8.0) - height_m(-4.0)).abs() < 0.5, "{} {}", height_m(8.0), height_m(-4.0));
    assert!((height_m(2.0) - 1000.0).abs() < 1.0);
}

#[test]
fn unknown_posts_are_filled_smoothly_and_counted() {
    let plane = |c: f64, r: f64| 3.0 * c - 2.0 * r;
    let hole = |c: f64, r: f64| if (c - 20.0).hypot(r - 18.0) < 7.5 { f64::NAN } else { plane(c, r) };
    let site = MapPlace::Metres { x_m: 5000.0 + 300.0, y_m: -300.0 - 144.0 };
    let model = ElevationModel::new(raster(metres(10.0), [41, 37], hole), Some(&site)).unwrap();
    assert_eq!(model.summary().filled_posts, 177);
    let whole = ElevationModel::new(raster(metres(10.0), [41, 37], plane), Some(&site)).unwrap();
    assert_eq!(whole.summary().filled_posts, 0);
    for k in 0..200 {
        let (x, y) = (f64::from(k % 20) * 9.0 - 190.0, f64::from(k / 20) * 8.0 - 40.0);
        let filled_m = model.sample(x, y, 0.0).0 + model.summary().site_height_m;
        let true_m = whole.sample(x, y, 0.0).0 + whole.summary().site_height_m;
        assert!((filled_m - true_m).abs() < 2.0, "{filled_m} for {true_m} at {x}, {y}");
    }
}

#[test]
fn beyond_the_border_the_ground_goes_on_level() {
    let model = ElevationModel::new(raster(metres(20.0), [15, 13], rough), None).unwrap();
    let edge_m = model.sample(7.0 * 20.0, 0.0, 0.0).0;
    let (far_m, gradient) = model.sample(5e4, 0.0, 0.0);
    assert!((far_m - edge_m).abs() < 1e-9 && gradient.x.abs() < 1e-9);
    assert!(model.covers(&Vector3::new(139.0, 0.0, 9.0)) && !model.covers(&Vector3::new(141.0, 0.0, 9.0)));
}

#[test]
fn a_coarse_look_does_not_alias() {
    // Waves of two posts: an eye that resolves 32 posts sees no slope.
    let model = ElevationModel::new(raster(metres(1.0), [129, 129], |c, _| 5.0 * (c * 3.0).sin()), None).unwrap();
    let model = &model;
    let steep = |finest_m: f64| (0..50).map(move |k| model.sample(0.83 * f64::from(k) - 20.0, 3.0, finest_m).1.norm());
    assert!(steep(0.0).fold(0.0, f64::max) > 2.0);
    assert!(steep(64.0).fold(0.0, f64::max) < 0.05);
}

#[test]
fn sites_outside_and_of_another_map_are_refused() {
    let refused = |georeference, site: MapPlace| {
        ElevationModel::new(raster(georeference, [15, 13], rough), Some(&site)).expect_err("refused").to_string()
    };
    let outside = refused(metres(20.0), MapPlace::Metres { x_m: 0.0, y_m: 0.0 });
    assert!(outside.contains("descent.elevation.site is x 0.0 m") && outside.contains("covers"), "{outside}");
    let outside = refused(degrees(0.25, [10.0, 60.0]), MapPlace::Degrees { latitude_deg: 61.0, longitude_deg: 11.0 });
    assert!(outside.contains("latitude 61"), "{outside}");
    let other = refused(metres(20.0), MapPlace::Degrees { latitude_deg: 0.0, longitude_deg: 0.0 });
    assert!(other.contains("map's middle is x 5140.0 m"), "{other}");
}

#[test]
fn a_site_without_data_is_refused() {
    let hole = |c: f64, r: f64| if (c - 7.0).hypot(r - 6.0) < 3.0 { f64::NAN } else { 5.0 };
    let error = ElevationModel::new(raster(metres(20.0), [15, 13], hole), None).expect_err("refused").to_string();
    assert!(error.contains("descent.elevation.site is x 5140.0 m") && error.contains("holds data"), "{error}");
}

fn base(model: ElevationModel, relief_detail: bool) -> GroundBase {
    GroundBase { elevation: Some(model), orthoimage: None, relief_detail, albedo_detail: true }
}

#[test]
fn detail_is_added_below_two_posts_only() {
    let flat = || ElevationModel::new(raster(metres(50.0), [41, 41], |_, _| 700.0), None).unwrap();
    let config = TerrainConfig::default();
    let bare = Terrain::on_base(&config, base(flat(), false), 4);
    let detailed = Terrain::on_base(&config, base(flat(), true), 4);
    assert!(bare.octaves().iter().all(|o| o.relief_m == 0.0));
    assert!(detailed.octaves().iter().all(|o| (o.relief_m == 0.0) == (o.wavelength_m > 50.0)));
    assert_eq!(detailed.height_m(0.0, 0.0), 0.0);
    let mut random = random_stream(5, "place", 0);
    let mut most_m = 0.0_f64;
    for _ in 0..300 {
        let (x, y) = (random.random_range(-900.0..900.0), random.random_range(-900.0..900.0));
        assert!(bare.height_m(x, y).abs() < 1e-9);
        most_m = most_m.max(detailed.height_m(x, y).abs());
    }
    let procedural = Terrain::new(&config, 4);
    assert!((0.5..30.0).contains(&most_m), "{most_m} m");
    assert!(procedural.octaves()[0].wavelength_m > 50.0 && procedural.octaves()[0].relief_m > 0.0);
}

#[test]
fn rays_meet_a_high_mountain() {
    // A cone of 15 km, steeper and higher than procedural ground is.
    let cone = |c: f64, r: f64| 15_000.0 - 600.0 * (c - 20.0).hypot(r - 20.0);
    let site = MapPlace::Metres { x_m: 5000.0, y_m: -300.0 };
    let model = ElevationModel::new(raster(metres(150.0), [41, 41], cone), Some(&site)).unwrap();
    let terrain = Terrain::on_base(&TerrainConfig::default(), base(model, false), 1);
    let origin = Vector3::new(0.0, -2400.0, 9000.0);
    let direction = Unit::new_normalize(Vector3::new(1.0, 0.0, 0.08));
    let range_m = terrain.ray_cast(&origin, &direction).expect("the mountain is in the way");
    let hit = origin + direction.as_ref() * range_m;
    assert!((hit.z - terrain.height_m(hit.x, hit.y)).abs() < 1e-5, "{hit}");
    let mut random = random_stream(6, "bound", 0);
    for _ in 0..300 {
        let middle = Vector2::new(random.random_range(0.0..6e3), random.random_range(-5e3..0.0));
        let half_m = 10.0_f64.powf(random.random_range(0.0..3.5));
        let bound_m = terrain.relief_bound_m(&middle, half_m);
        let at = middle + Vector2::from_fn(|_, _| random.random_range(-half_m..half_m));
        let departure_m = (terrain.height_m(at.x, at.y) - terrain.height_m(middle.x, middle.y)).abs();
        assert!(departure_m <= bound_m, "{departure_m} m, bound {bound_m} m");
        assert!(terrain.gradient(at.x, at.y).norm() < terrain.steepest(1e4));
        assert!(terrain.height_m(at.x, at.y) <= terrain.highest_m());
    }
}

#[test]
fn orthoimages_change_the_albedo() {
    let picture = || raster(metres(20.0), [15, 13], |c, _| if c < 7.0 { 50.0 } else { 150.0 });
    let config = TerrainConfig { albedo: 0.2, ..TerrainConfig::default() };
    let terrain = |values| {
        let orthoimage = Orthoimage::new(picture(), (None, 0.0), (values, config.albedo)).unwrap();
        let base = GroundBase { orthoimage: Some(orthoimage), ..GroundBase::default() };
        Terrain::on_base(&config, base, 1)
    };
    let relative = terrain(AlbedoValues::Relative);
    let mean = (7.0 * 50.0 + 8.0 * 150.0) / 15.0;
    assert!((relative.albedo(-100.0, 0.0) - 0.2 * 50.0 / mean).abs() < 1e-6);
    assert!((relative.albedo(100.0, 0.0) - 0.2 * 150.0 / mean).abs() < 1e-6);
    assert_eq!(relative.albedo(1e4, 0.0), 0.2, "far outside the ground has its mean albedo");
    let (edge, beyond) = (relative.albedo(140.0, 0.0), relative.albedo(140.0 + 8.0 * 20.0, 0.0));
    assert!((beyond - 0.5 * (edge + 0.2)).abs() < 1e-6, "half-way it is in between");
    let mut reflecting = picture();
    reflecting.values.iter_mut().for_each(|v| *v /= 500.0);
    let orthoimage = Orthoimage::new(reflecting, (None, 0.0), (AlbedoValues::Absolute, config.albedo)).unwrap();
    let base = GroundBase { orthoimage: Some(orthoimage), ..GroundBase::default() };
    let absolute = Terrain::on_base(&config, base, 1);
    assert!((absolute.albedo(-100.0, 0.0) - 0.1).abs() < 1e-6 && (absolute.albedo(100.0, 0.0) - 0.3).abs() < 1e-6);
    let detail = GroundDetail { height_m: 2e3, ..GroundDetail::default() };
    assert!(relative.sample(-100.0, 0.0, &detail).albedo_change.abs() < 0.6, "from afar it is blurred");
}

#[test]
fn bounds_hold_and_are_local() {
    let cliff = |c: f64, r: f64| if c > 60.0 { 900.0 } else { 0.0 } + 3.0 * (1.1 * r + 0.3 * c).sin();
    let plane = ElevationModel::new(raster(metres(10.0), [121, 101], cliff), None).unwrap();
    let round = ElevationModel::new(raster(degrees(0.01, [10.0, 60.0]), [121, 101], cliff), None).unwrap();
    let mut random = random_stream(8, "bounds", 0);
    for (model, reach_m) in [(&plane, 700.0), (&round, 40_000.0)] {
        for _ in 0..500 {
            let middle = Vector2::from_fn(|_, _| random.random_range(-reach_m..reach_m));
            let radius_m = reach_m * 10.0_f64.powf(random.random_range(-3.0..0.0));
            let bound_m = model.relief_bound_m(&middle, radius_m);
            let at_m = model.sample(middle.x, middle.y, 0.0).0;
            for _ in 0..20 {
                let angle = random.random_range(0.0..std::f64::consts::TAU);
                let p = middle + Vector2::new(angle.cos(), angle.sin()) * radius_m * random.random_range(0.0..1.0);
                let departure_m = (model.sample(p.x, p.y, 0.0).0 - at_m).abs();
                assert!(departure_m <= bound_m, "{departure_m} m in {radius_m} m around {middle}, bound {bound_m} m");
                assert!(model.sample(p.x, p.y, 0.0).1.norm() <= model.steepest(1e5));
            }
        }
    }
    // Away from the cliff the ground is known to be gentle.
    let (near_m, far_m) = (Vector2::new(10.0, 0.0), Vector2::new(-400.0, 0.0));
    assert!(plane.relief_bound_m(&near_m, 20.0) > 900.0 && plane.relief_bound_m(&far_m, 20.0) < 40.0);
}
