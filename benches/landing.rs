//! The landing filter and the choice of landmarks: one step of the filter, one choice by each method, a campaign.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use nalgebra::{Isometry3, SMatrix, UnitQuaternion, Vector3};
use opnav::campaign::{CampaignOptions, StepNoise, TrueState, run_campaign};
use opnav::dataset::InitialState;
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    BearingObservation, CorrectionModel, DescentEstimate, FilterKind, ImuIncrement, InitializationModel, LandingConfig,
    correct, initial_estimate, predict, with_landmark,
};
use opnav::navigation::landmark::{GroundPrior, Selector, Triangle, Viewpoint, bearing_matrix, golden_section};
use opnav::scene::{DescentMotion, GuidanceConfig, PolynomialGuidance};
use opnav::stats::random_stream;
use std::hint::black_box;

/// The reference descent, as the campaigns simulate it.
fn truth(t_s: f64) -> TrueState {
    TrueState::at(&DescentMotion::new(PolynomialGuidance::new(&GuidanceConfig::default())), t_s)
}

/// The descent at 60 s with one unknown landmark.
fn estimate() -> DescentEstimate {
    let now = truth(60.0);
    let believed = InitialState {
        t_ns: 0,
        site_from_lander: Isometry3::from_parts(now.position_m.into(), now.lander_from_site.inverse()),
        lander_velocity_in_site_m_s: now.velocity_m_s,
        sigma_position_m: 60.0,
        sigma_velocity_m_s: 1.5,
        sigma_attitude_rad: 2e-3,
    };
    let prior = initial_estimate(&believed, &LandingConfig::default());
    let down = nalgebra::Unit::new_normalize(now.lander_from_site * Vector3::new(0.3, 0.2, -1.0));
    let model = InitializationModel {
        kind: FilterKind::Hybrid,
        camera_in_lander_m: Vector3::zeros(),
        ground: GroundPrior::default(),
    };
    with_landmark(&prior, &BearingObservation::from_sigma(1, down, 1e-3), 0, &model).expect("it looks down")
}

/// The second after that.
fn increment() -> ImuIncrement {
    let exact = truth(60.0).increment_to(&truth(61.0), 1.0, &LandingConfig::default().planet());
    StepNoise::of(&CampaignOptions::default()).stated(&exact)
}

/// Prediction by an increment and correction by the bearings of one known and one unknown landmark.
fn filter_step(criterion: &mut Criterion) {
    let (start, increment) = (estimate(), increment());
    let planet = LandingConfig::default().planet();
    let model = CorrectionModel {
        kind: FilterKind::Hybrid,
        gate: Gate { confidence: 0.9999 },
        iterations: 1,
        camera_in_lander_m: Vector3::zeros(),
        second_order: true,
    };
    let after = predict(start.clone(), &increment, &planet, FilterKind::Hybrid).state;
    let toward = |track_id: u64, point_m: Vector3<f64>| {
        let direction = nalgebra::Unit::new_normalize(after.lander_from_site * (point_m - after.lander_in_site_m));
        BearingObservation::from_sigma(track_id, direction, 1e-3)
    };
    let bearings = [toward(0, Vector3::zeros()), toward(1, after.landmarks[0].position_in_site_m)];
    criterion.bench_function("landing filter step, 1 known and 1 unknown landmark", |bencher| {
        bencher.iter_batched(
            || start.clone(),
            |estimate| {
                let predicted = predict(estimate, &increment, &planet, FilterKind::Hybrid);
                correct(predicted, &bearings, &model).expect("positive definite")
            },
            BatchSize::SmallInput,
        );
    });
}

fn view() -> Viewpoint {
    let mut covariance = SMatrix::<f64, 9, 9>::identity();
    covariance.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(100.0 * 100.0);
    covariance.fixed_view_mut::<3, 3>(6, 6).fill_diagonal(1e-4);
    let now = truth(60.0);
    Viewpoint {
        lander_in_site_m: now.position_m,
        lander_velocity_in_site_m_s: now.velocity_m_s,
        specific_force_in_site_m_s2: now.lander_from_site.inverse() * increment().velocity_in_before_m_s,
        gravity_in_site_m_s2: LandingConfig::default().planet().gravity_in_site_m_s2,
        interval_s: 1.0,
        sigma_bearing_rad: 1e-3,
        covariance,
        ground: GroundPrior::default(),
    }
}

/// One choice by each method; the searches take the same number of evaluations, and what it costs to assemble the
/// matrix of bearings for them stands apart.
fn selection(criterion: &mut Criterion) {
    let view = view();
    let mut group = criterion.benchmark_group("landmark choice");
    for selector in Selector::ALL {
        let mut random = random_stream(1, "bench", 0);
        group.bench_function(selector.word(), |bencher| {
            bencher.iter(|| selector.ideal_landmark_in_site_m(black_box(&view), &mut random));
        });
    }
    let triangle = Triangle::of(&view).expect("a descent");
    let alpha_rad = triangle.path_angle_rad;
    group.bench_function("matrices of bearings for one search", |bencher| {
        bencher.iter(|| {
            let assemble = |beta_rad: f64| {
                let point_m = triangle.landmark_in_site_m(black_box(&view), alpha_rad, beta_rad);
                bearing_matrix(&UnitQuaternion::identity(), &view.lander_in_site_m, &point_m)[(0, 0)]
            };
            golden_section(assemble, 0.0, std::f64::consts::PI - alpha_rad, Triangle::EVALUATIONS)
        });
    });
    group.finish();
}

/// The reference campaign: 300 flights of 198 s with the choice of landmarks and the Cramér–Rao bound beside each.
fn campaign(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("landing campaign");
    group.sample_size(10);
    group.bench_function("300 flights", |bencher| {
        bencher.iter(|| run_campaign(&CampaignOptions::default(), &|| ()).expect("in range"));
    });
    group.finish();
}

criterion_group!(benches, filter_step, selection, campaign);
criterion_main!(benches);
