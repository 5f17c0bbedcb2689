//! Reading a model.

use super::HALF_PIXEL_PX;
use super::model::{ColmapImage, ColmapModel, ColmapPoint};
use crate::dataset::error::DatasetError;
use crate::dataset::storage::{parse_finite, read_text};
use crate::geometry::{Camera, Distortion};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector2, Vector3};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Reads the three files of a folder.
///
/// # Errors
/// Names the file and line of what is not as COLMAP writes it, such as a lens model other than `PINHOLE`, `OPENCV` and
/// `OPENCV_FISHEYE`.
pub fn read_colmap(folder: &Path) -> Result<ColmapModel, DatasetError> {
    let mut places = BTreeMap::new();
    let mut model = ColmapModel::default();
    for line in lines(&folder.join("cameras.txt"))?.iter().filter(|line| !line.text.is_empty()) {
        places.insert(line.field(0)?.to_string(), model.cameras.len());
        model.cameras.push(camera(line)?);
    }
    let images = lines(&folder.join("images.txt"))?;
    for pair in images.chunks(2) {
        model.images.push(image(&pair[0], pair.get(1), &places)?);
    }
    for line in lines(&folder.join("points3D.txt"))?.iter().filter(|line| !line.text.is_empty()) {
        model.points.push(ColmapPoint { id: line.whole(0)?, position_m: Vector3::from(line.numbers::<3>(1)?) });
    }
    Ok(model)
}

/// A line that is no comment.
struct Line {
    path: PathBuf,
    number: u64,
    text: String,
}

fn lines(path: &Path) -> Result<Vec<Line>, DatasetError> {
    let text = read_text(path)?;
    let line = |(number, text): (u64, &str)| Line { path: path.into(), number, text: text.trim().into() };
    Ok((1..).zip(text.lines()).filter(|(_, text)| !text.starts_with('#')).map(line).collect())
}

impl Line {
    fn fault(&self, problem: String) -> DatasetError {
        DatasetError::Malformed { path: self.path.clone(), line: self.number, problem }
    }

    fn field(&self, index: usize) -> Result<&str, DatasetError> {
        let found = self.text.split_whitespace().nth(index);
        found.ok_or_else(|| self.fault(format!("it has no field {}", index + 1)))
    }

    fn whole<T: std::str::FromStr>(&self, index: usize) -> Result<T, DatasetError> {
        let field = self.field(index)?;
        field.parse().map_err(|_| self.fault(format!("'{field}' is not a whole number")))
    }

    fn numbers<const N: usize>(&self, first: usize) -> Result<[f64; N], DatasetError> {
        let mut values = [0.0; N];
        for (index, value) in (first..).zip(&mut values) {
            *value = parse_finite(self.field(index)?).map_err(|problem| self.fault(problem))?;
        }
        Ok(values)
    }
}

fn camera(line: &Line) -> Result<Camera, DatasetError> {
    let [fu, fv, cu, cv] = line.numbers(4)?;
    let distortion = match line.field(1)? {
        "PINHOLE" => Distortion::None,
        "OPENCV" => Distortion::RadialTangential(line.numbers(8)?),
        "OPENCV_FISHEYE" => Distortion::Equidistant(line.numbers(8)?),
        other => return Err(line.fault(format!("the lens model '{other}' is not PINHOLE, OPENCV or OPENCV_FISHEYE"))),
    };
    Ok(Camera {
        width_px: line.whole(2)?,
        height_px: line.whole(3)?,
        focal_px: Vector2::new(fu, fv),
        center_px: Vector2::new(cu - HALF_PIXEL_PX, cv - HALF_PIXEL_PX),
        distortion,
    })
}

fn image(head: &Line, points: Option<&Line>, cameras: &BTreeMap<String, usize>) -> Result<ColmapImage, DatasetError> {
    let [qw, qx, qy, qz, tx, ty, tz] = head.numbers(1)?;
    let q = Quaternion::new(qw, qx, qy, qz);
    if (q.norm() - 1.0).abs() > 1e-2 {
        return Err(head.fault(format!("the quaternion's length is {}, 1 expected", q.norm())));
    }
    let rotation = UnitQuaternion::from_quaternion(q);
    let camera_from_reference = Isometry3::from_parts(Translation3::new(tx, ty, tz), rotation);
    let id = head.field(8)?;
    let unknown = || head.fault(format!("camera {id} is not in cameras.txt"));
    let mut observations = Vec::new();
    if let Some(points) = points {
        for first in (0..points.text.split_whitespace().count()).step_by(3) {
            let [x, y] = points.numbers(first)?;
            // -1 stands for no point.
            let point: i64 = points.whole(first + 2)?;
            let pixel_px = Vector2::new(x - HALF_PIXEL_PX, y - HALF_PIXEL_PX);
            observations.extend(u64::try_from(point).ok().map(|point| (pixel_px, point)));
        }
    }
    Ok(ColmapImage {
        camera: *cameras.get(id).ok_or_else(unknown)?,
        name: head.field(9)?.to_string(),
        reference_from_camera: camera_from_reference.inverse(),
        observations,
    })
}
