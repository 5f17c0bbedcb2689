//! The keys by which a GeoTIFF file names its map.
//!
//! Source: OGC 19-008r4, "GeoTIFF standard 1.1", 2019, annex B.

use super::file_raster::FileGeoreference;

/// The directory of keys.
#[derive(Debug)]
pub(super) struct GeoKeys {
    /// Key, location of its value, count, value or index.
    entries: Vec<[u16; 4]>,
    doubles: Vec<f64>,
}

const MODEL_TYPE: u16 = 1024;
const RASTER_TYPE: u16 = 1025;
const ANGULAR_UNITS: u16 = 2054;
const SEMI_MAJOR_AXIS: u16 = 2057;
const PROJECTION_METHOD: u16 = 3075;
const LINEAR_UNITS: u16 = 3076;
const STANDARD_PARALLEL: u16 = 3078;
const ORIGIN_LONGITUDES: [u16; 2] = [3088, 3080];
const ORIGIN_LATITUDES: [u16; 2] = [3089, 3081];
const FALSE_EASTINGS: [u16; 2] = [3082, 3090];
const FALSE_NORTHINGS: [u16; 2] = [3083, 3091];
const DOUBLES: u16 = 34736;

const PROJECTED: u16 = 1;
const GEOGRAPHIC: u16 = 2;
const PIXEL_IS_POINT: u16 = 2;
const DEGREE: u16 = 9102;
const METRE: u16 = 9001;
const USER_DEFINED: u16 = 32767;
const EQUIRECTANGULAR: u16 = 17;

impl GeoKeys {
    pub(super) fn new(directory: &[u16], doubles: Vec<f64>) -> Self {
        let entries = directory.chunks_exact(4).skip(1).map(|e| [e[0], e[1], e[2], e[3]]).collect();
        GeoKeys { entries, doubles }
    }

    fn short(&self, key: u16) -> Option<u16> {
        self.entries.iter().find(|e| e[0] == key && e[1] == 0).map(|e| e[3])
    }

    fn double(&self, key: u16) -> Option<f64> {
        let entry = self.entries.iter().find(|e| e[0] == key && e[1] == DOUBLES)?;
        self.doubles.get(usize::from(entry[3])).copied()
    }

    fn first_double(&self, keys: [u16; 2]) -> f64 {
        keys.into_iter().find_map(|key| self.double(key)).unwrap_or(0.0)
    }

    pub(super) fn is_pixel_a_point(&self) -> bool {
        self.short(RASTER_TYPE) == Some(PIXEL_IS_POINT)
    }

    /// The map of a raster whose first post lies at `first`; steps eastward per column and southward per row.
    pub(super) fn georeference(&self, first: [f64; 2], step: [f64; 2]) -> Result<FileGeoreference, String> {
        match self.short(MODEL_TYPE) {
            Some(PROJECTED) => {
                let units = self.short(LINEAR_UNITS).unwrap_or(METRE);
                if units != METRE && units != USER_DEFINED {
                    return Err(format!("its map is in the unit {units} (key 3076), not in metres: convert it"));
                }
                match self.short(PROJECTION_METHOD) {
                    Some(EQUIRECTANGULAR) => self.equirectangular(first, step),
                    _ => Ok(FileGeoreference::Metres { first_m: first, step_m: step }),
                }
            }
            Some(GEOGRAPHIC) => {
                let units = self.short(ANGULAR_UNITS).unwrap_or(DEGREE);
                if units != DEGREE && units != USER_DEFINED {
                    return Err(format!("its angles are in the unit {units} (key 2054), not in degrees: convert it"));
                }
                let radius_m = self.double(SEMI_MAJOR_AXIS);
                Ok(FileGeoreference::Degrees { first_deg: first, step_deg: step, radius_m })
            }
            model => Err(format!(
                "its reference system is unknown (model type {}): project it to metres or to degrees, or state \
                 file.geometry in the scenario",
                model.map_or("missing".into(), |m| m.to_string())
            )),
        }
    }

    /// Metres that are degrees: x = R (lon - lon₀) cos(lat₁), y = R (lat - lat₀).
    fn equirectangular(&self, first: [f64; 2], step: [f64; 2]) -> Result<FileGeoreference, String> {
        let Some(radius_m) = self.double(SEMI_MAJOR_AXIS).filter(|r| *r > 0.0) else {
            return Err("its equirectangular map lacks the planet's radius (key 2057): state file.geometry".into());
        };
        let parallel = self.double(STANDARD_PARALLEL).unwrap_or(0.0).to_radians().cos();
        let deg_per_m = [1.0 / (radius_m * parallel), 1.0 / radius_m].map(f64::to_degrees);
        let east_m = first[0] - self.first_double(FALSE_EASTINGS);
        let north_m = first[1] - self.first_double(FALSE_NORTHINGS);
        Ok(FileGeoreference::Degrees {
            first_deg: [
                self.first_double(ORIGIN_LONGITUDES) + east_m * deg_per_m[0],
                self.first_double(ORIGIN_LATITUDES) + north_m * deg_per_m[1],
            ],
            step_deg: [step[0] * deg_per_m[0], step[1] * deg_per_m[1]],
            radius_m: Some(radius_m),
        })
    }
}
