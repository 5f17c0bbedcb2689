//! The settings of the whole front end.

use opnav::vision::*;

#[test]
fn the_configuration_refuses_unknown_keys_and_values_out_of_range() {
    let config: FrontEndConfig = toml::from_str("mode = \"fixed-center\"\n[detector]\nmax_features = 500\n").unwrap();
    assert_eq!((config.mode, config.detector.max_features), (FrontEndMode::FixedCenter, 500));
    assert!(toml::from_str::<FrontEndConfig>("speed = 3").is_err());
    assert!(FrontEndConfig::default().validate().is_ok());
    let mut wrong = FrontEndConfig::default();
    wrong.detector.block_px = 4;
    assert!(wrong.validate().unwrap_err().to_string().contains("detector.block_px is 4"));
}
