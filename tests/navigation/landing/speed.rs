//! What the filter and the choice of landmarks cost, in processor time of one thread: figures beside the aims, not
//! asserted, since they are the machine's as much as the code's.

use super::descent::{PLANET, exact_increment, truth};
use crate::accuracy_bar::{Bar, check_table};
use cpu_time::ThreadTime;
use nalgebra::{DMatrix, DVector, SMatrix, Unit, Vector3};
use opnav::campaign::{CampaignOptions, fly};
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    BearingObservation, CorrectionModel, DescentEstimate, DescentState, FilterKind, LandingConfig, UnknownLandmark,
    correct, predict, viewpoint,
};
use opnav::navigation::landmark::Selector;
use opnav::stats::random_stream;
use std::hint::black_box;

fn estimate() -> DescentEstimate {
    let now = truth(60.0);
    let state = DescentState {
        lander_in_site_m: now.position_m,
        lander_velocity_in_site_m_s: now.velocity_m_s,
        lander_from_site: now.lander_from_site,
        biases: None,
        landmarks: vec![UnknownLandmark::new(1, Vector3::new(1400.0, 3300.0, 0.0), 0)],
    };
    let sigma = [60.0, 60.0, 60.0, 1.0, 1.0, 1.0, 2e-3, 2e-3, 2e-2, 80.0, 80.0, 80.0_f64];
    DescentEstimate { state, covariance: DMatrix::from_diagonal(&DVector::from_fn(12, |k, _| sigma[k].powi(2))) }
}

/// Processor time of one call in µs, the least of several rounds.
fn microseconds(rounds: usize, calls: usize, mut call: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..rounds {
        let start = ThreadTime::now();
        (0..calls).for_each(|_| call());
        least = least.min(start.elapsed().as_secs_f64() * 1e6 / calls as f64);
    }
    least
}

fn filter_step_us() -> f64 {
    let mut increment = exact_increment(&truth(60.0), &truth(61.0), 1.0);
    increment.covariance = SMatrix::identity() * 1e-9;
    let start = estimate();
    let after = predict(start.clone(), &increment, &PLANET, FilterKind::Hybrid).state;
    let toward = |track_id: u64, point_m: Vector3<f64>| {
        let direction = Unit::new_normalize(after.lander_from_site * (point_m - after.lander_in_site_m));
        BearingObservation::from_sigma(track_id, direction, 1e-3)
    };
    let bearings = [toward(0, Vector3::zeros()), toward(1, after.landmarks[0].position_in_site_m)];
    let model = CorrectionModel {
        kind: FilterKind::Hybrid,
        gate: Gate { confidence: 0.9999 },
        iterations: 1,
        camera_in_lander_m: Vector3::zeros(),
        second_order: true,
    };
    let step = |start: DescentEstimate| {
        let predicted = predict(start, &increment, &PLANET, FilterKind::Hybrid);
        correct(predicted, &bearings, &model).expect("positive definite")
    };
    let copying = microseconds(10, 5000, || drop(black_box(start.clone())));
    microseconds(10, 5000, || drop(black_box(step(black_box(start.clone()))))) - copying
}

fn selection_us(selector: Selector) -> f64 {
    let increment = exact_increment(&truth(60.0), &truth(61.0), 1.0);
    let view = viewpoint(&estimate(), &increment, 1e-3, &LandingConfig::default());
    let mut random = random_stream(1, "speed", 0);
    microseconds(7, 300, || {
        black_box(selector.ideal_landmark_in_site_m(black_box(&view), &mut random));
    })
}

#[test]
#[ignore = "prints times"]
fn accuracy_table_of_landing_times() {
    let svd_us = selection_us(Selector::Svd);
    let mut bars = vec![Bar::stated("filter step, 1 known and 1 unknown landmark (aim 5)", filter_step_us(), "µs")];
    for selector in Selector::ALL {
        let us = selection_us(selector);
        bars.push(Bar::stated(format!("choice by {}", selector.word()), us, "µs"));
        bars.push(Bar::stated(format!("choice by {}, share of svd's", selector.word()), us / svd_us, ""));
    }
    let start = ThreadTime::now();
    (0..300).for_each(|run| drop(fly(&CampaignOptions::default(), run)));
    bars.push(Bar::stated("300 flights with choice and bound (aim 3)", start.elapsed().as_secs_f64(), "CPU-s"));
    check_table("Landing: processor time", std::iter::once(bars));
}
