//! Writing a model.

use super::HALF_PIXEL_PX;
use super::model::{ColmapImage, ColmapModel};
use crate::dataset::error::DatasetError;
use crate::dataset::storage::write_atomically;
use crate::geometry::{Camera, Distortion};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// Writes the three files into a folder.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_colmap(folder: &Path, model: &ColmapModel) -> Result<(), DatasetError> {
    let write = |name: &str, text: String| write_atomically(&folder.join(name), |w| w.write_all(text.as_bytes()));
    write("cameras.txt", cameras(model))?;
    write("images.txt", images(model))?;
    write("points3D.txt", points(model))
}

fn cameras(model: &ColmapModel) -> String {
    let mut text = String::from("# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n");
    for (id, camera) in (1..).zip(&model.cameras) {
        let (name, coefficients) = lens(camera);
        let (f, c) = (camera.focal_px, camera.center_px.add_scalar(HALF_PIXEL_PX));
        let _ = write!(text, "{id} {name} {} {}", camera.width_px, camera.height_px);
        let _ = write!(text, " {} {} {} {}", f.x, f.y, c.x, c.y);
        coefficients.iter().for_each(|k| text += &format!(" {k}"));
        text.push('\n');
    }
    text
}

/// COLMAP's name of a lens model, and its coefficients after the intrinsic parameters.
fn lens(camera: &Camera) -> (&'static str, Vec<f64>) {
    match camera.distortion {
        Distortion::None => ("PINHOLE", Vec::new()),
        Distortion::RadialTangential(k) => ("OPENCV", k.to_vec()),
        Distortion::Equidistant(k) => ("OPENCV_FISHEYE", k.to_vec()),
    }
}

fn images(model: &ColmapModel) -> String {
    let mut text =
        String::from("# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n");
    for (id, image) in (1..).zip(&model.images) {
        let camera_from_reference = image.reference_from_camera.inverse();
        let (q, t) = (camera_from_reference.rotation, camera_from_reference.translation);
        let _ = write!(text, "{id} {} {} {} {}", q.w, q.i, q.j, q.k);
        let _ = writeln!(text, " {} {} {} {} {}", t.x, t.y, t.z, image.camera + 1, image.name);
        let _ = writeln!(text, "{}", observations(image));
    }
    text
}

fn observations(image: &ColmapImage) -> String {
    let one = |(pixel, id): &(nalgebra::Vector2<f64>, u64)| {
        format!("{} {} {id}", pixel.x + HALF_PIXEL_PX, pixel.y + HALF_PIXEL_PX)
    };
    image.observations.iter().map(one).collect::<Vec<_>>().join(" ")
}

fn points(model: &ColmapModel) -> String {
    let mut tracks: BTreeMap<u64, String> = BTreeMap::new();
    for (image_id, image) in (1..).zip(&model.images) {
        let _: u64 = image_id;
        for (index, (_, point)) in image.observations.iter().enumerate() {
            *tracks.entry(*point).or_default() += &format!(" {image_id} {index}");
        }
    }
    let mut text = String::from("# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n");
    for point in &model.points {
        let (p, track) = (point.position_m, tracks.get(&point.id).map_or("", String::as_str));
        let _ = writeln!(text, "{} {} {} {} 128 128 128 0{track}", point.id, p.x, p.y, p.z);
    }
    text
}
