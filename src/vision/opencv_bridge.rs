//! Between our types and OpenCV's.

use image::GrayImage;
use nalgebra::{Matrix3, Vector2, Vector3};
use opencv::boxed_ref::BoxedRef;
use opencv::core::{Mat, Point2d, Vector};
use opencv::prelude::*;

/// The image as OpenCV sees it, without a copy.
pub(super) fn image_mat(image: &GrayImage) -> opencv::Result<BoxedRef<'_, Mat>> {
    Mat::new_rows_cols_with_data(image.height() as i32, image.width() as i32, image.as_raw().as_slice())
}

/// An image from OpenCV's one of 8 bits.
pub(super) fn grey_image(mat: &Mat) -> opencv::Result<GrayImage> {
    let levels = mat.data_bytes()?.to_vec();
    Ok(GrayImage::from_raw(mat.cols() as u32, mat.rows() as u32, levels).expect("a byte a pixel"))
}

/// Version of the OpenCV library in use, such as `4.6.0`.
pub fn opencv_version() -> String {
    opencv::core::get_version_string().unwrap_or_else(|_| "unknown".into())
}

/// Points as OpenCV's vector.
pub(super) fn points(values: impl Iterator<Item = Vector2<f64>>) -> Vector<Point2d> {
    values.map(|v| Point2d::new(v.x, v.y)).collect()
}

/// A 3×3 matrix for OpenCV.
pub(super) fn mat_from(matrix: &Matrix3<f64>) -> opencv::Result<Mat> {
    let m = matrix;
    Mat::from_slice_2d(&[
        [m[(0, 0)], m[(0, 1)], m[(0, 2)]],
        [m[(1, 0)], m[(1, 1)], m[(1, 2)]],
        [m[(2, 0)], m[(2, 1)], m[(2, 2)]],
    ])
}

/// A 3×3 matrix (or the first of a stack) from OpenCV; `None` where it is empty or not finite.
pub(super) fn matrix_from(mat: &Mat) -> Option<Matrix3<f64>> {
    let values = mat.data_typed::<f64>().ok().filter(|v| v.len() >= 9)?;
    let matrix = Matrix3::from_row_slice(&values[..9]);
    matrix.iter().all(|v| v.is_finite()).then_some(matrix)
}

/// A 3-vector from OpenCV.
pub(super) fn vector_from(mat: &Mat) -> Option<Vector3<f64>> {
    let values = mat.data_typed::<f64>().ok().filter(|v| v.len() >= 3)?;
    Some(Vector3::from_column_slice(&values[..3]))
}
