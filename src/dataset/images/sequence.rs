//! Image sequences: our data sets, EuRoC folders, and plain folders of images.

use super::frame::Frame;
use super::frame_list::{FrameList, FrameTimes};
use super::grey_levels::{IntensityScale, NumberSample};
use super::image_file::{Header, Numbers, read_header, read_numbers};
use super::sensor::{CameraSensor, read_camera_sensor};
use crate::dataset::error::DatasetError;
use crate::geometry::Camera;
use image::GrayImage;
use nalgebra::Isometry3;
use std::path::{Path, PathBuf};

/// Where the camera's parameters come from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CameraSource {
    /// `sensor.yaml` beside the images.
    #[default]
    Folder,
    /// A camera file.
    File(PathBuf),
    /// A centred pinhole camera of this horizontal field of view in radians.
    HorizontalFov(f64),
}

/// A sequence of images of one camera.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageSequence {
    /// The folder that holds `cam0/`, `imu0/` and the rest; the folder of images itself where there is no layout.
    pub root: PathBuf,
    /// The camera.
    pub sensor: CameraSensor,
    /// The images, times strictly increasing.
    pub frames: Vec<Frame>,
    /// How their numbers become 8-bit grey.
    pub levels: IntensityScale,
    /// What had to be assumed, in words for the user.
    pub notes: Vec<String>,
}

/// Images that are looked at beforehand, for their size and their numbers.
const SAMPLES: usize = 16;

impl ImageSequence {
    /// Opens a data set (`cam0/`), a EuRoC folder (`mav0/cam0/`) or a plain folder of images.
    ///
    /// # Errors
    /// No folder, no images, no camera file and no field of view, or a malformed list of frames.
    pub fn open(folder: &Path, source: &CameraSource) -> Result<Self, DatasetError> {
        Self::open_timed(folder, source, &FrameTimes::Folder)
    }

    /// As [`ImageSequence::open`], with time stamps from elsewhere.
    ///
    /// # Errors
    /// As [`ImageSequence::open`], or a rate that is not a positive number.
    pub fn open_timed(folder: &Path, source: &CameraSource, times: &FrameTimes) -> Result<Self, DatasetError> {
        if !folder.is_dir() {
            let cure = "give the path of a data set or of a folder of pictures".into();
            return Err(DatasetError::Missing { path: folder.into(), cure });
        }
        let layout_root = [folder.join("mav0"), folder.into()].into_iter().find(|root| root.join("cam0").is_dir());
        let root = layout_root.clone().unwrap_or_else(|| folder.into());
        let images = if layout_root.is_some() { root.join("cam0") } else { root.clone() };
        let list = FrameList::read(&images, times)?;
        let sensor = match source {
            CameraSource::Folder => read_camera_sensor(&images.join("sensor.yaml"))?,
            CameraSource::File(path) => read_camera_sensor(path)?,
            CameraSource::HorizontalFov(fov_rad) => sensor_from_fov(list.paths(), *fov_rad)?,
        };
        let mut notes = Vec::new();
        let rate_hz = rate_hz(folder, times, (&list, &sensor), &mut notes)?;
        let levels = levels(list.paths(), &sensor, &mut notes);
        Ok(ImageSequence { root, sensor, frames: list.into_frames(rate_hz), levels, notes })
    }

    /// Loads an image as 8-bit grey, see [`IntensityScale`], and checks its size against the camera's.
    ///
    /// # Errors
    /// Names an image that cannot be read, is of the wrong size, or has more than 2^26 pixels.
    pub fn load(&self, frame: &Frame) -> Result<GrayImage, DatasetError> {
        let header = read_header(&frame.path)?;
        let expected_px = self.sensor.camera.size_px();
        if header.size_px != expected_px {
            let path = frame.path.clone();
            let ((found_width_px, found_height_px), (width_px, height_px)) = (header.size_px, expected_px);
            return Err(DatasetError::WrongSize { path, found_width_px, found_height_px, width_px, height_px });
        }
        Ok(self.levels.to_eight_bits(read_numbers(&frame.path, &header)?))
    }
}

/// Some of the images, spread over all, the first and the last among them.
fn sample(paths: &[PathBuf]) -> impl Iterator<Item = &PathBuf> {
    let count = SAMPLES.min(paths.len());
    (0..count).map(move |k| &paths[k * (paths.len() - 1) / (count - 1).max(1)])
}

/// A pinhole camera for the size that most of the sampled images have.
fn sensor_from_fov(paths: &[PathBuf], fov_rad: f64) -> Result<CameraSensor, DatasetError> {
    if !(fov_rad > 0.0 && fov_rad < std::f64::consts::PI) {
        let problem = format!("a field of view of {} degrees is not between 0 and 180", fov_rad.to_degrees());
        return Err(DatasetError::Unusable { path: paths[0].clone(), problem });
    }
    let sizes: Vec<(u32, u32)> = sample(paths).filter_map(|path| read_header(path).ok()).map(|h| h.size_px).collect();
    let votes = |size: &(u32, u32)| sizes.iter().filter(|other| *other == size).count();
    // Of several with most votes, the first.
    let most = sizes.iter().rev().max_by_key(|size| votes(size)).copied();
    let (width_px, height_px) = match most {
        Some(size) => size,
        None => first_readable(paths)?.size_px,
    };
    let camera = Camera::from_fov(width_px, height_px, fov_rad);
    Ok(CameraSensor { camera, spacecraft_from_camera: Isometry3::identity(), rate_hz: None, bits: None })
}

/// The first header that can be read; the first image's problem if none can.
fn first_readable(paths: &[PathBuf]) -> Result<Header, DatasetError> {
    let first = read_header(&paths[0]);
    if first.is_ok() { first } else { paths.iter().find_map(|path| read_header(path).ok()).map_or(first, Ok) }
}

/// Images a second where nothing else tells their times.
fn rate_hz(
    folder: &Path,
    times: &FrameTimes,
    (list, sensor): (&FrameList, &CameraSensor),
    notes: &mut Vec<String>,
) -> Result<f64, DatasetError> {
    if let FrameTimes::RateHz(rate_hz) = times {
        let problem = format!("a rate of {rate_hz} pictures a second is not a positive number");
        let unusable = || DatasetError::Unusable { path: folder.into(), problem };
        return Some(*rate_hz).filter(|r| *r > 1e-9 && r.is_finite()).ok_or_else(unusable);
    }
    if list.is_timed() {
        return Ok(1.0);
    }
    notes.push(match sensor.rate_hz {
        Some(rate_hz) => format!("no time stamps found: {rate_hz} pictures a second, as the camera file says"),
        None => "no time stamps found: pictures are taken as 1 s apart; --rate-hz or --times states them".into(),
    });
    Ok(sensor.rate_hz.unwrap_or(1.0))
}

/// Grey levels from a sample of the images, where those have more than 8 bits.
fn levels(paths: &[PathBuf], sensor: &CameraSensor, notes: &mut Vec<String>) -> IntensityScale {
    let deep = |path: &PathBuf| {
        let needed = |h: &Header| match h.numbers {
            Numbers::Shallow => false,
            Numbers::Deep => sensor.bits.is_none(),
            Numbers::Real => true,
        };
        let header = read_header(path).ok().filter(|h| needed(h) && h.size_px == sensor.camera.size_px())?;
        read_numbers(path, &header).ok()
    };
    let mut numbers = NumberSample::default();
    sample(paths).filter_map(deep).for_each(|image| numbers.add(&image));
    IntensityScale::new(sensor.bits, numbers, notes)
}
