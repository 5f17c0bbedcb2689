//! The file of the noise model: what it has to hold, and that the settings are what it holds.

use opnav::vision::*;

fn refusal(text: &str) -> String {
    NoiseModelFile::parse(text).expect_err("refused").to_string()
}

/// The library's file with the value of one constant replaced.
fn with_value(key: &str, value: &str) -> String {
    let head = format!("[constants.{key}]\nvalue = ");
    let at = NoiseModelFile::EMBEDDED.find(&head).expect("the constant") + head.len();
    let end = at + NoiseModelFile::EMBEDDED[at..].find('\n').expect("a line");
    format!("{}{value}{}", &NoiseModelFile::EMBEDDED[..at], &NoiseModelFile::EMBEDDED[end..])
}

#[test]
fn the_settings_are_those_of_the_file() {
    let file = NoiseModelFile::parse(NoiseModelFile::EMBEDDED).expect("the library's own file");
    assert_eq!(file, NoiseModelFile::default());
    assert_eq!(file.constants(), NoiseModel::default());
    assert_eq!(FrontEndConfig::default(), FrontEndConfig::default().with_noise_model(&file.constants()));
    assert_eq!(MapMatchConfig::default(), MapMatchConfig::default().with_noise_model(&file.constants()));
    let other = NoiseModelFile::parse(&with_value("patch.floor_sigma_px", "0.5")).expect("a usable number").constants();
    let config = FrontEndConfig::default().with_noise_model(&other);
    let map = MapMatchConfig::default().with_noise_model(&other);
    assert_eq!((config.klt.noise.floor_sigma_px, map.patch_noise.floor_sigma_px), (0.5, 0.5));
    assert_ne!(config, FrontEndConfig::default());
}

#[test]
fn every_constant_says_where_it_comes_from() {
    let file = NoiseModelFile::default();
    for (key, constant) in file.constants.entries() {
        assert!(constant.source.len() > 20 && !constant.validity.is_empty(), "{key}");
        let Some([low, high]) = constant.interval_95 else { continue };
        assert!(low <= constant.value && constant.value <= high && constant.samples > 0, "{key}: {constant:?}");
    }
}

#[test]
fn a_constant_that_is_no_usable_number_is_named() {
    for (key, _) in NoiseModel::default().entries() {
        for wrong in ["nan", "inf", "-1.0"] {
            let said = refusal(&with_value(key, wrong));
            assert!(said.contains(key), "{key} = {wrong}: {said}");
        }
    }
    for key in ["patch.shared_pixels", "pair.far_view", "pair.over_likeliest", "body.over_likeliest"] {
        assert!(refusal(&with_value(key, "0.0")).contains(key));
    }
    assert!(refusal(&with_value("pair.correlated_error_share", "1.5")).contains("from 0 to 1"));
    assert!(NoiseModelFile::parse(&with_value("pair.correlated_error_share", "0.0")).is_ok(), "white noise is allowed");
}

#[test]
fn unknown_and_missing_constants_are_named() {
    let text = NoiseModelFile::EMBEDDED;
    let missing = text.replace("[constants.patch.floor_sigma_px]", "[constants.patch.floor_px]");
    assert!(refusal(&missing).contains("floor_px"), "{}", refusal(&missing));
    let at = text.find("\n[constants.map.standing_out]").expect("the constant");
    let next = at + 1 + text[at + 1..].find("\n[").expect("another one");
    let said = refusal(&format!("{}{}", &text[..at], &text[next..]));
    assert!(said.contains("standing_out"), "{said}");
    assert!(refusal(&text.replace("value = ", "val = ")).contains("val"));
    assert!(refusal(&text.replace("format = 1", "format = 2")).contains("format"));
    assert!(refusal(&format!("surprise = 1\n{text}")).contains("surprise"));
}

#[test]
fn settings_with_a_noise_model_out_of_range_are_refused() {
    let mut config = FrontEndConfig::default();
    config.designated.common_share = f64::NAN;
    assert!(config.validate().expect_err("refused").to_string().contains("designated.common_share"));
}
