//! Image sequences: our data sets, EuRoC folders, and plain folders of pictures.

use super::picture::to_eight_bits;
use super::{CameraSensor, DatasetError, read_camera_sensor};
use crate::geometry::Camera;
use image::GrayImage;
use nalgebra::Isometry3;
use std::path::{Path, PathBuf};

/// Where the camera's parameters come from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CameraSource {
    /// `sensor.yaml` beside the pictures.
    #[default]
    Folder,
    /// A camera file.
    File(PathBuf),
    /// A centred pinhole camera of this horizontal field of view in radians.
    HorizontalFov(f64),
}

/// One picture of a sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Position in the sequence, from 0.
    pub index: usize,
    /// Time in ns.
    pub t_ns: i64,
    /// The picture's file.
    pub path: PathBuf,
}

/// A sequence of pictures of one camera.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageSequence {
    /// The folder that holds `cam0/`, `imu0/` and the rest; the folder of pictures itself where there is no layout.
    pub root: PathBuf,
    /// The camera.
    pub sensor: CameraSensor,
    /// The pictures, times strictly increasing.
    pub frames: Vec<Frame>,
}

const EXTENSIONS: [&str; 8] = ["png", "jpg", "jpeg", "tif", "tiff", "bmp", "pgm", "pnm"];

impl ImageSequence {
    /// Opens a data set (`cam0/`), a EuRoC folder (`mav0/cam0/`) or a plain folder of pictures.
    ///
    /// # Errors
    /// No folder, no pictures, no camera file and no field of view, or a malformed list of frames.
    pub fn open(folder: &Path, source: &CameraSource) -> Result<Self, DatasetError> {
        if !folder.is_dir() {
            let cure = "give the path of a data set or of a folder of pictures".into();
            return Err(DatasetError::Missing { path: folder.into(), cure });
        }
        let layout_root = [folder.join("mav0"), folder.into()].into_iter().find(|root| root.join("cam0").is_dir());
        let root = layout_root.clone().unwrap_or_else(|| folder.into());
        let pictures = if layout_root.is_some() { root.join("cam0") } else { root.clone() };
        let frames = list_frames(&pictures)?;
        let sensor = match source {
            CameraSource::Folder => read_camera_sensor(&pictures.join("sensor.yaml"))?,
            CameraSource::File(path) => read_camera_sensor(path)?,
            CameraSource::HorizontalFov(fov_rad) => sensor_from_fov(&frames[0], *fov_rad)?,
        };
        Ok(ImageSequence { root, sensor, frames })
    }

    /// Loads a picture as 8-bit grey, scaled by the camera's bits a pixel, and checks its size against the camera's.
    ///
    /// # Errors
    /// Names a picture that cannot be read or is of the wrong size.
    pub fn load(&self, frame: &Frame) -> Result<GrayImage, DatasetError> {
        let picture = to_eight_bits(open_picture(&frame.path)?, self.sensor.bits);
        let camera = &self.sensor.camera;
        if picture.dimensions() != (camera.width_px, camera.height_px) {
            return Err(DatasetError::WrongSize {
                path: frame.path.clone(),
                found_width_px: picture.width(),
                found_height_px: picture.height(),
                width_px: camera.width_px,
                height_px: camera.height_px,
            });
        }
        Ok(picture)
    }
}

fn open_picture(path: &Path) -> Result<image::DynamicImage, DatasetError> {
    let unusable = |e: String| DatasetError::Unusable {
        path: path.into(),
        problem: format!("the picture cannot be read ({e}): remove it or put a whole one in its place"),
    };
    image::ImageReader::open(path)
        .and_then(|reader| reader.with_guessed_format())
        .map_err(DatasetError::io("read", path))?
        .decode()
        .map_err(|e| unusable(e.to_string()))
}

fn sensor_from_fov(frame: &Frame, fov_rad: f64) -> Result<CameraSensor, DatasetError> {
    if !(fov_rad > 0.0 && fov_rad < std::f64::consts::PI) {
        let problem = format!("a field of view of {} degrees is not between 0 and 180", fov_rad.to_degrees());
        return Err(DatasetError::Unusable { path: frame.path.clone(), problem });
    }
    let picture = open_picture(&frame.path)?;
    let camera = Camera::from_fov(picture.width(), picture.height(), fov_rad);
    Ok(CameraSensor { camera, spacecraft_from_camera: Isometry3::identity(), rate_hz: None, bits: None })
}

fn list_frames(pictures: &Path) -> Result<Vec<Frame>, DatasetError> {
    let list = pictures.join("data.csv");
    let frames = if list.is_file() { listed_frames(&list)? } else { found_frames(pictures)? };
    if frames.is_empty() {
        let problem = format!("no pictures found ({}): check the folder", EXTENSIONS.join(", "));
        return Err(DatasetError::Unusable { path: pictures.into(), problem });
    }
    Ok(frames)
}

fn listed_frames(list: &Path) -> Result<Vec<Frame>, DatasetError> {
    let text = super::table::read_text(list)?;
    let folder = list.with_file_name("data");
    let mut frames: Vec<Frame> = Vec::new();
    for (number, line) in text.lines().enumerate() {
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let malformed =
            |problem: String| DatasetError::Malformed { path: list.into(), line: number as u64 + 1, problem };
        let (time, name) =
            line.split_once(',').ok_or_else(|| malformed("'timestamp [ns],filename' expected".into()))?;
        let t_ns: i64 =
            time.trim().parse().map_err(|_| malformed(format!("'{time}' is not a time stamp in whole nanoseconds")))?;
        if frames.last().is_some_and(|last| last.t_ns >= t_ns) {
            return Err(malformed(format!("time stamp {t_ns} ns does not come after the one before it")));
        }
        let path = folder.join(name.trim());
        if !path.is_file() {
            return Err(malformed(format!("{} does not exist", path.display())));
        }
        frames.push(Frame { index: frames.len(), t_ns, path });
    }
    Ok(frames)
}

/// Pictures of a folder (or of its `data/`) in natural order, timed by names that are whole nanoseconds, else 1 s apart.
fn found_frames(pictures: &Path) -> Result<Vec<Frame>, DatasetError> {
    let folder = [pictures.join("data"), pictures.into()].into_iter().find(|f| f.is_dir()).expect("the second exists");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(&folder)
        .map_err(DatasetError::io("list", &folder))?
        .filter_map(|entry| entry.ok().map(|e| e.path()))
        .filter(|path| {
            let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
            path.is_file() && EXTENSIONS.contains(&extension.as_str())
        })
        .collect();
    paths.sort_by(|a, b| natord::compare(&a.to_string_lossy(), &b.to_string_lossy()).then_with(|| a.cmp(b)));
    let times: Vec<Option<i64>> =
        paths.iter().map(|p| p.file_stem().and_then(|s| s.to_str()).and_then(|s| s.parse().ok())).collect();
    let timed = times.iter().all(Option::is_some) && times.windows(2).all(|w| w[0] < w[1]);
    let long = times.iter().flatten().any(|t| *t >= 1_000_000);
    let stamp = |index: usize| times[index].filter(|_| timed && long).unwrap_or(index as i64 * 1_000_000_000);
    Ok(paths.into_iter().enumerate().map(|(index, path)| Frame { index, t_ns: stamp(index), path }).collect())
}
