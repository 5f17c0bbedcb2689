//! Star catalogues and their light.

use super::{scenario, tumbling};
use nalgebra::Vector3;
use opnav::geometry::Camera;
use opnav::scene::{Scene, Sky, Star};

const SMALL: &str = "[tumbling]\nframes = 1\n[tumbling.shape.procedural]\nsubdivisions = 3\n";

fn separation_deg(a: &Star, b: &Star) -> f64 {
    a.direction.cross(&b.direction).norm().atan2(a.direction.dot(&b.direction)).to_degrees()
}

#[test]
fn the_built_in_stars_stand_where_they_do() {
    let stars = Star::brightest();
    assert!(stars.len() > 90, "{} stars", stars.len());
    assert!(stars.windows(2).all(|pair| pair[0].magnitude <= pair[1].magnitude), "brightest first");
    let with = |magnitude: f64, declination_deg: f64| {
        let sine = declination_deg.to_radians().sin();
        let near = |s: &&Star| (s.magnitude - magnitude).abs() < 0.02 && (s.direction.z - sine).abs() < 2e-3;
        *stars.iter().find(near).expect("a star")
    };
    let (sirius, polaris) = (with(-1.44, -16.716), with(1.97, 89.264));
    assert_eq!(sirius, stars[0]);
    assert!(separation_deg(&polaris, &Star { direction: Vector3::z_axis(), magnitude: 0.0 }) < 0.75);
    // Well-known distances: Castor and Pollux 4.51°, Dubhe and Merak 5.37°, Mintaka and Alnitak in Orion's belt 2.74°.
    for (a, b, expected_deg) in [
        (with(1.58, 31.888), with(1.16, 28.026), 4.51),
        (with(1.81, 61.751), with(2.34, 56.382), 5.37),
        (with(2.25, -0.299), with(1.74, -1.943), 2.74),
    ] {
        let found = separation_deg(&a, &b);
        assert!((found - expected_deg).abs() < 0.01, "{found}° for {expected_deg}°");
    }
    for (index, star) in stars.iter().enumerate() {
        assert!(stars[..index].iter().all(|other| separation_deg(star, other) > 0.01), "{star:?} stands there twice");
    }
}

#[test]
fn light_falls_by_magnitudes_and_follows_the_sun() {
    let camera = Camera::from_fov(1024, 1024, 0.5);
    let sky = |zero_point_if_px, sun_distance_au| Sky { stars: Vec::new(), zero_point_if_px, sun_distance_au };
    let star = |magnitude| Star { direction: Vector3::x_axis(), magnitude };
    let given = sky(Some(3.0), 1.0);
    assert!((given.light_if_px(&star(0.0), &camera) - 3.0).abs() < 1e-12);
    assert!((given.light_if_px(&star(5.0), &camera) - 0.03).abs() < 1e-12);
    // The Sun itself, seen as a star: its irradiance E over the radiance E/π, in pixels of 1/f².
    let sun = sky(None, 1.0).light_if_px(&star(-26.74), &camera);
    assert!((sun / (std::f64::consts::PI * camera.focal_px.x.powi(2)) - 1.0).abs() < 1e-9);
    // Farther from the Sun the body is darker, so stars are brighter beside it.
    let far = sky(None, 2.0).light_if_px(&star(1.0), &camera);
    assert!((far / sky(None, 1.0).light_if_px(&star(1.0), &camera) - 4.0).abs() < 1e-9);
}

#[test]
fn skies_are_black_unless_asked_for() {
    assert!(tumbling(SMALL).sky.stars.is_empty());
    let all = tumbling(&format!("{SMALL}[tumbling.sky]\nstars = true")).sky;
    assert_eq!(all.stars, Star::brightest());
    let bright = tumbling(&format!("{SMALL}[tumbling.sky]\nstars = true\nfaintest_magnitude = 0.2")).sky;
    assert_eq!(bright.stars.len(), 7, "Sirius to Rigel");
    let day = scenario("[descent.sky]\nstars = true").expect_err("no stars by day").to_string();
    assert!(day.contains("sky"), "{day}");
    let negative = scenario("[tumbling.sky]\nzero_point_if_px = 0").expect_err("refused").to_string();
    assert!(negative.contains("tumbling.sky.zero_point_if_px"), "{negative}");
}

#[test]
fn catalogues_are_read_and_their_faults_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let build = |csv: &str| {
        std::fs::write(folder.path().join("stars.csv"), csv).expect("written");
        let text = format!(
            "{}[tumbling.sky]\nstars = true\ncatalogue = \"stars.csv\"\n",
            SMALL.replace("frames = 1", "frames = 1\ninertial_from_icrf = [0, 1, 0, 0]")
        );
        scenario(&text).expect("a scenario").build(folder.path())
    };
    let Ok(Scene::Tumbling(scene)) = build("# two\nra_deg,dec_deg,magnitude,name\n90, 0, 2.5, a\n0, 30, 1, b\n") else {
        panic!("not a body")
    };
    // Turned by half a turn around x.
    let expected = [Vector3::new(0.0, -1.0, 0.0), Vector3::new(30.0_f64.to_radians().cos(), 0.0, -0.5)];
    for (star, expected) in scene.sky.stars.iter().zip(expected) {
        assert!((star.direction.as_ref() - expected).norm() < 1e-12, "{star:?}");
    }
    assert_eq!(scene.sky.stars.iter().map(|s| s.magnitude).collect::<Vec<_>>(), [2.5, 1.0]);
    for (csv, fault) in [
        ("ra_deg,dec_deg\n1,2\n", "magnitude"),
        ("ra_deg,dec_deg,magnitude\n1,2,3\n1,two,3\n", "line 3"),
        ("ra_deg,dec_deg,magnitude\n1,95,3\n", "dec_deg 95"),
    ] {
        let message = build(csv).expect_err("refused").to_string();
        assert!(message.contains("stars.csv") && message.contains(fault), "{csv}: {message}");
    }
    std::fs::remove_file(folder.path().join("stars.csv")).expect("removed");
    let text = format!("{SMALL}[tumbling.sky]\nstars = true\ncatalogue = \"stars.csv\"\n");
    let message = scenario(&text).expect("a scenario").build(folder.path()).expect_err("missing").to_string();
    assert!(message.contains("stars.csv"), "{message}");
}
