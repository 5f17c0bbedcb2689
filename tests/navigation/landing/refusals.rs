//! Input and options that are refused, by their messages.

use super::flight::{FLIGHT, Flight, fly};
use opnav::navigation::landing::{LandingConfig, LandingError, LandingInput, navigate};

#[test]
fn wrong_input_is_named() {
    let good = fly(&Flight { frames: 5, ..FLIGHT }, 0);
    let config = LandingConfig::default();
    let failure = |change: &dyn Fn(&mut LandingInput)| {
        let mut input = good.clone();
        change(&mut input);
        navigate(&input, &config, &|_| ()).expect_err("this must not pass")
    };
    assert!(matches!(failure(&|i| i.frame_times_ns.clear()), LandingError::Empty { .. }));
    assert!(matches!(failure(&|i| i.imu.clear()), LandingError::Empty { .. }));
    assert!(matches!(failure(&|i| drop(i.imu.drain(1000..9000))), LandingError::ImuGap { .. }));
    assert!(matches!(failure(&|i| i.imu.truncate(500)), LandingError::ImuGap { .. }));
    assert!(matches!(failure(&|i| i.imu.swap(4, 5)), LandingError::Order { .. }));
    assert!(matches!(failure(&|i| i.frame_times_ns[1] = 0), LandingError::Order { .. }));
    assert!(matches!(failure(&|i| i.observations.reverse()), LandingError::Order { .. }));
    assert!(matches!(failure(&|i| i.observations[0].sigma_px = 0.0), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.observations[0].pixel_px.x = f64::NAN), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.imu[7].rate_in_lander_rad_s.x = f64::NAN), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.initial.t_ns = 1), LandingError::LateStart { .. }));
    assert!(matches!(failure(&|i| i.initial.sigma_position_m = -1.0), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.camera.focal_px.x = 0.0), LandingError::Camera(_)));
    assert!(matches!(failure(&|i| i.frame_times_ns.truncate(4)), LandingError::NoFrame { .. }));
    let text = failure(&|i| i.initial.t_ns = 1).to_string();
    assert!(text.contains("start at a later frame"), "{text}");
}

#[test]
fn wrong_options_are_named() {
    let wrong = [
        LandingConfig { gate_confidence: 1.0, ..LandingConfig::default() },
        LandingConfig { sigma_floor_px: 0.0, ..LandingConfig::default() },
        LandingConfig { gravity_m_s2: f64::NAN, ..LandingConfig::default() },
        LandingConfig { reselect_after: 0, ..LandingConfig::default() },
    ];
    for config in wrong {
        assert!(config.validate().is_err(), "{config:?}");
    }
    LandingConfig::default().validate().expect("the defaults are fine");
    let text = toml::to_string(&LandingConfig::default()).expect("plain data");
    assert!(text.contains("selector = \"depth-error\"") && text.contains("filter = \"hybrid\""), "{text}");
    assert_eq!(toml::from_str::<LandingConfig>(&text).expect("readable"), LandingConfig::default());
    assert!(toml::from_str::<LandingConfig>("selektor = \"svd\"").is_err());
}
