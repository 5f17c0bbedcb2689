//! Settings of the detector, and the motion that its shutter sees.

use super::{descent, scenario, tumbling};
use opnav::scene::{Exposure, FixedPatternConfig, SensorConfig, ShutterConfig, VignettingConfig};

#[test]
fn every_stage_has_its_keys() {
    let text = "[sensor]\nbits = 12\nelectrons_per_dn = 5\nblack_level_dn = 64\nread_noise_electrons = 12\n\
                dark_current_electrons_s = 200\npsf_sigma_px = 0.7\ndefocus_radius_px = 1.5\n\
                exposure.timed.electrons_per_radiance_s = 1e6\n[sensor.shutter]\nexposure_time_s = 0.02\n\
                row_time_s = 2e-5\nsub_pictures_at_most = 9\n[sensor.vignetting]\ncosine_fourth = true\n\
                radial = [-0.1, 0.0, 0.0]\n[sensor.fixed_pattern]\nresponse_sigma = 0.01\n\
                offset_sigma_electrons = 3\nhot_pixel_fraction = 1e-4\nhot_pixel_electrons_s = 1e4\n[descent]";
    let found = scenario(text).expect("a scenario");
    assert_eq!(found, scenario(&found.to_toml()).expect("the resolved copy"), "{}", found.to_toml());
    let expected = SensorConfig {
        full_well_electrons: 20_000.0,
        read_noise_electrons: 12.0,
        dark_current_electrons_s: 200.0,
        bits: 12,
        electrons_per_dn: Some(5.0),
        black_level_dn: 64.0,
        exposure: Exposure::Timed { electrons_per_radiance_s: 1e6 },
        shutter: ShutterConfig { exposure_time_s: 0.02, row_time_s: 2e-5, motion: true, sub_pictures_at_most: 9 },
        vignetting: VignettingConfig { cosine_fourth: true, radial: [-0.1, 0.0, 0.0] },
        psf_sigma_px: 0.7,
        defocus_radius_px: 1.5,
        fixed_pattern: FixedPatternConfig {
            response_sigma: 0.01,
            offset_sigma_electrons: 3.0,
            hot_pixel_fraction: 1e-4,
            hot_pixel_electrons_s: 1e4,
        },
        noise: true,
    };
    assert_eq!(descent(text).cameras[0].detector, expected);
    assert_eq!(descent(text).cameras[0].sensor.bits, Some(12));
    assert_eq!(descent("[descent]").cameras[0].sensor.bits, None);
}

#[test]
fn impossible_stages_are_refused_with_their_key() {
    let cases = [
        ("black_level_dn = 300", "sensor.black_level_dn"),
        ("electrons_per_dn = 0", "sensor.electrons_per_dn"),
        ("defocus_radius_px = 100", "sensor.defocus_radius_px"),
        ("dark_current_electrons_s = 5", "sensor.shutter.exposure_time_s"),
        ("fixed_pattern.hot_pixel_fraction = 0.1", "sensor.shutter.exposure_time_s"),
        ("fixed_pattern.response_sigma = -1", "sensor.fixed_pattern.response_sigma"),
        ("exposure.timed.electrons_per_radiance_s = 1", "sensor.shutter.exposure_time_s"),
        ("exposure.percentile = { percent = 101, full_well_share = 0.5 }", "sensor.exposure.percentile.percent"),
        ("shutter.exposure_time_s = -1", "sensor.shutter.exposure_time_s"),
        ("shutter.row_time_s = nan", "sensor.shutter.row_time_s"),
        ("shutter.sub_pictures_at_most = 0", "sensor.shutter.sub_pictures_at_most"),
        ("vignetting.radial = [-2.0, 0.5, 0.0]", "sensor.vignetting.radial"),
    ];
    for (line, key) in cases {
        let error = scenario(&format!("[sensor]\n{line}\n[descent]")).expect_err("refused").to_string();
        assert!(error.contains("test.toml") && error.contains(&format!("{key} is ")), "{line}: {error}");
    }
}

#[test]
fn views_between_images_follow_the_motion() {
    let text = |interval: &str| {
        format!(
            "[camera]\nwidth_px = 64\nheight_px = 64\n[tumbling]\nframes = 5\ninterval_s = {interval}\n\
             rate_deg_s = [40.0, 10.0, -30.0]\n[tumbling.shape.procedural]\nsubdivisions = 2\n"
        )
    };
    let (coarse, fine) = (tumbling(&text("2.0")), tumbling(&text("0.25")));
    for view in &coarse.cameras[0].views {
        assert_eq!(coarse.view_at(&coarse.cameras[0], view.t_ns), *view, "at a picture's time");
    }
    for view in &fine.cameras[0].views {
        let between = coarse.view_at(&coarse.cameras[0], view.t_ns);
        let apart = |other: &opnav::scene::View| {
            let turn_rad = between.reference_from_camera.rotation.angle_to(&other.reference_from_camera.rotation);
            let aside = (between.sun_in_reference.into_inner() - other.sun_in_reference.into_inner()).norm();
            turn_rad + aside
        };
        assert!(apart(view) < 1e-7, "{} ns: {} rad", view.t_ns, apart(view));
        let late = fine.view_at(&fine.cameras[0], view.t_ns + 1_000_000);
        assert!(apart(&late) > 1e-4, "a millisecond goes unnoticed");
    }
    let scene = descent("[descent.schedule.uniform]\nrate_hz = 1\nend_s = 9");
    for view in &scene.cameras[0].views {
        assert_eq!(scene.view_at(&scene.cameras[0], view.t_ns), *view, "at a picture's time");
    }
    let (before, after) = (scene.cameras[0].views[3], scene.cameras[0].views[4]);
    let middle = scene.view_at(&scene.cameras[0], (before.t_ns + after.t_ns) / 2).reference_from_camera;
    let mean_m =
        0.5 * (before.reference_from_camera.translation.vector + after.reference_from_camera.translation.vector);
    assert!((middle.translation.vector - mean_m).norm() < 1.0, "between its neighbours");
}
