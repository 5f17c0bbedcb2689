//! Where the Sun stands according to SPICE kernels.

use super::sunlight::ASTRONOMICAL_UNIT_M;
use crate::scene::error::SceneError;
use crate::settings::OutOfRange;
use anise::prelude::{Almanac, Epoch, Frame};
use nalgebra::{Unit, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Kernels, body and time that say where the Sun stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EphemerisConfig {
    /// SPICE kernels of positions (SPK, `.bsp`), at least one; relative paths start at the folder of the scenario file.
    /// Where two know a body, the later one counts.
    pub kernels: Vec<PathBuf>,
    /// NAIF number of the body that is lit: 499 Mars, 2025143 Itokawa, 2101955 Bennu.
    pub observer_id: i32,
    /// NAIF number of the Sun in the kernels (default 10).
    #[serde(default = "sun_id")]
    pub sun_id: i32,
    /// Time with its scale, such as `"2031-05-14T23:18:00 UTC"` or `… TDB`. The Sun stands still over the scenario.
    pub epoch: String,
}

fn sun_id() -> i32 {
    10
}

/// The Sun as a body sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SunInIcrf {
    /// Geometric direction from the body to the Sun in ICRF axes, without light time and aberration.
    pub direction_in_icrf: Unit<Vector3<f64>>,
    /// Distance in astronomical units.
    pub distance_au: f64,
}

impl EphemerisConfig {
    /// Looks the Sun up; `base_folder` is where relative paths start.
    ///
    /// # Errors
    /// Names the kernel that cannot be read, or the key at fault: kernels that do not connect body and Sun at the epoch.
    pub fn sun(&self, base_folder: &Path) -> Result<SunInIcrf, SceneError> {
        let epoch = self.parsed_epoch()?;
        let mut almanac = Almanac::default();
        for kernel in &self.kernels {
            almanac = load(almanac, &base_folder.join(kernel))?;
        }
        let (sun, observer) = (Frame::from_ephem_j2000(self.sun_id), Frame::from_ephem_j2000(self.observer_id));
        let state = almanac.translate(sun, observer, epoch, None).map_err(|problem| {
            let cure = format!(
                "the kernels do not connect body {} with the Sun ({}) at that time ({problem}): name kernels that do",
                self.observer_id, self.sun_id
            );
            SceneError::out_of_range("ephemeris.epoch", &self.epoch, cure)
        })?;
        let (direction_in_icrf, distance_km) = Unit::try_new_and_get(state.radius_km, 1.0).ok_or_else(|| {
            let cure = "the body stands at the Sun's place: name another body";
            SceneError::out_of_range("ephemeris.observer_id", self.observer_id, cure)
        })?;
        Ok(SunInIcrf { direction_in_icrf, distance_au: 1e3 * distance_km / ASTRONOMICAL_UNIT_M })
    }

    fn parsed_epoch(&self) -> Result<Epoch, OutOfRange> {
        Epoch::from_str(&self.epoch).map_err(|problem| {
            let cure = format!("write it as 2031-05-14T23:18:00 UTC or as ... TDB ({problem})");
            OutOfRange::new("ephemeris.epoch", &self.epoch, cure)
        })
    }

    /// Checks what can be checked without reading the kernels.
    ///
    /// # Errors
    /// Names the first key at fault.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        if self.kernels.is_empty() {
            return Err(OutOfRange::new("ephemeris.kernels", "empty", "name at least one SPK file"));
        }
        self.parsed_epoch().map(|_| ())
    }
}

fn load(almanac: Almanac, path: &Path) -> Result<Almanac, SceneError> {
    let io = |source| SceneError::Io { action: "read the kernel", path: path.into(), source };
    std::fs::File::open(path).map_err(io)?;
    let unusable = |problem: String| SceneError::Unusable { path: path.into(), problem };
    let text = path.to_str().ok_or_else(|| unusable("the path is no valid Unicode: rename the file".into()))?;
    almanac.load(text).map_err(|e| unusable(format!("it is no SPICE kernel that can be read ({e})")))
}
