//! Options of the landing filter that several subcommands share.

use super::arguments::{numbers, put, word};
use opnav::pipeline::{BiasPrior, FilterKind, ImageRotationUse, LandingConfig, LandmarkStart};

/// How the filter works.
#[derive(Debug, Clone, clap::Args)]
pub struct LandingOptions {
    /// The filter: the consistent one, or the paper's standard error-state one [default: hybrid].
    #[arg(long, value_parser = word::<FilterKind>())]
    filter: Option<FilterKind>,
    /// How a new landmark gets its first place: on the plane of the ground at once, or where two bearings meet [default:
    /// plane].
    #[arg(long, value_parser = word::<LandmarkStart>())]
    landmark_start: Option<LandmarkStart>,
    /// Gravity of the planet in m/s² [default: 3.711].
    #[arg(long, value_name = "M_S2")]
    pub gravity: Option<f64>,
    /// Rotation of the planet in the site's axes, rad/s.
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    pub planet_rate_rad_s: Option<[f64; 3]>,
    /// Estimate the IMU's biases, from 0 give or take these 1σ: gyroscope in °/h, accelerometer in m/s².
    #[arg(long, value_name = "DEG_H,M_S2", value_parser = numbers::<2>)]
    biases: Option<[f64; 2]>,
    /// What is done with the rotations that images tell: compared with the gyroscope's, used as measurements, or nothing
    /// [default: check].
    #[arg(long, value_parser = word::<ImageRotationUse>())]
    image_rotation: Option<ImageRotationUse>,
}

impl LandingOptions {
    /// Puts what is given over the settings.
    pub fn apply(&self, config: &mut LandingConfig) {
        put(&mut config.filter, self.filter);
        put(&mut config.landmark_start, self.landmark_start);
        put(&mut config.image_rotation, self.image_rotation);
        put(&mut config.gravity_m_s2, self.gravity);
        put(&mut config.planet_rate_in_site_rad_s, self.planet_rate_rad_s);
        if let Some([gyroscope_deg_h, sigma_accelerometer_m_s2]) = self.biases {
            config.biases = Some(BiasPrior {
                sigma_gyroscope_rad_s: gyroscope_deg_h.to_radians() / 3600.0,
                sigma_accelerometer_m_s2,
            });
        }
    }
}
