//! Campaigns of simulated landings against the audited reference simulation, the posterior Cramér–Rao bound, and what
//! must fail. Cheap versions run with the ordinary tests.

use crate::accuracy_bar::{Bar, check_table};
use opnav::campaign::{Campaign, CampaignOptions, FieldOfView, run_campaign};
use opnav::navigation::landing::{FilterKind, LandingConfig};
use opnav::navigation::landmark::Selector;

/// Rotation of Mars in the axes of a site at 25° north, x east, y north.
const MARS_RATE_RAD_S: [f64; 3] = [0.0, 6.424e-5, 2.996e-5];

fn fly_all(options: &CampaignOptions) -> Campaign {
    run_campaign(options, &|| ()).expect("options in range")
}

fn with(filter: impl FnOnce(&mut LandingConfig)) -> CampaignOptions {
    let mut options = CampaignOptions::default();
    filter(&mut options.filter);
    options
}

/// What every consistent campaign of the reference case keeps.
fn consistency_bars(name: &str, campaign: &Campaign) -> Vec<Bar> {
    let runs = campaign.flights.len() as f64;
    let nees: Vec<f64> = (30..=182).map(|second| campaign.nees(second)).collect();
    let (least, most) = (nees.iter().copied().fold(9.0, f64::min), nees.iter().copied().fold(0.0, f64::max));
    let mut bars = vec![
        Bar::at_least(format!("{name}: converged of {runs}"), campaign.converged() as f64, runs, ""),
        Bar::at_least(format!("{name}: least mean NEES/9 of 30-182 s"), least, 0.88, ""),
        Bar::at_most(format!("{name}: largest mean NEES/9 of 30-182 s"), most, 1.12, ""),
        Bar::at_least(format!("{name}: NIS per degree of freedom"), campaign.nis(30..=182), 0.95, ""),
        Bar::at_most(format!("{name}: NIS per degree of freedom"), campaign.nis(30..=182), 1.05, ""),
    ];
    let yaw = |pick: fn(f64, f64) -> f64, start: f64| {
        let all = campaign.flights.iter().flat_map(|f| f.epochs.iter().skip(30)).map(|e| e.sigma[8].to_degrees());
        all.fold(start, pick)
    };
    bars.push(Bar::at_least(format!("{name}: least yaw 1 sigma of any run"), yaw(f64::min, 9.0), 1.07, "°"));
    bars.push(Bar::at_most(format!("{name}: largest yaw 1 sigma of any run"), yaw(f64::max, 0.0), 1.09, "°"));
    bars
}

/// Errors over the bound at the seconds of the reference, the worst of position, velocity and tilt.
fn bound_bars(name: &str, campaign: &Campaign) -> Vec<Bar> {
    let mut bars = Vec::new();
    for (second, limit) in [(60, 1.15), (120, 1.15), (182, 1.15), (198, 1.20)] {
        let ratio = |c: usize| campaign.rms(second, c) / campaign.bound(second, c);
        let worst = (0..8).map(ratio).fold(0.0, f64::max);
        bars.push(Bar::at_most(format!("{name}: r.m.s. over bound at {second} s, worst of 8"), worst, limit, ""));
    }
    bars
}

fn final_bars(name: &str, campaign: &Campaign) -> Vec<Bar> {
    let e = campaign.final_errors();
    vec![
        Bar::at_most(format!("{name}: horizontal, 3 r.m.s."), e.horizontal_m, 0.12, "m"),
        Bar::at_most(format!("{name}: z, 3 r.m.s."), e.z_m, 5.6, "m"),
        Bar::at_most(format!("{name}: velocity, 3 r.m.s."), e.velocity_m_s, 0.09, "m/s"),
        Bar::at_most(format!("{name}: roll, 3 r.m.s."), e.roll_deg, 0.028, "°"),
        Bar::at_most(format!("{name}: pitch, 3 r.m.s."), e.pitch_deg, 0.014, "°"),
    ]
}

/// A figure within its Monte Carlo error of the reference's: both are r.m.s. of 300 runs, 4 % each at 1σ.
fn near(quantity: String, measured: f64, reference: f64, unit: &'static str) -> Bar {
    Bar::at_most(
        format!("{quantity} {measured:.3} {unit}, reference {reference}: off by"),
        (measured / reference - 1.0).abs(),
        0.2,
        "",
    )
}

#[test]
fn a_small_campaign_is_consistent_and_near_the_bound() {
    let campaign = fly_all(&CampaignOptions { runs: 60, ..CampaignOptions::default() });
    assert_eq!(campaign.converged(), 60);
    let errors = campaign.final_errors();
    assert!((0.9..1.1).contains(&errors.nees) && (0.95..1.05).contains(&campaign.nis(30..=182)), "{errors:?}");
    for second in [60, 120, 182, 198] {
        for c in 0..8 {
            let ratio = campaign.rms(second, c) / campaign.bound(second, c);
            assert!((0.7..1.35).contains(&ratio), "component {c} at {second} s: {ratio} of the bound");
        }
    }
}

/// The bound is no filter's own opinion: the same campaign with the paper's filter has the same bound and misses it.
#[test]
fn the_standard_filter_misses_the_bound() {
    let options = CampaignOptions { runs: 60, ..with(|f| f.filter = FilterKind::Standard) };
    let campaign = fly_all(&options);
    let ratio = campaign.rms(182, 6) / campaign.bound(182, 6);
    assert!(ratio > 1.5 && campaign.final_errors().nees > 5.0, "{ratio} {:?}", campaign.final_errors());
}

/// On a planet that turns as Mars does, the filter that knows it stays consistent; the one that does not is off by metres.
#[test]
fn the_planets_rotation_matters_and_is_handled() {
    let turning = |known: [f64; 3]| CampaignOptions {
        runs: 40,
        planet_rate_in_site_rad_s: MARS_RATE_RAD_S,
        ..with(|f| f.planet_rate_in_site_rad_s = known)
    };
    let knowing = fly_all(&turning(MARS_RATE_RAD_S));
    let ignorant = fly_all(&turning([0.0; 3]));
    assert_eq!(knowing.converged(), 40);
    assert!((0.85..1.15).contains(&knowing.final_errors().nees), "{:?}", knowing.final_errors());
    assert!(ignorant.final_errors().nees > 2.0, "{:?}", ignorant.final_errors());
}

#[test]
fn flights_do_not_depend_on_threads_and_differ_by_seed() {
    let options = CampaignOptions { runs: 4, ..CampaignOptions::default() };
    let errors = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let campaign = pool.install(|| fly_all(&CampaignOptions { seed, ..options.clone() }));
        campaign.flights.iter().flat_map(|f| f.epochs.clone()).collect::<Vec<_>>()
    };
    assert_eq!(errors(1, 5), errors(3, 5));
    assert_ne!(errors(1, 5), errors(1, 6));
}

#[test]
fn campaign_options_out_of_range_are_named() {
    let cases = [
        (CampaignOptions { runs: 0, ..CampaignOptions::default() }, "runs"),
        (CampaignOptions { sigma_bearing_rad: f64::NAN, ..CampaignOptions::default() }, "sigma_bearing_rad"),
        (CampaignOptions { outlier_share: 0.9, ..CampaignOptions::default() }, "outlier_share"),
        (with(|f| f.reselect_after = 0), "reselect_after"),
        (CampaignOptions { known_landmarks_m: vec![[f64::NAN, 0.0, 0.0]], ..CampaignOptions::default() }, "known"),
    ];
    for (options, word) in cases {
        let error = run_campaign(&options, &|| ()).expect_err("out of range").to_string();
        assert!(error.contains(word), "{error}");
    }
}

/// Three seeds of 300 and one of 3000: convergence, consistency, errors and the bound. The limits leave little room for
/// chance with 300 flights: of 39 seeds up to 40, five exceed the ratio of 1.15 or 1.20 for one of eight components (3, 14,
/// 22, 24 and 38, by 0.05 at most), and seed 3 the limit on NEES too. The 3000 flights have no such excuse.
#[test]
#[ignore = "thousands of flights"]
fn accuracy_of_landing_campaigns() {
    let parts = [(1, 300), (2, 300), (3, 300), (4, 3000)].into_iter().map(|(seed, runs)| {
        let campaign = fly_all(&CampaignOptions { seed, runs, ..CampaignOptions::default() });
        let name = format!("seed {seed}, {runs} runs");
        let mut bars = consistency_bars(&name, &campaign);
        bars.extend(bound_bars(&name, &campaign));
        bars.extend(final_bars(&name, &campaign));
        bars
    });
    check_table("Landing by simulated bearings", parts);
}

/// Every row of the reference table, in its order: converged, horizontal, z, z by P, velocity, roll, pitch, NEES.
#[test]
#[ignore = "thousands of flights"]
fn accuracy_of_the_reference_table() {
    let hybrid = |selector| with(|f| f.selector = selector);
    let standard = |selector| {
        with(|f| {
            f.filter = FilterKind::Standard;
            f.selector = selector;
        })
    };
    let second_known = CampaignOptions { known_landmarks_m: vec![[1000.0, 0.0, 0.0]], ..CampaignOptions::default() };
    let rows: [(&str, CampaignOptions, [f64; 4]); 9] = [
        ("depth error", hybrid(Selector::DepthError), [0.106, 4.69, 0.080, 0.024]),
        ("svd", hybrid(Selector::Svd), [0.106, 5.27, 0.080, 0.024]),
        ("gdop", hybrid(Selector::Gdop), [0.106, 5.47, 0.080, 0.024]),
        ("condition", hybrid(Selector::Condition), [0.106, 5.32, 0.080, 0.024]),
        ("random", hybrid(Selector::Random), [0.101, 2.98, 0.079, 0.024]),
        ("covariance", hybrid(Selector::Covariance), [0.097, 1.33, 0.078, 0.024]),
        ("5 landmarks", with(|f| f.unknown_landmarks = 5), [0.096, 2.02, 0.077, 0.023]),
        ("none", hybrid(Selector::None), [0.120, 22.0, 0.107, 0.024]),
        ("2nd known", second_known, [0.083, 0.77, 0.015, 0.005]),
    ];
    let consistent = rows.into_iter().map(|(name, options, [horizontal, z, velocity, roll])| {
        let e = fly_all(&options).final_errors();
        vec![
            Bar::at_least(format!("{name}: converged"), e.converged as f64, 300.0, ""),
            near(format!("{name}: horizontal"), e.horizontal_m, horizontal, "m"),
            near(format!("{name}: z"), e.z_m, z, "m"),
            near(format!("{name}: velocity"), e.velocity_m_s, velocity, "m/s"),
            near(format!("{name}: roll"), e.roll_deg, roll, "°"),
            Bar::stated(format!("{name}: z by P"), e.z_believed_m, "m"),
            Bar::stated(format!("{name}: NEES/9"), e.nees, ""),
        ]
    });
    let papers = [("depth error", Selector::DepthError, 5.0), ("none", Selector::None, 100.0)];
    let inconsistent = papers.into_iter().map(|(name, selector, least_nees)| {
        let e = fly_all(&standard(selector)).final_errors();
        vec![
            Bar::stated(format!("standard EKF, {name}: converged of 300"), e.converged as f64, ""),
            Bar::at_least(format!("standard EKF, {name}: NEES/9, inconsistent"), e.nees, least_nees, ""),
        ]
    });
    check_table("Landing: the reference table (3 r.m.s. at touchdown)", consistent.chain(inconsistent));
}

/// 300 of 300 land whatever the noise, the path, the camera, outliers and relief.
#[test]
#[ignore = "thousands of flights"]
fn accuracy_of_landings_under_other_conditions() {
    let sigma = |sigma_bearing_rad: f64| CampaignOptions { sigma_bearing_rad, ..CampaignOptions::default() };
    let seen = |field_of_view| CampaignOptions { field_of_view, ..CampaignOptions::default() };
    let outliers = CampaignOptions { outlier_share: 0.05, ..with(|f| f.gate_confidence = 1.0 - 1e-5) };
    let turning = CampaignOptions {
        planet_rate_in_site_rad_s: MARS_RATE_RAD_S,
        ..with(|f| f.planet_rate_in_site_rad_s = MARS_RATE_RAD_S)
    };
    let papers = CampaignOptions { guidance: CampaignOptions::papers_attitude(), ..CampaignOptions::default() };
    let cases = [
        ("bearings of 0.1 mrad", sigma(1e-4)),
        ("bearings of 0.3 mrad", sigma(3e-4)),
        ("bearings of 0.5 mrad", sigma(5e-4)),
        ("bearings of 2 mrad", sigma(2e-3)),
        ("the paper's attitude", papers),
        ("90° camera", seen(FieldOfView::Wide)),
        ("canted 60° camera", seen(FieldOfView::Canted)),
        ("5 % outliers", outliers),
        ("20 m smooth relief", CampaignOptions { relief_m: 20.0, ..CampaignOptions::default() }),
        ("Mars turns", turning),
    ];
    let parts = cases.into_iter().map(|(name, options)| {
        let campaign = fly_all(&options);
        let e = campaign.final_errors();
        vec![
            Bar::at_least(format!("{name}: converged of 300"), e.converged as f64, 300.0, ""),
            Bar::stated(format!("{name}: horizontal, 3 r.m.s."), e.horizontal_m, "m"),
            Bar::stated(format!("{name}: z, 3 r.m.s."), e.z_m, "m"),
            Bar::stated(format!("{name}: NEES/9 of 30-182 s"), e.nees, ""),
        ]
    });
    check_table("Landing under other conditions", parts);
}
