//! Guidance and the attitude that follows from it.

use super::{motion, path};
use nalgebra::{Point3, Vector3};
use opnav::geometry::Manifold;
use opnav::scene::{GuidanceConfig, GuidanceProfile, PolynomialGuidance};

#[test]
fn coefficients_follow_from_the_boundary_conditions() {
    let known = [
        [0.34343434343, -8.8426351053e-4, 7.7295761e-7],
        [0.10162228344, 9.9917654249e-4, -2.9551965e-6],
        [0.70812672176, -3.6512971775e-3, 7.69795515e-6],
    ];
    let path = path();
    for (axis, [c2, c3, c4]) in known.into_iter().enumerate() {
        assert!((path.coefficients[2][axis] / c2 - 1.0).abs() < 1e-9);
        assert!((path.coefficients[3][axis] / c3 - 1.0).abs() < 1e-9);
        assert!((path.coefficients[4][axis] / c4 - 1.0).abs() < 1e-7); // printed to 8 or 9 digits
        assert_eq!(path.coefficients[5][axis], 0.0);
    }
    let at_60_m = path.position_in_site_m(60.0);
    assert!((at_60_m - Vector3::new(995.380, 2453.363, 3030.342)).abs().max() < 5.1e-4, "{at_60_m}");
    let at_120_m_s = path.velocity_in_site_m_s(120.0);
    assert!((at_120_m_s - Vector3::new(-6.433, -18.873, -24.577)).abs().max() < 5.1e-4, "{at_120_m_s}");
}

#[test]
fn path_ends_at_rest_on_the_site() {
    let quintic = GuidanceConfig {
        profile: GuidanceProfile::Quintic { initial_acceleration_m_s2: [-0.6, 1.8, 0.0] },
        ..GuidanceConfig::default()
    };
    for config in [GuidanceConfig::default(), quintic] {
        let path = PolynomialGuidance::new(&config);
        assert!((path.position_in_site_m(0.0) - Vector3::new(3300.0, 5870.0, 6570.0)).norm() < 1e-9);
        assert!((path.velocity_in_site_m_s(0.0) - Vector3::new(-56.0, -66.0, -90.0)).norm() < 1e-12);
        assert!(path.position_in_site_m(198.0).norm() < 1e-8);
        assert!(path.velocity_in_site_m_s(198.0).norm() < 1e-9);
        let thrust = path.specific_force_in_site_m_s2(198.0);
        assert!((thrust - Vector3::new(0.0, 0.0, 0.7 + 3.711)).norm() < 1e-10);
        if let GuidanceProfile::Quintic { initial_acceleration_m_s2: a } = config.profile {
            let thrust = path.specific_force_in_site_m_s2(0.0);
            assert!((thrust - Vector3::new(a[0], a[1], a[2] + 3.711)).norm() < 1e-10);
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let (path, h) = (path(), 1e-3);
    for t_s in [0.5, 33.0, 120.0, 190.0] {
        let slope = |f: &dyn Fn(f64) -> Vector3<f64>| (f(t_s + h) - f(t_s - h)) / (2.0 * h);
        let velocity = slope(&|t| path.position_in_site_m(t)) - path.velocity_in_site_m_s(t_s);
        assert!(velocity.norm() < 1e-7, "{velocity}");
        let gravity = Vector3::new(0.0, 0.0, -3.711);
        let force = slope(&|t| path.velocity_in_site_m_s(t)) - gravity - path.specific_force_in_site_m_s2(t_s);
        assert!(force.norm() < 1e-7, "{force}");
        let jerk = slope(&|t| path.specific_force_in_site_m_s2(t)) - path.jerk_in_site_m_s3(t_s);
        assert!(jerk.norm() < 1e-9, "{jerk}");
    }
}

#[test]
fn attitude_points_the_thrust_with_zero_yaw() {
    let motion = motion();
    let (roll, pitch, yaw) = motion.site_from_lander(0.0).euler_angles();
    assert!((roll.to_degrees() + 2.25).abs() < 5.1e-3 && (pitch.to_degrees() - 7.63).abs() < 5.1e-3, "{roll} {pitch}");
    assert!(yaw.abs() < 1e-12);
    let (mut weakest, mut strongest) = (f64::INFINITY, 0.0_f64);
    for step in 0..=1980 {
        let t_s = 0.1 * f64::from(step);
        let force = motion.specific_force_in_lander_m_s2(t_s);
        assert!(force.xy().norm() < 1e-12 && force.z > 0.0);
        assert!(motion.site_from_lander(t_s).euler_angles().2.abs() < 1e-12);
        (weakest, strongest) = (weakest.min(force.z), strongest.max(force.z));
    }
    assert!((weakest - 3.85).abs() < 0.01 && (strongest - 5.18).abs() < 0.01, "{weakest} {strongest}");
    for (t_s, expected_deg) in [(0.0, 40.3), (50.0, 35.6), (100.0, 23.1), (150.0, 8.7), (190.0, 1.0)] {
        let state = motion.state((t_s * 1e9) as i64);
        let site = state.site_from_lander.inverse_transform_point(&Point3::origin()).coords;
        let off_axis_deg = (-site.z / site.norm()).acos().to_degrees();
        assert!((off_axis_deg - expected_deg).abs() < 0.051, "t = {t_s}: {off_axis_deg}");
    }
}

#[test]
fn angular_rate_agrees_with_the_attitude() {
    let (motion, h) = (motion(), 1e-2);
    for t_s in [1.0, 33.0, 120.0, 190.0] {
        let turn = motion.site_from_lander(t_s + h).minus(&motion.site_from_lander(t_s - h));
        let error = turn / (2.0 * h) - motion.rate_in_lander_rad_s(t_s);
        assert!(error.norm() < 1e-9, "t = {t_s}: {error}");
        assert!(motion.rate_in_lander_rad_s(t_s).norm() > 1e-5);
    }
}
