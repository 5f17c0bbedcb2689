//! Rendered pictures with their true poses and depths.

use image::{GrayImage, ImageBuffer, Luma};
use nalgebra::{Isometry3, Matrix2, Point3, Vector2};
use opnav::dataset::{CameraSource, ImageSequence, read_depth_tiff, read_tum};
use opnav::geometry::Camera;
use std::path::Path;

/// Depths about a pixel that differ by more of themselves are those of an edge.
const SMOOTH_DEPTH: f64 = 0.01;

pub struct PageImage {
    pub t_ns: i64,
    pub image: GrayImage,
    pub reference_from_camera: Isometry3<f64>,
    depth_m: ImageBuffer<Luma<f32>, Vec<f32>>,
}

pub struct Sequence {
    pub camera: Camera,
    pub images: ImageSequence,
    pub pictures: Vec<PageImage>,
}

impl Sequence {
    pub fn read(folder: &Path) -> Sequence {
        let images = ImageSequence::open(folder, &CameraSource::Folder).expect("pictures");
        let poses = read_tum(&folder.join("truth/cam0.tum")).expect("true poses");
        let picture = |frame: &opnav::dataset::Frame| {
            let pose = poses.iter().find(|p| p.t_ns == frame.t_ns).expect("the picture's pose");
            PageImage {
                t_ns: frame.t_ns,
                image: images.load(frame).expect("a picture"),
                reference_from_camera: pose.reference_from_moving,
                depth_m: read_depth_tiff(&folder.join(format!("truth/depth/cam0/{}.tiff", frame.t_ns)))
                    .expect("depths"),
            }
        };
        let pictures = images.frames.iter().map(picture).collect();
        Sequence { camera: images.sensor.camera, images, pictures }
    }

    pub fn at(&self, t_ns: i64) -> Option<&PageImage> {
        self.pictures.iter().find(|p| p.t_ns == t_ns)
    }
}

impl PageImage {
    /// True z-depth at a pixel, m; `None` where no surface is, or at an edge.
    fn depth_m(&self, pixel_px: &Vector2<f64>) -> Option<f64> {
        if !(pixel_px.x >= 0.0 && pixel_px.y >= 0.0) {
            return None;
        }
        let (u, v) = (pixel_px.x as u32, pixel_px.y as u32);
        let depth = |i, j| self.depth_m.get_pixel_checked(u + i, v + j).map(|d| f64::from(d.0[0]));
        let [a, b, c, d] = [depth(0, 0)?, depth(1, 0)?, depth(0, 1)?, depth(1, 1)?];
        let (s, t) = (pixel_px.x.fract(), pixel_px.y.fract());
        let mixed = (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t;
        let spread = [a, b, c, d].iter().map(|x| (x - mixed).abs()).fold(0.0, f64::max);
        (spread < SMOOTH_DEPTH * mixed).then_some(mixed)
    }

    /// The surface point at a pixel in the reference frame, m.
    pub fn point(&self, pixel_px: &Vector2<f64>, camera: &Camera) -> Option<Point3<f64>> {
        let in_camera = Point3::from(camera.normalize(pixel_px)?.push(1.0) * self.depth_m(pixel_px)?);
        Some(self.reference_from_camera * in_camera)
    }

    /// Where the surface point at a pixel is in another picture; `None` where it is hidden or outside.
    pub fn true_pixel(&self, pixel_px: &Vector2<f64>, other: &PageImage, camera: &Camera) -> Option<Vector2<f64>> {
        let point = self.point(pixel_px, camera)?;
        let in_other = other.reference_from_camera.inverse_transform_point(&point).coords;
        let pixel_px = camera.project(&in_other).filter(|p| camera.contains(p, 2.0))?;
        let seen_m = other.depth_m(&pixel_px)?;
        ((seen_m / in_other.z - 1.0).abs() < SMOOTH_DEPTH).then_some(pixel_px)
    }

    /// Derivative of [`PageImage::true_pixel`] by the pixel, by differences over a few px.
    pub fn warp(&self, pixel_px: &Vector2<f64>, other: &PageImage, camera: &Camera) -> Option<Matrix2<f64>> {
        const STEP_PX: f64 = 4.0;
        let slope = |step: Vector2<f64>| {
            let [ahead, behind] = [step, -step].map(|s| self.true_pixel(&(pixel_px + s), other, camera));
            Some((ahead? - behind?) / (2.0 * STEP_PX))
        };
        Some(Matrix2::from_columns(&[slope(Vector2::x() * STEP_PX)?, slope(Vector2::y() * STEP_PX)?]))
    }
}
