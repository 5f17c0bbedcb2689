//! Options of the landing filter that several subcommands share.

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use opnav::pipeline::{BiasPrior, FilterKind, ImageRotationUse, LandingConfig, LandmarkStart, Selector};

/// Parses the word of a selector.
pub fn selector_parser() -> impl TypedValueParser<Value = Selector> {
    PossibleValuesParser::new(Selector::ALL.map(Selector::word))
        .map(|word| Selector::ALL.into_iter().find(|s| s.word() == word).expect("one of the possible words"))
}

/// How the filter works.
#[derive(Debug, Clone, clap::Args)]
pub struct LandingOptions {
    /// The filter: the consistent one, or the paper's standard error-state one.
    #[arg(long, value_enum, default_value = "hybrid")]
    filter: FilterName,
    /// How a new landmark gets its first place: on the plane of the ground at once, or where two bearings meet.
    #[arg(long, value_enum, default_value = "plane")]
    landmark_start: StartName,
    /// Gravity of the planet in m/s².
    #[arg(long, value_name = "M_S2", default_value = "3.711")]
    gravity: f64,
    /// Rotation of the planet in the site's axes, rad/s.
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', num_args = 3, allow_hyphen_values = true)]
    planet_rate_rad_s: Option<Vec<f64>>,
    /// Estimate the IMU's biases, from 0 give or take these 1σ: gyroscope in °/h, accelerometer in m/s².
    #[arg(long, value_name = "DEG_H,M_S2", value_delimiter = ',', num_args = 2)]
    biases: Option<Vec<f64>>,
    /// What is done with the rotations that images tell: compared with the gyroscope's, used as measurements, or nothing.
    #[arg(long, value_enum, default_value = "check")]
    image_rotation: RotationUseName,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FilterName {
    Hybrid,
    Standard,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum StartName {
    Plane,
    Delayed,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum RotationUseName {
    Check,
    Measure,
    Ignore,
}

impl LandingOptions {
    /// A configuration with these options.
    pub fn applied_to(&self, config: LandingConfig) -> LandingConfig {
        let biases = self.biases.as_ref().map(|sigma| BiasPrior {
            sigma_gyroscope_rad_s: sigma[0].to_radians() / 3600.0,
            sigma_accelerometer_m_s2: sigma[1],
        });
        let rate = self.planet_rate_rad_s.as_ref().map_or([0.0; 3], |rate| [rate[0], rate[1], rate[2]]);
        LandingConfig {
            filter: match self.filter {
                FilterName::Hybrid => FilterKind::Hybrid,
                FilterName::Standard => FilterKind::Standard,
            },
            landmark_start: match self.landmark_start {
                StartName::Plane => LandmarkStart::Plane,
                StartName::Delayed => LandmarkStart::Delayed,
            },
            image_rotation: match self.image_rotation {
                RotationUseName::Check => ImageRotationUse::Check,
                RotationUseName::Measure => ImageRotationUse::Measure,
                RotationUseName::Ignore => ImageRotationUse::Ignore,
            },
            gravity_m_s2: self.gravity,
            planet_rate_in_site_rad_s: rate,
            biases,
            ..config
        }
    }
}
