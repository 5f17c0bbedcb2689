//! Input that cannot be used, and the files of a result.

use super::simulated::{design, rate_deg_s, run, simulate};
use crate::reference_body::{RATIOS, rate_rad_s};
use nalgebra::{Quaternion, UnitQuaternion};
use opnav::dataset::read_timed_table;
use opnav::navigation::tumbling::*;
use opnav::observations::{PairStatus, RelativeRotation};

#[test]
fn unusable_input_gives_one_clear_error() {
    let good = simulate(rate_rad_s(), RATIOS, &design(30.0, 1.0), 1.0, 1);
    let config = TumblingConfig::default();
    let refused = |pairs: &[RelativeRotation], times: &[i64], config: &TumblingConfig| {
        estimate(pairs, times, config).unwrap_err().to_string()
    };
    let mut none = good.pairs.clone();
    none.iter_mut().skip(4).for_each(|p| p.status = PairStatus::Rejected);
    assert!(refused(&none, &good.times_ns, &config).contains("4 of"));
    assert!(refused(&[], &good.times_ns, &config).contains("0 of 0 image pairs"));
    let mut late = good.pairs.clone();
    late[3].t_ns_to += 1;
    assert!(refused(&late, &good.times_ns, &config).contains("same sequence"));
    let mut reversed = good.pairs.clone();
    reversed[3].t_ns_to = reversed[3].t_ns_from;
    assert!(refused(&reversed, &good.times_ns, &config).contains("earlier picture"));
    let mut nan = good.pairs.clone();
    nan[5].camera_to_from_camera_from = UnitQuaternion::new_unchecked(Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    assert!(refused(&nan, &good.times_ns, &config).contains("unit quaternion"));
    let mut flat = good.pairs.clone();
    flat[5].covariance_rad2[(1, 1)] = 0.0;
    assert!(refused(&flat, &good.times_ns, &config).contains("positive definite"));
    flat[5].covariance_rad2[(1, 1)] = f64::NAN;
    assert!(refused(&flat, &good.times_ns, &config).contains("finite"));
    let mut times = good.times_ns.clone();
    times.swap(3, 4);
    assert!(refused(&good.pairs, &times, &config).contains("31 pictures"));
    let wrong = TumblingConfig { growth: 1.0, ..config };
    assert!(refused(&good.pairs, &good.times_ns, &wrong).contains("growth is 1"));
    assert!(toml::from_str::<TumblingConfig>("first_arc = 3.0").is_err());
    assert_eq!(toml::from_str::<TumblingConfig>("estimator = 'realtime'").unwrap().estimator, Estimator::Realtime);
}

#[test]
fn files_hold_every_image_and_no_invented_number() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = simulate(rate_rad_s(), RATIOS, &design(60.0, 1.0), 1.0, 1);
    let result = run(&sequence, &TumblingConfig::default());
    let (estimate_csv, covariance_csv) = (folder.path().join("estimate.csv"), folder.path().join("covariance.csv"));
    write_estimate_csv(&estimate_csv, &result).unwrap();
    write_covariance_csv(&covariance_csv, &result).unwrap();
    let table = read_timed_table(&estimate_csv, 23).unwrap();
    assert_eq!((table.rows.len(), table.columns[0].as_str(), table.columns[22].as_str()), (61, "qw", "sigma_Lyz"));
    assert_eq!(table.rows[7].values[7..12], result.inertia_ratios.unwrap());
    assert_eq!(table.rows[7].values[4], result.epochs[7].rate_in_asteroid_rad_s.x);
    let table = read_timed_table(&covariance_csv, 21).unwrap();
    assert_eq!(table.columns[6], "c_ay_ay");
    assert_eq!(table.rows[9].values[6], result.epochs[9].covariance[(1, 1)]);
    let spin =
        simulate(rate_deg_s(0.0, 4.0, 0.0), InertiaRatios([0.85, 1.37, 0.0, 0.0, 0.0]), &design(60.0, 1.0), 1.0, 1);
    write_estimate_csv(&estimate_csv, &run(&spin, &TumblingConfig::default())).unwrap();
    let text = std::fs::read_to_string(&estimate_csv).unwrap();
    assert_eq!(text.lines().nth(1).unwrap().matches("NaN").count(), 6);
}
