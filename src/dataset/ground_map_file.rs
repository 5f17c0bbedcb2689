//! The folder of a map: `map.toml` and the rasters that it names.
//!
//! ```toml
//! format = 1
//! [[levels]]                        # from fine to coarse
//! image = "ortho_0.png"           # grey, 8 or 16 bits, one linear scale for all levels
//! heights = "heights_0.tiff"        # float32, m in the site frame, NaN where nothing is known; as large as the image
//! metres_per_px = 0.5
//! first_x_m = -500.0                # site frame: centre of the pixel (0, 0); columns run along +x, rows along -y
//! first_y_m = 500.0
//! sigma_horizontal_m = 0.02         # 1σ of the map's own errors, an axis
//! sigma_vertical_m = 0.03
//! ```

use super::error::DatasetError;
use super::ground_map::{GroundMap, MapLevel};
use super::images::{RawImage, encode_grey_png, encode_scalar_tiff, read_depth_tiff, read_header, read_numbers};
use super::storage::write_atomically;
use image::{DynamicImage, ImageBuffer};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The only format so far.
const FORMAT: u32 = 1;
const FILE: &str = "map.toml";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct MapFile {
    format: u32,
    levels: Vec<LevelEntry>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LevelEntry {
    picture: PathBuf,
    heights: PathBuf,
    metres_per_px: f64,
    first_x_m: f64,
    first_y_m: f64,
    sigma_horizontal_m: f64,
    sigma_vertical_m: f64,
}

/// Reads the map in a folder.
///
/// # Errors
/// Names the file, and the line or key at fault: a missing file, an unknown key, a value out of range, levels that do not go
/// from fine to coarse, rasters of different sizes, a level without any height.
pub fn read_ground_map(folder: &Path) -> Result<GroundMap, DatasetError> {
    let path = folder.join(FILE);
    if !path.is_file() {
        let cure = "name the folder of a map, as `opnav map` makes it".into();
        return Err(DatasetError::Missing { path, cure });
    }
    let text = super::storage::read_text(&path)?;
    let file: MapFile = toml::from_str(&text).map_err(|e| malformed(&path, &text, &e))?;
    file.check().map_err(|problem| DatasetError::Unusable { path, problem })?;
    let levels = file.levels.iter().map(|entry| entry.read(folder)).collect::<Result<_, _>>()?;
    Ok(GroundMap { levels })
}

/// Writes a map into a folder: the rasters, then `map.toml`, each file whole or not at all.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_ground_map(folder: &Path, map: &GroundMap) -> Result<(), DatasetError> {
    let mut file = MapFile { format: FORMAT, levels: Vec::new() };
    for (index, level) in map.levels.iter().enumerate() {
        let entry = LevelEntry {
            picture: format!("ortho_{index}.png").into(),
            heights: format!("heights_{index}.tiff").into(),
            metres_per_px: level.metres_per_px,
            first_x_m: level.first_in_site_m.x,
            first_y_m: level.first_in_site_m.y,
            sigma_horizontal_m: level.sigma_horizontal_m,
            sigma_vertical_m: level.sigma_vertical_m,
        };
        let [picture, heights] = [&entry.picture, &entry.heights].map(|name| folder.join(name));
        let bytes = encode_grey_png(&picture, &DynamicImage::ImageLuma16(level.image.clone()))?;
        write_atomically(&picture, |w| w.write_all(&bytes))?;
        let bytes = encode_scalar_tiff(&heights, level.size_px(), &level.heights_m)?;
        write_atomically(&heights, |w| w.write_all(&bytes))?;
        file.levels.push(entry);
    }
    let text = toml::to_string(&file).expect("a map file is plain data");
    super::storage::write_text(&folder.join(FILE), &text)
}

fn malformed(path: &Path, text: &str, error: &toml::de::Error) -> DatasetError {
    let start = error.span().map_or(0, |span| span.start.min(text.len()));
    let line = text.as_bytes()[..start].iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
    DatasetError::Malformed { path: path.into(), line, problem: error.message().replace('\n', " ") }
}

impl MapFile {
    fn check(&self) -> Result<(), String> {
        if self.format != FORMAT {
            return Err(format!("format is {}, and this version reads {FORMAT}: make the map anew", self.format));
        }
        if self.levels.is_empty() {
            return Err("levels is empty: a map needs at least one table [[levels]]".into());
        }
        for (index, level) in self.levels.iter().enumerate() {
            level.check().map_err(|problem| format!("levels[{index}].{problem}"))?;
        }
        match self.levels.windows(2).position(|pair| pair[1].metres_per_px <= pair[0].metres_per_px) {
            Some(k) => Err(format!(
                "levels[{}].metres_per_px is not above that of the level before: go from fine to coarse",
                k + 1
            )),
            None => Ok(()),
        }
    }
}

impl LevelEntry {
    fn check(&self) -> Result<(), String> {
        let checks = [
            ("metres_per_px", self.metres_per_px, self.metres_per_px > 0.0, "it must be a positive number"),
            ("first_x_m", self.first_x_m, true, "it must be a finite number"),
            ("first_y_m", self.first_y_m, true, "it must be a finite number"),
            ("sigma_horizontal_m", self.sigma_horizontal_m, self.sigma_horizontal_m >= 0.0, "it must be 0 or more"),
            ("sigma_vertical_m", self.sigma_vertical_m, self.sigma_vertical_m >= 0.0, "it must be 0 or more"),
        ];
        match checks.iter().find(|(_, value, holds, _)| !holds || !value.is_finite()) {
            Some((key, value, _, cure)) => Err(format!("{key} is {value}: {cure}")),
            None => Ok(()),
        }
    }

    fn read(&self, folder: &Path) -> Result<MapLevel, DatasetError> {
        let [image_path, heights_path] = [&self.picture, &self.heights].map(|name| folder.join(name));
        let unusable = |path: &Path, problem: String| DatasetError::Unusable { path: path.into(), problem };
        for path in [&image_path, &heights_path] {
            if !path.is_file() {
                let cure = format!("{FILE} names it: put it there, or take its table [[levels]] out");
                return Err(DatasetError::Missing { path: path.clone(), cure });
            }
        }
        let header = read_header(&image_path)?;
        let (width, height) = header.size_px;
        if width < 2 || height < 2 {
            return Err(unusable(&image_path, format!("it is {width}x{height} px: a map needs 2x2")));
        }
        let picture = match read_numbers(&image_path, &header)? {
            RawImage::Deep(deep) => deep,
            RawImage::Shallow(shallow) => {
                let numbers = shallow.iter().map(|byte| 257 * u16::from(*byte)).collect();
                ImageBuffer::from_raw(width, height, numbers).expect("one number a pixel")
            }
            RawImage::Real(_) => {
                return Err(unusable(&image_path, "it holds floating-point numbers: save it with 8 or 16 bits".into()));
            }
        };
        let heights = read_depth_tiff(&heights_path)?;
        if heights.dimensions() != (width, height) {
            let (w, h) = heights.dimensions();
            let problem = format!("it is {w}x{h} px, and its picture {width}x{height} px: both must be of one size");
            return Err(unusable(&heights_path, problem));
        }
        let known = |value: f32| if value.is_finite() { value } else { f32::NAN };
        let heights_m: Vec<f32> = heights.into_raw().into_iter().map(known).collect();
        if heights_m.iter().all(|value| value.is_nan()) {
            return Err(unusable(&heights_path, "not one of its heights is known (all are NaN)".into()));
        }
        Ok(MapLevel {
            metres_per_px: self.metres_per_px,
            first_in_site_m: Vector2::new(self.first_x_m, self.first_y_m),
            image: picture,
            heights_m,
            sigma_horizontal_m: self.sigma_horizontal_m,
            sigma_vertical_m: self.sigma_vertical_m,
        })
    }
}
