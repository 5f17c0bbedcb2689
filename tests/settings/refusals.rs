//! What is refused, in which words.

use super::resolved;
use opnav::pipeline::{LandSettings, TrackSettings};
use opnav::settings::{Layers, OutOfRange, limits};

fn refused(file: Option<&str>, overrides: &[&str]) -> String {
    resolved::<TrackSettings>(file, overrides).expect_err("refused")
}

fn names(error: &str, words: &[&str]) {
    for word in words {
        assert!(error.contains(word), "'{word}' is not in: {error}");
    }
    assert_eq!(error.lines().count(), 1, "{error}");
}

#[test]
fn an_unknown_key_is_named_with_its_place_and_the_nearest_key() {
    let file = "[input]\nevery = 2\n\n[front_end.detector]\nmax_featurs = 500\n";
    names(
        &refused(Some(file), &[]),
        &[
            "mine.toml, line 5",
            "front_end.detector.max_featurs",
            "did you mean front_end.detector.max_features?",
            "opnav reference",
        ],
    );
    names(
        &refused(None, &["front_end.detektor.max_features=5"]),
        &["--set front_end.detektor", "did you mean front_end.detector.max_features?"],
    );
    names(
        &refused(None, &["max_features=5"]),
        &["there is no key max_features", "did you mean front_end.detector.max_features?"],
    );
    let far = refused(None, &["xyzzy=5"]);
    names(&far, &["there is no key xyzzy;"]);
    assert!(!far.contains("did you mean"), "{far}");
    names(&refused(Some("[landing]\nseed = 1\n"), &[]), &["mine.toml, line 1", "landing"]);
    let input = resolved::<LandSettings>(None, &["input.every=2"]).expect_err("a key of another command");
    names(&input, &["there is no key input.every"]);
}

#[test]
fn a_value_of_another_type_is_named_with_its_place() {
    let file = "[front_end]\nkeyframe_max_angle_rad = 0.5\n[front_end.detector]\nmax_features = \"many\"\n";
    names(&refused(Some(file), &[]), &["mine.toml, line 4", "front_end.detector.max_features", "many", "usize"]);
    for (line, words) in [
        ("front_end.detector.max_features=many", ["--set front_end.detector.max_features=many", "many"]),
        ("front_end.detector.max_features=1.5", ["front_end.detector.max_features", "1.5"]),
        ("front_end.detector.max_features=-1", ["front_end.detector.max_features", "-1"]),
        ("front_end.klt.follow_lost=1", ["front_end.klt.follow_lost", "boolean"]),
        ("front_end.mode=round", ["front_end.mode", "fixed-center"]),
        ("front_end.detector=5", ["front_end.detector", "struct DetectorConfig"]),
        ("front_end.keyframe_spans=2", ["front_end.keyframe_spans", "sequence"]),
    ] {
        names(&refused(None, &[line]), &words);
    }
}

#[test]
fn a_value_out_of_range_is_named_with_its_place_and_cure() {
    let file = "[front_end.detector]\nmax_features = 5\nblock_px = 4\n";
    names(&refused(Some(file), &[]), &["mine.toml, line 3", "front_end.detector.block_px is 4", "odd"]);
    let both = refused(Some(file), &["front_end.detector.block_px=6"]);
    names(&both, &["--set front_end.detector.block_px=6", "is 6", "odd"]);
    for value in ["nan", "inf", "-inf", "0"] {
        let line = format!("front_end.rotation.sigma_px={value}");
        names(&refused(None, &[&line]), &["front_end.rotation.sigma_px is", "it must be a positive number"]);
    }
    names(&refused(None, &["input.fov_deg=60", "input.camera=a.yaml"]), &["input.fov_deg", "drop one"]);
    names(&refused(None, &["input.rate_hz=1", "input.times=a.csv"]), &["input.rate_hz", "drop one"]);
    names(&refused(None, &["input.frames=[5, 5]"]), &["input.frames is 5, 5", "below"]);
}

#[test]
fn what_is_no_change_and_no_toml_is_named() {
    for (line, words) in [
        ("front_end", ["--set front_end", "table.key=value"]),
        ("=3", ["--set =3", "empty"]),
        ("front_end..klt=3", ["--set front_end..klt=3", "empty"]),
        ("front_end.keyframe_spans.7=2", ["--set front_end.keyframe_spans.7=2", "no entry 7"]),
    ] {
        names(&refused(None, &[line]), &words);
    }
    names(&refused(Some("[input]\nevery = \n"), &[]), &["mine.toml", "line 2"]);
    names(&refused(Some("[input]\nevery = 1\nevery = 2\n"), &[]), &["mine.toml", "line 3"]);
    let missing = Layers { file: Some("/nonexistent/mine.toml".into()), overrides: Vec::new() };
    let error = missing.resolve::<TrackSettings>().expect_err("no file").to_string();
    names(&error, &["could not read", "/nonexistent/mine.toml"]);
}

#[test]
fn limits_hold_at_their_ends_and_refuse_what_is_no_number() {
    type Check = fn(f64) -> Result<(), OutOfRange>;
    let checks: [(Check, &[f64], &[f64]); 6] = [
        (|v| limits::positive("k", v), &[1e-300, 1.0], &[0.0, -1.0, f64::INFINITY]),
        (|v| limits::above("k", v, 1.0), &[1.001], &[1.0, f64::INFINITY]),
        (|v| limits::at_least("k", v, 1.0), &[1.0], &[0.999, f64::INFINITY]),
        (|v| limits::within("k", v, 0.0, 1.0), &[0.0, 1.0], &[-1e-9, 1.001]),
        (|v| limits::above_to("k", v, 0.0, 1.0), &[1e-9, 1.0], &[0.0, 1.001]),
        (|v| limits::between("k", v, 0.0, 1.0), &[1e-9, 0.999], &[0.0, 1.0]),
    ];
    for (index, (check, fine, wrong)) in checks.iter().enumerate() {
        assert!(fine.iter().all(|v| check(*v).is_ok()), "check {index}");
        assert!(wrong.iter().chain(&[f64::NAN]).all(|v| check(*v).is_err()), "check {index}");
    }
    assert!(
        limits::count("k", 3, 3, 4).is_ok()
            && limits::count("k", 2, 3, 4).is_err()
            && limits::count("k", 5, 3, 4).is_err()
    );
    assert!(limits::count_from("k", 3, 3).is_ok() && limits::count_from("k", 2, 3).is_err());
    assert!(limits::seed("k", i64::MAX as u64).is_ok() && limits::seed("k", i64::MAX as u64 + 1).is_err());
    assert!(limits::finite("k", &[1.0, 2.0]).is_ok() && limits::finite("k", &[1.0, f64::NAN]).is_err());
    let fault = limits::positive("k", -1.0).expect_err("refused").under("b").under("a");
    assert_eq!(fault.to_string(), "a.b.k is -1: it must be a positive number");
}
