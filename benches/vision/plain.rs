//! A plain OpenCV chain beside ours on the same two pictures of a body: cost and error of the rotation.

use criterion::Criterion;
use image::GrayImage;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector2, Vector3};
use opencv::calib3d::{RANSAC, find_essential_mat, recover_pose_estimated};
use opencv::core::{DMatch, KeyPoint, Mat, NORM_HAMMING, Point2d, Point2f, Vector, no_array};
use opencv::features2d::{BFMatcher, ORB};
use opencv::imgproc::good_features_to_track;
use opencv::prelude::*;
use opnav::geometry::{Camera, so3};
use opnav::observations::*;
use opnav::vision::*;
use std::hint::black_box;

/// Two pictures of a textured sphere, and the turn between them.
pub struct TwoViews {
    camera: Camera,
    pictures: [GrayImage; 2],
    turn: UnitQuaternion<f64>,
}

impl TwoViews {
    /// A sphere that fills most of the picture, textured by `grey` of a place on it, turned by 4°.
    pub fn new(grey: impl Fn(f64, f64) -> f64) -> Self {
        let camera = Camera::from_fov(1024, 1024, 0.7);
        let center = Vector3::new(0.0, 0.0, 3.2);
        let turn = so3::exp(&(Vector3::new(0.4, 0.8, 0.3).normalize() * 4f64.to_radians()));
        let picture = |turned: UnitQuaternion<f64>| {
            GrayImage::from_fn(1024, 1024, |u, v| {
                let ray = camera.normalize(&Vector2::new(f64::from(u), f64::from(v))).expect("a pinhole").push(1.0);
                let ray = ray.normalize();
                let along = ray.dot(&center);
                let inside = along * along - center.norm_squared() + 1.0;
                if inside < 0.0 {
                    return image::Luma([0]);
                }
                let p = turned.inverse() * (ray * (along - inside.sqrt()) - center);
                image::Luma([grey(600.0 * (p.x + 0.3 * p.z), 600.0 * (p.y - 0.4 * p.z)).clamp(0.0, 255.0) as u8])
            })
        };
        TwoViews { pictures: [picture(UnitQuaternion::identity()), picture(turn)], camera, turn }
    }

    fn error_deg(&self, found: Option<UnitQuaternion<f64>>) -> f64 {
        found.map_or(f64::NAN, |q| q.angle_to(&self.turn).to_degrees())
    }

    fn ours(&self, implementation: Implementation) -> Option<UnitQuaternion<f64>> {
        let config = DetectorConfig { max_features: 2000, implementation, ..DetectorConfig::default() };
        let matcher = MatcherConfig { implementation, ..MatcherConfig::default() };
        let features = self.pictures.each_ref().map(|p| detect_features(p, None, &config).expect("features"));
        let describe = |i: usize| {
            describe_features(&self.pictures[i], &features[i], Orientation::Upright, &matcher).expect("bits")
        };
        let bits = [0, 1].map(describe);
        let described = [0, 1].map(|i| Described { features: &features[i], descriptors: &bits[i] });
        let found = match_features(described[0], described[1], &matcher).expect("matches");
        let both = found.iter().map(|m| (&features[0][m.from], &features[1][m.to]));
        let pair = MatchedPair {
            from_px: both.clone().map(|(a, _)| a.pixel_px).collect(),
            to_px: both.clone().map(|(_, b)| b.pixel_px).collect(),
        };
        let sigma_px: Vec<f64> = both.map(|(a, b)| (0.5 * (a.sigma_px.powi(2) + b.sigma_px.powi(2))).sqrt()).collect();
        let matches = PixelMatches { pair: &pair, sigma_px: &sigma_px };
        let solution =
            relative_rotation(matches, &self.camera, &PairHints::default(), &RotationConfig::default()).ok()?;
        (solution.status == PairStatus::Ok).then_some(solution.camera_to_from_camera_from)
    }

    fn plain(&self) -> opencv::Result<UnitQuaternion<f64>> {
        let mut orb = ORB::create_def()?;
        let mut points: [Vector<KeyPoint>; 2] = [Vector::new(), Vector::new()];
        let mut bits = [Mat::default(), Mat::default()];
        for i in 0..2 {
            let picture = Mat::new_rows_cols_with_data(1024, 1024, self.pictures[i].as_raw().as_slice())?;
            let mut corners = Vector::<Point2f>::new();
            good_features_to_track(&picture, &mut corners, 2000, 0.01, 7.0, &no_array(), 3, true, 0.04)?;
            points[i] = corners
                .iter()
                .map(|p| KeyPoint::new_point(p, 31.0, -1.0, 0.0, 0, -1))
                .collect::<opencv::Result<_>>()?;
            orb.compute(&picture, &mut points[i], &mut bits[i])?;
        }
        let mut found = Vector::<DMatch>::new();
        BFMatcher::new(NORM_HAMMING, true)?.train_match(&bits[0], &bits[1], &mut found, &no_array())?;
        let place = |p: Point2f| Point2d::new(f64::from(p.x), f64::from(p.y));
        let (mut from, mut to) = (Vector::<Point2d>::new(), Vector::<Point2d>::new());
        for m in &found {
            from.push(place(points[0].get(m.query_idx as usize)?.pt()));
            to.push(place(points[1].get(m.train_idx as usize)?.pt()));
        }
        let (f, c) = (self.camera.focal_px, self.camera.center_px);
        let lens = Mat::from_slice_2d(&[[f.x, 0.0, c.x], [0.0, f.y, c.y], [0.0, 0.0, 1.0]])?;
        let mut mask = Mat::default();
        let essential = find_essential_mat(&from, &to, &lens, RANSAC, 0.999, 1.0, 1000, &mut mask)?;
        let (mut turn, mut translation) = (Mat::default(), Mat::default());
        recover_pose_estimated(&essential, &from, &to, &lens, &mut turn, &mut translation, &mut mask)?;
        let turn = Matrix3::from_row_slice(turn.data_typed::<f64>()?);
        Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn)))
    }
}

/// Both chains, one thread.
pub fn chains(criterion: &mut Criterion, views: &TwoViews) {
    opencv::core::set_num_threads(1).expect("OpenCV takes a number of threads");
    println!(
        "error of the rotation: ours {:.4} deg, plain OpenCV {:.4} deg",
        views.error_deg(views.ours(Implementation::Opencv)),
        views.error_deg(views.plain().ok())
    );
    for implementation in [Implementation::Opencv, Implementation::Fused] {
        criterion.bench_function(&format!("pictures to rotation, {implementation:?}"), |bench| {
            bench.iter(|| black_box(views).ours(implementation));
        });
    }
    criterion.bench_function("pictures to rotation, plain OpenCV", |bench| bench.iter(|| black_box(views).plain()));
}
