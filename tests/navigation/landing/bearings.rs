//! Jacobians of bearings against central differences, and what yaw must never do.

use super::chart::{CAMERA_IN_LANDER_M, Chart, KINDS, bearing_to, dense, increment, model, moved, state};
use super::descent::PLANET;
use nalgebra::{DVector, Isometry3, Matrix2, SMatrix, Unit, Vector2, Vector3};
use opnav::geometry::so3::tangent_basis;
use opnav::geometry::{Camera, Distortion, central_difference};
use opnav::navigation::landing::{
    BearingObservation, CameraMount, Core, CorrectionModel, DescentState, FilterKind, innovation,
};
use opnav::observations::TrackObservation;

#[test]
fn measurement_jacobian_is_the_derivative_of_the_bearing() {
    let state = state();
    let landmark_m = state.landmarks[0].position_in_site_m;
    for (kind, track, point_m) in KINDS.iter().flat_map(|k| [(*k, 0, Vector3::zeros()), (*k, 4, landmark_m)]) {
        let bearing = bearing_to(&state, track, &point_m);
        let at = |s: &DescentState| innovation(s, &bearing, &Matrix2::identity(), &model(kind)).expect("ahead");
        let here = at(&state);
        assert!(here.residual.norm() < 1e-12, "{kind:?} residual at the truth");
        let residual = |c: &Chart| Vector2::from_column_slice((-at(&c.1).residual).as_slice());
        let numeric: SMatrix<f64, 2, 12> = central_difference(residual, &Chart(kind, state.clone()), 1e-4);
        let analytic: SMatrix<f64, 2, 12> = dense(&here);
        assert!((numeric - analytic).amax() < 1e-8, "{kind:?} track {track}: {}", numeric - analytic);
    }
}

/// A turn about the vertical through the site, in each filter's coordinates, changes no bearing; in the hybrid ones the
/// motion keeps it exactly: its column of F is that of the identity, bit for bit.
#[test]
fn yaw_is_never_observed() {
    let state = state();
    let landmark_m = state.landmarks[0].position_in_site_m;
    let up = Vector3::z();
    for kind in KINDS {
        let mut yaw = DVector::zeros(12);
        if kind == FilterKind::Hybrid {
            yaw[8] = 1.0;
        } else {
            yaw.rows_mut(0, 3).copy_from(&-state.lander_in_site_m.cross(&up));
            yaw.rows_mut(3, 3).copy_from(&-state.lander_velocity_in_site_m_s.cross(&up));
            yaw.rows_mut(6, 3).copy_from(&(state.lander_from_site * up));
            yaw.rows_mut(9, 3).copy_from(&-landmark_m.cross(&up));
        }
        for (track, point_m) in [(0, Vector3::zeros()), (4, landmark_m)] {
            let bearing = bearing_to(&state, track, &point_m);
            let model = CorrectionModel { camera_in_lander_m: Vector3::zeros(), ..model(kind) };
            let h: SMatrix<f64, 2, 12> =
                dense(&innovation(&state, &bearing, &Matrix2::identity(), &model).expect("ahead"));
            assert!((h * &yaw).norm() <= 1e-12, "{kind:?} track {track}");
        }
    }
    let increment = increment();
    let f = FilterKind::Hybrid
        .transition(&Core::of(&state), &moved(&state, &increment), &increment, &PLANET)
        .state_matrix();
    let expected = DVector::from_fn(12, |k, _| if k == 8 { 1.0 } else { 0.0 });
    assert_eq!(f.column(8).into_owned(), expected);
}

#[test]
fn landmark_on_ground_has_the_right_derivatives() {
    let state = state();
    let bearing = bearing_to(&state, 9, &Vector3::new(300.0, 900.0, 0.0));
    for kind in KINDS {
        let at = |s: &DescentState, b: &BearingObservation, height_m: f64| {
            let spot =
                kind.point_on_ground(s, &b.direction_in_lander, &CAMERA_IN_LANDER_M, height_m).expect("it looks down");
            let p = spot.position_in_site_m;
            if kind == FilterKind::Hybrid { s.lander_from_site * p } else { p }
        };
        let spot = kind
            .point_on_ground(&state, &bearing.direction_in_lander, &CAMERA_IN_LANDER_M, 0.0)
            .expect("it looks down");
        assert!((spot.position_in_site_m - Vector3::new(300.0, 900.0, 0.0)).norm() < 1e-9);
        let numeric: SMatrix<f64, 3, 12> =
            central_difference(|c: &Chart| at(&c.1, &bearing, 0.0), &Chart(kind, state.clone()), 1e-4);
        let mut analytic = SMatrix::<f64, 3, 12>::zeros();
        analytic.fixed_view_mut::<3, 3>(0, 0).copy_from(&spot.by_position);
        analytic.fixed_view_mut::<3, 3>(0, 6).copy_from(&spot.by_attitude);
        assert!((numeric - analytic).amax() < 1e-4, "{kind:?} by state {}", numeric - analytic);
        let by_height = (at(&state, &bearing, 0.5) - at(&state, &bearing, -0.5)) - spot.by_height;
        assert!(by_height.norm() < 1e-8, "{kind:?} by height");
        let across = tangent_basis(&bearing.direction_in_lander);
        let turned = |d: &Vector2<f64>| {
            let direction = Unit::new_normalize(bearing.direction_in_lander.into_inner() + across * d);
            at(&state, &BearingObservation { direction_in_lander: direction, ..bearing }, 0.0)
        };
        let numeric: SMatrix<f64, 3, 2> = central_difference(turned, &Vector2::zeros(), 1e-6);
        assert!((numeric - spot.by_bearing * across).amax() < 1e-4, "{kind:?} by bearing");
    }
    let upward = BearingObservation::from_sigma(9, state.lander_from_site * Vector3::z_axis(), 1e-3);
    assert_eq!(FilterKind::Hybrid.point_on_ground(&state, &upward.direction_in_lander, &CAMERA_IN_LANDER_M, 0.0), None);
}

#[test]
fn pixel_noise_goes_through_the_camera() {
    let camera = Camera {
        distortion: Distortion::RadialTangential([-0.1, 0.01, 1e-3, -5e-4]),
        ..Camera::from_fov(512, 512, 1.5)
    };
    let lander_from_camera = Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(2.9, 0.3, -0.2));
    let mount = CameraMount { camera, lander_from_camera };
    let at = |pixel_px: Vector2<f64>| TrackObservation { t_ns: 0, track_id: 3, pixel_px, sigma_px: 0.3, response: 0.0 };
    let pixel = Vector2::new(480.0, 60.0);
    let here = mount.bearing(&at(pixel), 0.1).expect("invertible");
    let across = tangent_basis(&here.direction_in_lander).transpose();
    let shifted =
        |p: &Vector2<f64>| across * mount.bearing(&at(*p), 0.1).expect("invertible").direction_in_lander.into_inner();
    let j: SMatrix<f64, 2, 2> = central_difference(shifted, &pixel, 1e-3);
    let expected = j * j.transpose() * 0.09;
    assert!((here.covariance_rad2 - expected).norm() < 1e-6 * expected.norm());
    assert_eq!(mount.bearing(&at(pixel), 0.6).expect("invertible").covariance_rad2, here.covariance_rad2 * 4.0);
}
