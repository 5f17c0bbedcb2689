//! What counts more than what, and what a part of a table leaves alone.

use super::resolved;
use opnav::pipeline::{
    BiasPrior, CampaignOptions, Estimator, FrontEndMode, LandSettings, MonteCarloSettings, TrackSettings,
    TumbleSettings,
};
use opnav::settings::{Settings, written};

#[test]
fn a_change_counts_more_than_a_file_and_a_file_more_than_defaults() {
    let features = |file: Option<&str>, overrides: &[&str]| {
        resolved::<TrackSettings>(file, overrides).expect("fine").front_end.detector.max_features
    };
    let (file, key) = ("[front_end.detector]\nmax_features = 500\n", "front_end.detector.max_features");
    assert_eq!(features(None, &[]), 1000);
    assert_eq!(features(Some(file), &[]), 500);
    assert_eq!(features(None, &[&format!("{key}=300")]), 300);
    assert_eq!(features(Some(file), &[&format!("{key}=300")]), 300);
    assert_eq!(features(Some(file), &[&format!("{key}=300"), &format!("{key}= 200")]), 200, "the last one");
}

#[test]
fn a_part_of_a_table_leaves_the_commands_own_defaults() {
    let land: LandSettings = resolved(Some("[landing]\ngravity_m_s2 = 1.62\n"), &[]).expect("fine");
    assert_eq!((land.landing.unknown_landmarks, land.landing.gravity_m_s2), (3, 1.62));
    let tumble: TumbleSettings =
        resolved(Some("[front_end.klt]\nlevels = 2\n"), &["tumbling.estimator=paper"]).expect("fine");
    assert_eq!(tumble.front_end.mode, FrontEndMode::FixedCenter);
    assert_eq!((tumble.front_end.klt.levels, tumble.tumbling.estimator), (2, Estimator::Paper));
    let campaign: MonteCarloSettings = resolved(Some("[campaign.filter]\nselector = \"svd\"\n"), &[]).expect("fine");
    assert_eq!(campaign.campaign.filter.reselect_after, CampaignOptions::default().filter.reselect_after);
}

#[test]
fn another_form_of_a_choice_takes_the_whole_place() {
    let quintic = "[campaign.guidance.profile.quintic]\ninitial_acceleration_m_s2 = [1, 2, 3]\n";
    let profile = |file: Option<&str>, overrides: &[&str]| {
        let settings = resolved::<MonteCarloSettings>(file, overrides).expect("fine");
        serde_json::to_value(settings.campaign.guidance.profile).expect("plain data")
    };
    let key = "campaign.guidance.profile";
    let [changed, replaced] = [[1.0, 2.0, 3.0], [0.0, 0.0, 1.0]]
        .map(|a| serde_json::json!({ "quintic": { "initial_acceleration_m_s2": a } }));
    assert_eq!(profile(Some(quintic), &[]), changed);
    assert_eq!(profile(Some(quintic), &[&format!("{key}=quartic")]), "quartic");
    let line = format!("{key}.quintic.initial_acceleration_m_s2=[0, 0, 1]");
    assert_eq!(profile(None, &[&line]), replaced);
    assert_eq!(profile(Some(quintic), &[&line]), replaced);
}

#[test]
fn entries_of_lists_and_tables_that_were_not_there_are_set() {
    let rate: LandSettings = resolved(None, &["landing.planet_rate_in_site_rad_s.2=7e-5"]).expect("fine");
    assert_eq!(rate.landing.planet_rate_in_site_rad_s, [0.0, 0.0, 7e-5]);
    let biases = ["landing.biases.sigma_gyroscope_rad_s=1e-6", "landing.biases.sigma_accelerometer_m_s2=1e-3"];
    let found: LandSettings = resolved(None, &biases).expect("fine");
    let wanted = BiasPrior { sigma_gyroscope_rad_s: 1e-6, sigma_accelerometer_m_s2: 1e-3 };
    assert_eq!(found.landing.biases, Some(wanted));
    let half = resolved::<LandSettings>(None, &biases[..1]).expect_err("half a table");
    assert!(half.contains("landing.biases") && half.contains("sigma_accelerometer_m_s2"), "{half}");
}

/// What a command writes is read back to the same settings, and written again to the same bytes.
fn survives<S: Settings + PartialEq + std::fmt::Debug>(overrides: &[&str]) {
    let settings: S = resolved(None, overrides).expect("fine");
    let text = written(&settings, "command");
    let again: S = resolved(Some(&text), &[]).expect("it reads back");
    assert_eq!(again, settings, "{text}");
    assert_eq!(written(&again, "command"), text);
    assert!(overrides.is_empty() || settings != S::default());
}

#[test]
fn the_resolved_copy_reads_back_equal() {
    survives::<TrackSettings>(&[]);
    survives::<LandSettings>(&[]);
    survives::<TumbleSettings>(&[]);
    survives::<MonteCarloSettings>(&[]);
    survives::<TrackSettings>(&[
        "input.camera=a b.yaml",
        "input.times=\"times.csv\"",
        "input.every=3",
        "input.frames=[2, 9]",
        "input.mask=mask.png",
        "front_end.rotation.seed=9223372036854775807",
        "front_end.keyframe_spans=[]",
    ]);
    survives::<TrackSettings>(&["input.fov_deg=33.3", "input.rate_hz=0.1", "front_end.mode=fixed-center"]);
    survives::<LandSettings>(&["landing.biases={sigma_gyroscope_rad_s=1e-6, sigma_accelerometer_m_s2=0.1}"]);
    survives::<TumbleSettings>(&["tumbling.paper.initial_rate_deg_s=[0.1, 0.7, 1e-300]"]);
    survives::<MonteCarloSettings>(&[
        "selectors=[\"svd\", \"none\"]",
        "campaign.known_landmarks_m=[[1, 2, 3], [4.5, 5, 6]]",
        "campaign.filter.gate_confidence=0.999999999",
        "campaign.guidance.profile.quintic.initial_acceleration_m_s2=[0.1, 0.2, 1]",
    ]);
}
