//! Where the Sun stands: angles, vectors, ephemerides.

use super::{descent, scenario, tumbling};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use opnav::scene::{EphemerisConfig, Scene, SceneError, sun_angular_radius_rad};

fn assert_along(found: &Unit<Vector3<f64>>, expected: Vector3<f64>) {
    let off_rad = found.cross(&expected.normalize()).norm();
    assert!(off_rad < 1e-9 && found.dot(&expected) > 0.0, "{found:?} for {expected:?}");
}

#[test]
fn the_disc_is_as_large_as_its_distance_says() {
    // From the Earth the Sun spans 0.533°, from Mars 0.35°.
    assert!((2.0 * sun_angular_radius_rad(1.0).to_degrees() - 0.5329).abs() < 1e-3);
    assert!((2.0 * sun_angular_radius_rad(1.52).to_degrees() - 0.3506).abs() < 1e-3);
    assert_eq!(sun_angular_radius_rad(0.0), 0.0);
    assert_eq!(descent("[descent]").sun_angular_radius_rad, sun_angular_radius_rad(1.52));
    assert_eq!(tumbling("[tumbling]").sun_angular_radius_rad, sun_angular_radius_rad(1.0));
    let point = descent("[descent.sun]\ndistance_au = 0");
    assert!(point.cameras[0].views.iter().all(|view| view.sun_angular_radius_rad == 0.0));
}

#[test]
fn vectors_go_before_angles() {
    let found = descent("[descent.sun]\nelevation_deg = 10\ndirection_in_site = [1, -2, 2]").sun_in_site;
    assert_along(&found, Vector3::new(1.0, -2.0, 2.0));
    let scene = tumbling("[tumbling.sun]\nphase_deg = 10\ndirection_in_inertial = [0, -3, -4]");
    assert_along(&scene.sun_in_spacecraft, Vector3::new(0.0, -3.0, -4.0));
    let view = &scene.cameras[0].views[17];
    assert_along(
        &(view.reference_from_camera.rotation.inverse() * view.sun_in_reference),
        Vector3::new(0.0, -3.0, -4.0),
    );
    for (text, key) in [
        ("[descent.sun]\ndirection_in_site = [0, 0, 0]", "descent.sun.direction_in_site"),
        ("[tumbling.sun]\ndirection_in_inertial = [0, nan, 1]", "tumbling.sun.direction_in_inertial"),
        ("[descent.sun]\nsite_from_icrf = [1, 1, 0, 0]", "descent.sun.site_from_icrf"),
        ("[tumbling]\ninertial_from_icrf = [0, 0, 0, 0]", "tumbling.inertial_from_icrf"),
        ("[descent.sun]\ndistance_au = -1", "descent.sun.distance_au"),
    ] {
        let message = scenario(text).expect_err("refused").to_string();
        assert!(message.contains(key), "{text}: {message}");
    }
}

/// A body's path over one day around J2000: place in km at noon, velocity in km/s, from the solar system's barycentre.
struct Path1 {
    body_id: i32,
    place_km: [f64; 3],
    velocity_km_s: [f64; 3],
}

const HALF_DAY_S: f64 = 43_200.0;

/// A file of SPK segments of type 2 (Chebyshev polynomials, here of degree 1), as NAIF's documents "DAF required reading"
/// and "SPK required reading" lay it out.
fn spk_file(paths: &[Path1]) -> Vec<u8> {
    const RECORD: usize = 1024;
    const FIRST_DATA_WORD: i32 = 385;
    let data: Vec<f64> = paths.iter().flat_map(segment).collect();
    let words = segment(&paths[0]).len() as i32;

    let mut file = vec![0_u8; 3 * RECORD];
    let mut put = |at: usize, bytes: &[u8]| file[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, b"DAF/SPK ");
    put(8, &2_u32.to_le_bytes());
    put(12, &6_u32.to_le_bytes());
    put(16, format!("{:60}", "made for a test").as_bytes());
    put(76, &2_u32.to_le_bytes());
    put(80, &2_u32.to_le_bytes());
    put(84, &((FIRST_DATA_WORD as u32) + data.len() as u32).to_le_bytes());
    put(88, b"LTL-IEEE");
    put(699, b"FTPSTR:\r:\n:\r\n:\r\x00:\x81:\x10\xce:ENDFTP");
    // Summary record: next, previous, number of summaries.
    put(RECORD + 16, &(paths.len() as f64).to_le_bytes());
    for (index, path) in paths.iter().enumerate() {
        let at = RECORD + 24 + 40 * index;
        put(at, &(-HALF_DAY_S).to_le_bytes());
        put(at + 8, &HALF_DAY_S.to_le_bytes());
        let first = FIRST_DATA_WORD + words * index as i32;
        for (k, number) in [path.body_id, 0, 1, 2, first, first + words - 1].into_iter().enumerate() {
            put(at + 16 + 4 * k, &number.to_le_bytes());
        }
    }
    put(2 * RECORD, &[b' '; RECORD]);
    file.extend(data.iter().flat_map(|v| v.to_le_bytes()));
    file.resize(file.len().next_multiple_of(RECORD), 0);
    file
}

fn segment(path: &Path1) -> Vec<f64> {
    let mut data = vec![0.0, HALF_DAY_S];
    for axis in 0..3 {
        data.extend([path.place_km[axis], path.velocity_km_s[axis] * HALF_DAY_S]);
    }
    data.extend([-HALF_DAY_S, 2.0 * HALF_DAY_S, 8.0, 1.0]);
    data
}

fn kernel_folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let sun = Path1 { body_id: 10, place_km: [1e6, 0.0, 0.0], velocity_km_s: [0.0, 0.0, 0.0] };
    let mars = Path1 { body_id: 499, place_km: [2e8, 1e8, -3e7], velocity_km_s: [-10.0, 20.0, 5.0] };
    std::fs::write(folder.path().join("made.bsp"), spk_file(&[sun, mars])).expect("written");
    folder
}

fn ephemeris(epoch: &str) -> EphemerisConfig {
    EphemerisConfig { kernels: vec!["made.bsp".into()], observer_id: 499, sun_id: 10, epoch: epoch.into() }
}

fn sun_from_mars_km(seconds: f64) -> Vector3<f64> {
    let mars = Vector3::new(2e8, 1e8, -3e7) + Vector3::new(-10.0, 20.0, 5.0) * seconds;
    Vector3::new(1e6, 0.0, 0.0) - mars
}

#[test]
fn the_ephemeris_says_where_the_sun_stands() {
    let folder = kernel_folder();
    // J2000 is noon of TDB; UTC is 64.184 s behind then.
    for (epoch, seconds) in [
        ("2000-01-01T12:00:00 TDB", 0.0),
        ("2000-01-01T18:00:00 TDB", 21_600.0),
        ("2000-01-01T03:00:00 TDB", -32_400.0),
        ("2000-01-01T12:00:00 UTC", 64.184),
    ] {
        let sun = ephemeris(epoch).sun(folder.path()).expect(epoch);
        let expected_km = sun_from_mars_km(seconds);
        let off_rad = sun.direction_in_icrf.cross(&expected_km.normalize()).norm();
        assert!(off_rad < 1e-9, "{epoch}: off by {off_rad} rad");
        assert!((sun.distance_au * 1.495_978_707e8 / expected_km.norm() - 1.0).abs() < 1e-9, "{epoch}");
        // A quarter of an hour later the Sun stands elsewhere.
        assert!(sun.direction_in_icrf.cross(&sun_from_mars_km(seconds + 900.0).normalize()).norm() > 1e-5);
    }
}

#[test]
fn scenarios_take_the_sun_from_kernels() {
    let folder = kernel_folder();
    let table = "kernels = [\"made.bsp\"]\nobserver_id = 499\nepoch = \"2000-01-01T12:00:00 TDB\"\n";
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
    let icrf = sun_from_mars_km(0.0);
    let build = |text: &str| {
        let scenario = scenario(text).expect("a scenario");
        assert_eq!(scenario, super::scenario(&scenario.to_toml()).expect("reads back"));
        scenario.build(folder.path()).expect("a scene")
    };
    let quarter = "[0.7071067811865476, 0.7071067811865476, 0, 0]";
    let Scene::Tumbling(body) = build(&format!(
        "[tumbling]\nframes = 2\ninertial_from_icrf = {quarter}\n[tumbling.shape.procedural]\nsubdivisions = 3\n\
         [tumbling.sun.ephemeris]\n{table}"
    )) else {
        panic!("not a body")
    };
    assert_along(&body.sun_in_spacecraft, turn * icrf);
    let distance_au = icrf.norm() / 1.495_978_707e8;
    assert!((body.sun_angular_radius_rad / sun_angular_radius_rad(distance_au) - 1.0).abs() < 1e-9);
    let Scene::Descent(ground) =
        build(&format!("[descent.sun]\nsite_from_icrf = {quarter}\n[descent.sun.ephemeris]\n{table}"))
    else {
        panic!("not a descent")
    };
    assert_along(&ground.sun_in_site, turn * icrf);
}

#[test]
fn kernels_that_do_not_help_are_named() {
    let folder = kernel_folder();
    let fault = |config: EphemerisConfig| config.sun(folder.path()).expect_err("refused");
    let base = || ephemeris("2000-01-01T12:00:00 TDB");
    let missing = fault(EphemerisConfig { kernels: vec!["none.bsp".into()], ..base() });
    assert!(matches!(&missing, SceneError::Io { path, .. } if path.ends_with("none.bsp")), "{missing}");
    std::fs::write(folder.path().join("text.bsp"), "no kernel").expect("written");
    let text = fault(EphemerisConfig { kernels: vec!["text.bsp".into()], ..base() }).to_string();
    assert!(text.contains("text.bsp"), "{text}");
    std::fs::write(
        folder.path().join("cut.bsp"),
        &spk_file(&[Path1 { body_id: 10, place_km: [0.0; 3], velocity_km_s: [0.0; 3] }])[..1500],
    )
    .expect("written");
    let cut = fault(EphemerisConfig { kernels: vec!["cut.bsp".into()], ..base() }).to_string();
    assert!(cut.contains("cut.bsp") || cut.contains("ephemeris"), "{cut}");
    let late = fault(ephemeris("2031-05-14T23:18:00 UTC")).to_string();
    assert!(late.contains("ephemeris.epoch") && late.contains("499"), "{late}");
    let stranger = fault(EphemerisConfig { observer_id: 2_101_955, ..base() }).to_string();
    assert!(stranger.contains("2101955"), "{stranger}");
    let here = fault(EphemerisConfig { observer_id: 10, ..base() }).to_string();
    assert!(here.contains("observer_id"), "{here}");
    for (lines, key) in [
        ("kernels = [\"made.bsp\"]\nepoch = \"noon\"", "descent.sun.ephemeris.epoch"),
        ("kernels = []\nepoch = \"2000-01-01T12:00:00 TDB\"", "descent.sun.ephemeris.kernels"),
    ] {
        let text = format!("[descent.sun.ephemeris]\nobserver_id = 499\n{lines}");
        let message = scenario(&text).expect_err("refused").to_string();
        assert!(message.contains(key), "{message}");
    }
}
