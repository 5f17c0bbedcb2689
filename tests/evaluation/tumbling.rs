//! Tumbling bodies: attitude, rate and inertia against a motion that is integrated here.

use super::bench::{Bench, SECOND_NS, assert_near, covariance_csv, covariance_root, figure, white};
use crate::reference_body::{STATES, rate_rad_s, tensor};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use opnav::dataset::truth::{AsteroidInertia, AsteroidState, write_asteroid};
use opnav::dataset::{StampedPose, write_tum};
use opnav::evaluation::*;
use opnav::geometry::so3::exp;
use std::fmt::Write;

/// Torque-free motion from the reference case, one sample every `step_s`, by fourth-order Runge-Kutta.
fn tumble(count: usize, step_s: f64) -> Vec<AsteroidState> {
    let inverse = tensor().try_inverse().expect("invertible");
    let rate_slope = |w: &Vector3<f64>| -inverse * w.cross(&(tensor() * w));
    // As matrices and quaternions: A' = exp(-w dt) A.
    let substeps = 200;
    let dt = step_s / f64::from(substeps);
    let mut w = rate_rad_s();
    let mut attitude = UnitQuaternion::identity();
    let mut states = vec![];
    for k in 0..count {
        let t_ns = (k as f64 * step_s * 1e9).round() as i64;
        states.push(AsteroidState { t_ns, asteroid_from_inertial: attitude, rate_in_asteroid_rad_s: w });
        for _ in 0..substeps {
            let k1 = rate_slope(&w);
            let k2 = rate_slope(&(w + k1 * (0.5 * dt)));
            let k3 = rate_slope(&(w + k2 * (0.5 * dt)));
            let k4 = rate_slope(&(w + k3 * dt));
            let middle = w + (k1 * 5.0 + k2 * 8.0 - rate_slope(&(w + k3 * dt))) * (dt / 24.0);
            let mean = (w + (middle * 4.0) + (w + (k1 + (k2 + k3) * 2.0 + k4) * (dt / 6.0))) / 6.0;
            attitude = exp(&(-mean * dt)) * attitude;
            w += (k1 + (k2 + k3) * 2.0 + k4) * (dt / 6.0);
        }
    }
    states
}

#[test]
fn the_simulated_truth_agrees_with_the_reference() {
    let state = tumble(61, 1.0)[60];
    let [known, _] = STATES;
    assert!((state.rate_in_asteroid_rad_s - known.rate_in_asteroid_rad_s()).norm() < 1e-9);
    assert!(state.asteroid_from_inertial.angle_to(&known.asteroid_from_inertial()) < 1e-6);
}

#[test]
fn tumbling_truth_is_interpolated_with_its_rates() {
    let coarse = tumble(21, 2.0);
    let fine = tumble(400, 0.1);
    for state in &fine {
        let found = asteroid_state_at(&coarse, state.t_ns).expect("inside");
        assert!(found.asteroid_from_inertial.angle_to(&state.asteroid_from_inertial) < 2e-5);
        assert!((found.rate_in_asteroid_rad_s - state.rate_in_asteroid_rad_s).norm() < 5e-5);
    }
    assert!(asteroid_state_at(&coarse, -1).is_none() && asteroid_state_at(&coarse, 41 * SECOND_NS).is_none());
}

/// Truth in asteroid axes turned by `gauge` from the camera's at the start.
fn tumbling_bench(gauge: &UnitQuaternion<f64>) -> Bench {
    let bench = Bench::new("tumbling");
    let turn = gauge.to_rotation_matrix();
    let states: Vec<AsteroidState> = tumble(61, 1.0)
        .iter()
        .map(|s| AsteroidState {
            t_ns: s.t_ns,
            asteroid_from_inertial: gauge * s.asteroid_from_inertial,
            rate_in_asteroid_rad_s: gauge * s.rate_in_asteroid_rad_s,
        })
        .collect();
    let tensor = turn.matrix() * tensor() * turn.matrix().transpose() * 7.0;
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| 0.5 * (tensor[(i, j)] + tensor[(j, i)])));
    write_asteroid(&bench.root(), &states, &AsteroidInertia { inertia: rows }).expect("write");
    bench
}

fn tumbling_csv(rows: &[AsteroidState], ratios: &str) -> String {
    let mut text = String::from("t_ns,qw,qx,qy,qz,wx_rad_s,wy_rad_s,wz_rad_s,Lxx,Lyy,Lxy,Lxz,Lyz,sigma_Lxx\n");
    for row in rows {
        let (q, w) = (row.asteroid_from_inertial, row.rate_in_asteroid_rad_s);
        writeln!(text, "{},{},{},{},{},{},{},{},{ratios},0.01", row.t_ns, q.w, q.i, q.j, q.k, w.x, w.y, w.z)
            .expect("text");
    }
    text
}

const TRUE_RATIOS: &str = "0.85,1.37,0.13,0.17,-0.11";
const INERTIA_ERRORS: [&str; 5] = ["Lxx_error", "Lyy_error", "Lxy_error", "Lxz_error", "Lyz_error"];

#[test]
fn a_perfect_tumbling_result_has_no_error_in_whatever_axes_the_truth_is() {
    for gauge in [Vector3::zeros(), Vector3::new(0.3, -1.2, 2.0), Vector3::new(3.0, 0.1, 0.0)] {
        let bench = tumbling_bench(&exp(&gauge));
        bench.put("estimate.csv", &tumbling_csv(&tumble(61, 1.0), TRUE_RATIOS));
        let metrics = bench.metrics();
        for name in ["final_attitude_error", "final_rate_error", "attitude_error_rms", "rate_error_rms_last_fifth"] {
            assert_near(&metrics, name, 0.0, 1e-6);
        }
        for name in INERTIA_ERRORS {
            assert_near(&metrics, name, 0.0, 1e-9);
        }
        assert_near(&metrics, "Lxx_sigma", 0.01, 1e-12);
    }
}

#[test]
fn the_inertial_axes_of_the_truth_need_not_be_the_cameras() {
    let bench = tumbling_bench(&exp(&Vector3::new(0.3, -1.2, 2.0)));
    let camera_from_inertial = exp(&Vector3::new(-0.4, 0.9, 0.2));
    let (states, tensor) = opnav::dataset::truth::read_asteroid(&bench.root()).expect("read");
    let start = states[0].asteroid_from_inertial;
    let pose = Isometry3::from_parts(Translation3::new(0.0, 0.0, -900.0), start);
    write_tum(&bench.root().join("truth/cam0.tum"), &[StampedPose { t_ns: 0, reference_from_moving: pose }])
        .expect("write");
    let turned: Vec<AsteroidState> = states
        .iter()
        .map(|s| AsteroidState { asteroid_from_inertial: s.asteroid_from_inertial * camera_from_inertial, ..*s })
        .collect();
    write_asteroid(&bench.root(), &turned, &tensor).expect("write");
    bench.put("estimate.csv", &tumbling_csv(&tumble(61, 1.0), TRUE_RATIOS));
    assert_near(&bench.metrics(), "attitude_error_rms", 0.0, 1e-6);
}

#[test]
fn a_start_later_than_the_truths_is_taken_from_the_summary_or_the_tracks() {
    let bench = tumbling_bench(&exp(&Vector3::new(0.3, -1.2, 2.0)));
    let states = tumble(61, 1.0);
    let start = states[10].asteroid_from_inertial.inverse();
    let late: Vec<AsteroidState> = states[10..]
        .iter()
        .map(|s| AsteroidState {
            t_ns: s.t_ns,
            asteroid_from_inertial: start * s.asteroid_from_inertial,
            rate_in_asteroid_rad_s: start * s.rate_in_asteroid_rad_s,
        })
        .collect();
    bench.put("estimate.csv", &tumbling_csv(&late, TRUE_RATIOS));
    assert!(figure(&bench.metrics(), "attitude_error_rms") > 10.0, "the wrong start must show");
    bench.put("tracks.csv", "t_ns,track_id,u_px,v_px,sigma_px,response\n10000000000,1,5,5,0.1,1\n");
    assert_near(&bench.metrics(), "attitude_error_rms", 0.0, 1e-6);
    bench.put("tracks.csv", "t_ns,track_id,u_px,v_px,sigma_px,response\n0,1,5,5,0.1,1\n");
    bench.put("summary.json", "{\"mission\": \"tumbling\", \"t0_ns\": 10000000000}");
    assert_near(&bench.metrics(), "attitude_error_rms", 0.0, 1e-6);
}

#[test]
fn known_errors_of_a_tumbling_result_are_found_exactly() {
    let bench = tumbling_bench(&exp(&Vector3::new(1.0, 0.5, -0.2)));
    let mut rows = tumble(61, 1.0);
    for row in &mut rows {
        row.rate_in_asteroid_rad_s -= Vector3::new(0.0, 0.003, 0.004);
        row.asteroid_from_inertial *= exp(&Vector3::new(-0.01, 0.0, 0.0));
    }
    bench.put("estimate.csv", &tumbling_csv(&rows, "0.80,1.37,0.13,0.17,-0.10"));
    let metrics = bench.metrics();
    assert_near(&metrics, "final_rate_error", 0.005f64.to_degrees(), 1e-9);
    assert_near(&metrics, "attitude_error_rms_last_fifth", 0.01f64.to_degrees(), 1e-9);
    assert_near(&metrics, "Lxx_error", 0.05, 1e-9);
    assert_near(&metrics, "Lyz_error", -0.01, 1e-9);
    assert_near(&metrics, "worst_inertia_error", 0.05, 1e-9);
    let curve = metrics.series("attitude_error_x").expect("a curve");
    assert!(curve.values.iter().all(|v| (v - 0.01f64.to_degrees()).abs() < 1e-6));
}

#[test]
fn a_transposed_attitude_is_noticed() {
    let bench = tumbling_bench(&UnitQuaternion::identity());
    let mut rows = tumble(61, 1.0);
    for row in &mut rows {
        row.asteroid_from_inertial = row.asteroid_from_inertial.inverse();
    }
    bench.put("estimate.csv", &tumbling_csv(&rows, TRUE_RATIOS));
    assert!(figure(&bench.metrics(), "attitude_error_rms") > 10.0);
}

#[test]
fn tumbling_consistency_uses_attitude_and_rate_in_that_order() {
    let bench = tumbling_bench(&exp(&Vector3::new(1.0, 0.5, -0.2)));
    let root = covariance_root::<6>(|i| [1e-3, 2e-3, 5e-4, 2e-5, 1e-5, 4e-5][i]);
    let mut rows = tumble(61, 1.0);
    for (k, row) in rows.iter_mut().enumerate() {
        let error = root * white::<6>(500 + k as u64);
        row.asteroid_from_inertial *= exp(&-Vector3::from(error.fixed_rows::<3>(0)));
        row.rate_in_asteroid_rad_s -= error.fixed_rows::<3>(3);
    }
    let covariance = root * root.transpose();
    bench.put("estimate.csv", &tumbling_csv(&rows, TRUE_RATIOS));
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, covariance))));
    let metrics = bench.metrics();
    assert!(metrics.verdict("consistent").expect("a verdict").holds, "{:?}", metrics.verdicts);
    assert_near(&metrics, "nees_per_dof_mean", 1.0, 0.2);
    assert_eq!(metrics.series("rate_error_z").expect("a curve").sigma[0], covariance[(5, 5)].sqrt().to_degrees());
}

#[test]
fn an_inertia_that_is_not_determined_gets_no_number() {
    let bench = tumbling_bench(&UnitQuaternion::identity());
    bench.put("estimate.csv", &tumbling_csv(&tumble(61, 1.0), "0.85,,NaN,0.17,-0.11"));
    let metrics = bench.metrics();
    assert_eq!((metrics.figure("Lyy_error"), metrics.figure("Lxy_error")), (None, None));
    assert_near(&metrics, "Lxz_error", 0.0, 1e-9);
    assert!(metrics.notes.iter().any(|n| n.contains("Lyy not determined")), "{:?}", metrics.notes);
}
