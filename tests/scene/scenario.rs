//! Scenario files.

use super::{datasets, scenario};
use opnav::scene::{Exposure, FrameSchedule, Mission, Scenario, Scene};
use std::path::Path;

const DESCENT: &str = "[descent]\n";
const TUMBLING: &str = "[tumbling]\n";

fn with(text: &str, overrides: &[&str]) -> Result<Scenario, String> {
    let overrides: Vec<String> = overrides.iter().map(|s| s.to_string()).collect();
    Scenario::parse(text, Path::new("test.toml"), &overrides).map_err(|e| e.to_string())
}

#[test]
fn every_shipped_scenario_reads_resolves_and_builds() {
    let mut count = 0;
    for entry in std::fs::read_dir(datasets()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let scenario = Scenario::read(&path, &[]).unwrap();
        assert_eq!(scenario, self::scenario(&scenario.to_toml()).unwrap(), "{}", path.display());
        match scenario.build(datasets()).unwrap() {
            Scene::Descent(scene) => assert!(scene.cameras[0].views.len() >= 60, "{}", path.display()),
            Scene::Tumbling(scene) => assert!(scene.cameras[0].views.len() >= 60, "{}", path.display()),
            Scene::Attachment(scene) => assert_eq!(scene.cameras[2].views.len(), 61, "{}", path.display()),
        }
        count += 1;
    }
    assert!(count >= 12, "{count} scenarios");
}

#[test]
fn resolved_copy_has_every_key_and_reads_back_equal() {
    for text in [
        DESCENT.to_string(),
        TUMBLING.to_string(),
        "seed = 9\n[sensor.exposure.fixed]\nelectrons_per_radiance = 1e5\n[descent.schedule.constant-scale]\ncount = 9\n\
         [descent.guidance.profile.quintic]\ninitial_acceleration_m_s2 = [0.1, 0.2, 1]\n"
            .to_string(),
        "[tumbling]\ninertia = \"from-shape\"\n[tumbling.shape.mesh]\npath = \"a b.obj\"\nunit = \"km\"\n".to_string(),
    ] {
        let first = scenario(&text).unwrap();
        assert_eq!(first, scenario(&first.to_toml()).unwrap(), "{}", first.to_toml());
    }
    let text = scenario(DESCENT).unwrap().to_toml();
    let keys = [
        "seed = 1",
        "fov_deg = 90.0",
        "psf_sigma_px = 0.5",
        "gravity_m_s2 = 3.711",
        "gyroscope_noise_density",
        "cant_deg",
        "elevation_deg",
        "albedo",
        "position_m = 1000.0",
        "rate_hz = 100",
        "end_height_m = 15.0",
    ];
    for key in keys {
        assert!(text.contains(key), "{key}: {text}");
    }
    let text = scenario(TUMBLING).unwrap().to_toml();
    for key in ["fov_deg = 30.0", "semi_axes_m", "tensor", "phase_deg", "detail_slope", "fill_fraction", "interval_s"] {
        assert!(text.contains(key), "{key}: {text}");
    }
}

#[test]
fn overrides_follow_toml_types_and_make_missing_tables() {
    let found = with(
        DESCENT,
        &[
            "seed=42",
            "camera.width_px = 256",
            "descent.imu.noise=false",
            "descent.schedule.constant-scale.count=9",
            "sensor.exposure=auto",
        ],
    )
    .unwrap();
    assert_eq!(
        (found.seed, found.imagers[0].camera.width_px, found.imagers[0].sensor.exposure),
        (42, 256, Exposure::Auto)
    );
    let Mission::Descent(descent) = found.mission else { panic!("not a descent") };
    assert!(!descent.imu.noise);
    assert_eq!(descent.schedule, FrameSchedule::ConstantScale { count: 9, end_height_m: 15.0 });
    let found = with(TUMBLING, &["tumbling.rate_deg_s=[1, 2, 3.5]", "tumbling.inertia=from-shape"]).unwrap();
    let Mission::Tumbling(tumbling) = found.mission else { panic!("not a tumbling body") };
    assert_eq!(tumbling.rate_deg_s, [1.0, 2.0, 3.5]);
    let found = with(TUMBLING, &["tumbling.shape={mesh={path=\"x.obj\", unit=\"m\"}}"]).unwrap();
    assert!(found.to_toml().contains("x.obj"));
}

#[test]
fn bad_overrides_name_the_key() {
    let cases = [
        ("camera", "camera", "table.key=value"),
        ("=3", "=3", "empty"),
        ("seed.deep=1", "seed", "not a table"),
        ("camera.widht_px=1", "widht_px", "width_px"),
        ("descent.imu.rate_hz=fast", "descent.imu", "fast"),
        ("seed=-1", "seed", "-1"),
        ("tumbling.frames=3", "[tumbling]", "more than one"),
    ];
    for (line, key, fault) in cases {
        let error = with(&format!("seed = 1\n{DESCENT}"), &[line]).unwrap_err();
        assert!(error.contains("test.toml") && error.contains(key) && error.contains(fault), "{line}: {error}");
    }
}

#[test]
fn unknown_keys_are_refused_with_file_and_key() {
    let cases = [
        ("sed = 1\n[descent]", "sed"),
        ("[descent]\nspeed = 1", "speed"),
        ("[camera]\nlens = 1\n[descent]", "lens"),
        ("[descent.imu]\nbias = 1", "bias"),
        ("[descent.schedule.uniform]\nrate = 1", "rate"),
        ("[descent.schedule.sometimes]\nrate = 1", "sometimes"),
        ("[descent.terrain]\nlakes = 1", "lakes"),
        ("[tumbling.shape.procedural]\nmoons = 1", "moons"),
        ("[tumbling.shape.mesh]\npath = \"x\"\nscale = 1", "scale"),
        ("[tumbling.sun]\ncolour = 1", "colour"),
    ];
    for (text, key) in cases {
        let error = with(text, &[]).unwrap_err();
        assert!(error.contains("test.toml") && error.contains(key), "{text}: {error}");
        assert!(error.contains("line"), "{error}");
    }
}

#[test]
fn impossible_values_are_refused_with_their_key() {
    let cases = [
        ("[camera]\nfov_deg = 180\n[descent]", "camera.fov_deg"),
        ("[camera]\nfov_deg = nan\n[descent]", "camera.fov_deg"),
        ("[camera]\nwidth_px = 0\n[descent]", "camera.width_px"),
        ("[camera]\nfocal_px = [0, 900]\n[descent]", "camera.focal_px"),
        ("[camera]\ncenter_px = [inf, 0]\n[descent]", "camera.center_px"),
        ("[camera.distortion]\ncoefficients = [0.1, 0, 0, 0]\n[descent]", "camera.distortion.coefficients"),
        (
            "[camera.distortion]\nmodel = \"radial-tangential\"\ncoefficients = [-0.9, 0, 0, 0]\n[descent]",
            "camera.distortion.coefficients",
        ),
        ("[sensor]\nfull_well_electrons = -1\n[descent]", "sensor.full_well_electrons"),
        ("[sensor]\nbits = 33\n[descent]", "sensor.bits"),
        (
            "[sensor.exposure.fixed]\nelectrons_per_radiance = 0\n[descent]",
            "sensor.exposure.fixed.electrons_per_radiance",
        ),
        ("[descent.imu]\nrate_hz = 0", "descent.imu.rate_hz"),
        ("[descent.imu]\nrate_hz = 7", "descent.imu.rate_hz"),
        ("[descent.imu]\naccelerometer_noise_density = nan", "descent.imu.accelerometer_noise_density"),
        ("[descent.initial_error]\nposition_m = -1", "descent.initial_error.position_m"),
        ("[descent.guidance]\nduration_s = inf", "descent.guidance.duration_s"),
        ("[descent.guidance]\ninitial_position_m = [0, 0, -5]", "descent.guidance.initial_position_m"),
        ("[descent.guidance]\ninitial_velocity_m_s = [0, nan, 0]", "descent.guidance.initial_velocity_m_s"),
        ("[descent.guidance]\ninitial_velocity_m_s = [0, 0, -500]", "descent.guidance.duration_s"),
        ("[descent.schedule.constant-scale]\ncount = 1", "descent.schedule.constant-scale.count"),
        ("[descent.schedule.uniform]\nstart_s = -1", "descent.schedule.uniform.start_s"),
        ("[descent.sun]\nelevation_deg = -3", "descent.sun.elevation_deg"),
        ("[descent.terrain]\nalbedo = 2", "descent.terrain.albedo"),
        ("[tumbling]\nframes = 0", "tumbling.frames"),
        ("[tumbling]\ninterval_s = 0", "tumbling.interval_s"),
        ("[tumbling]\nrate_deg_s = [nan, 0, 0]", "tumbling.rate_deg_s"),
        ("[tumbling]\nfill_fraction = 0", "tumbling.fill_fraction"),
        ("[tumbling]\ncenter_offset_px = [9000, 0]", "tumbling.center_offset_px"),
        ("[tumbling]\ninertia = { tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 3]] }", "tumbling.inertia"),
        ("[tumbling.sun]\nphase_deg = 200", "tumbling.sun.phase_deg"),
        ("[tumbling.surface]\nalbedo = 0", "tumbling.surface.albedo"),
        ("[tumbling.shape.procedural]\nsemi_axes_m = [1, 0, 1]", "tumbling.shape.procedural.semi_axes_m"),
        ("[tumbling.shape.mesh]\npath = \"x\"\nmetres_per_unit = 0", "tumbling.shape.mesh.metres_per_unit"),
        ("[tumbling.shape.mesh]\npath = \"x\"", "tumbling.shape.mesh.unit"),
        ("[tumbling.shape.mesh]\npath = \"x\"\nunit = \"m\"\nmetres_per_unit = 1", "tumbling.shape.mesh.unit"),
        (
            "[tumbling.surface.albedo_map]\npath = \"x\"\nwest_edge_deg = 999",
            "tumbling.surface.albedo_map.west_edge_deg",
        ),
    ];
    for (text, key) in cases {
        let error = with(text, &[]).unwrap_err();
        assert!(error.contains("test.toml") && error.contains(&format!("{key} is ")), "{text}: {error}");
    }
}

#[test]
fn one_mission_it_must_be() {
    let none = with("seed = 1", &[]).unwrap_err();
    assert!(none.contains("test.toml") && none.contains("neither"), "{none}");
    let both = with("[descent]\n[tumbling]", &[]).unwrap_err();
    assert!(both.contains("test.toml") && both.contains("more than one"), "{both}");
    let no_toml = with("seed = ", &[]).unwrap_err();
    assert!(no_toml.contains("test.toml") && no_toml.contains("line 1"), "{no_toml}");
    let missing = Scenario::read(Path::new("none.toml"), &[]).unwrap_err().to_string();
    assert!(missing.contains("none.toml"), "{missing}");
}

#[test]
fn shapes_are_found_from_the_scenarios_folder_and_their_faults_named() {
    let missing = scenario("[tumbling.shape.mesh]\npath = \"shapes/none.obj\"\nunit = \"km\"").unwrap();
    let error = missing.build(datasets()).unwrap_err().to_string();
    assert!(error.contains("datasets/shapes/none.obj"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("open.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n").unwrap();
    let open = scenario("[tumbling.shape.mesh]\npath = \"open.obj\"\nunit = \"m\"").unwrap();
    let error = open.build(folder.path()).unwrap_err().to_string();
    assert!(error.contains("open.obj") && error.contains("is open"), "{error}");
}

#[test]
fn same_seed_same_scene() {
    let text = "[camera]\nwidth_px = 64\n[tumbling.shape.procedural]\nsubdivisions = 3\n";
    let build = |seed: &str| with(text, &[seed]).unwrap().build(datasets()).unwrap();
    assert_eq!(build("seed=3"), build("seed=3"));
    assert_ne!(build("seed=3"), build("seed=4"));
}
