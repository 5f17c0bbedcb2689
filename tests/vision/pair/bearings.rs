//! Synthetic matched pixels with known motion, and the Cramér-Rao bound of their rotation.

use nalgebra::{Matrix2x3, Matrix3, Matrix6, SMatrix, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, Distortion, so3};
use opnav::stats::random_stream;
use opnav::vision::MatchedPair;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

pub fn camera() -> Camera {
    Camera {
        width_px: 1024,
        height_px: 1024,
        focal_px: Vector2::new(1000.0, 1000.0),
        center_px: Vector2::new(511.5, 511.5),
        distortion: Distortion::None,
    }
}

/// Points in the first camera, and how they move into the second: `x_to = rotation x_from + translation`.
#[derive(Clone)]
pub struct Scene {
    pub camera: Camera,
    pub points: Vec<Vector3<f64>>,
    pub rotation: UnitQuaternion<f64>,
    pub translation: Vector3<f64>,
}

/// A descent over ground 1 away with uniform relief of ±`relief`/2, 3 % down and 1.5 % across, with a turn of 2°.
pub fn descent(count: usize, relief: f64, seed: u64) -> Scene {
    descent_by(count, relief, Vector3::new(0.012, 0.009, -0.03), seed)
}

/// A descent by any translation, in units of the height.
pub fn descent_by(count: usize, relief: f64, translation: Vector3<f64>, seed: u64) -> Scene {
    let camera = camera();
    let mut random = random_stream(seed, "descent", 0);
    let rotation = so3::exp(&Vector3::new(0.02, -0.015, 0.025));
    let mut points = Vec::new();
    while points.len() < count {
        let pixel = Vector2::new(random.random_range(0.0..1023.0), random.random_range(0.0..1023.0));
        let depth = 1.0 + relief * (random.random_range(0.0..1.0) - 0.5);
        let ray = camera.normalize(&pixel).unwrap().push(1.0);
        let point = ray * depth;
        if camera.project(&(rotation * point + translation)).is_some_and(|p| camera.contains(&p, 0.0)) {
            points.push(point);
        }
    }
    Scene { camera, points, rotation, translation }
}

/// The near side of an ellipsoid (300, 250, 220 m) that fills 70 % of the picture and turns about its centre.
pub fn ellipsoid(camera: Camera, count: usize, turn_rad: &Vector3<f64>, seed: u64) -> Scene {
    let mut random = random_stream(seed, "ellipsoid", 0);
    let axes = Vector3::new(300.0, 250.0, 220.0);
    let half_angle = (0.35 * f64::from(camera.width_px) / camera.focal_px.x).atan();
    let center = Vector3::new(0.0, 0.0, 300.0 / half_angle.sin());
    let rotation = so3::exp(turn_rad);
    let facing = |p: &Vector3<f64>, n: &Vector3<f64>| -> bool { n.dot(p) < -0.1 * n.norm() * p.norm() };
    let mut points = Vec::new();
    while points.len() < count {
        let d = Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) }).normalize();
        let (from_center, normal) = (d.component_mul(&axes), d.component_div(&axes));
        let (p, q) = (center + from_center, center + rotation * from_center);
        if facing(&p, &normal) && facing(&q, &(rotation * normal)) {
            points.push(p);
        }
    }
    Scene { camera, points, rotation, translation: center - rotation * center }
}

impl Scene {
    pub fn second(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * point + self.translation
    }

    /// Pixels with normal noise; a fraction of the second ones are anywhere in the picture.
    pub fn matches(&self, sigma_px: f64, outliers: f64, seed: u64) -> MatchedPair {
        let mut random = random_stream(seed, "pixels", 0);
        let mut pair = MatchedPair::default();
        for (i, point) in self.points.iter().enumerate() {
            let mut noise = || Vector2::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) }) * sigma_px;
            let (a, b) = (noise(), noise());
            pair.from_px.push(self.camera.project(point).unwrap() + a);
            let wrong = (i as f64) < outliers * self.points.len() as f64;
            let anywhere = Vector2::new(random.random_range(0.0..1023.0), random.random_range(0.0..1023.0));
            pair.to_px.push(if wrong { anywhere } else { self.camera.project(&self.second(point)).unwrap() + b });
        }
        pair
    }

    /// Cramér-Rao bound (rad²) of the rotation from the points after `skip`, structure and direction unknown.
    pub fn bound(&self, sigma_px: f64, skip: usize) -> Matrix3<f64> {
        let mut information = Matrix6::<f64>::zeros();
        for point in &self.points[skip..] {
            let a: Matrix2x3<f64> = self.camera.project_with_jacobian(point).unwrap().1;
            let b: Matrix2x3<f64> = self.camera.project_with_jacobian(&self.second(point)).unwrap().1;
            let r = self.rotation.to_rotation_matrix().into_inner();
            let turned = r * point;
            let mut by_pose = SMatrix::<f64, 2, 6>::zeros();
            by_pose.fixed_columns_mut::<3>(0).copy_from(&(-b * so3::hat(&turned)));
            by_pose.fixed_columns_mut::<3>(3).copy_from(&b);
            let by_point = b * r;
            let points = a.transpose() * a + by_point.transpose() * by_point;
            let cross = by_pose.transpose() * by_point;
            information += by_pose.transpose() * by_pose - cross * points.try_inverse().unwrap() * cross.transpose();
        }
        // The scale is free: hold the length of the translation.
        let along = self.translation.normalize();
        let mut gauge = nalgebra::Vector6::zeros();
        gauge.fixed_rows_mut::<3>(3).copy_from(&along);
        information += gauge * gauge.transpose() * information.trace();
        information.try_inverse().unwrap().fixed_view::<3, 3>(0, 0) * sigma_px.powi(2)
    }
}

/// Cramér-Rao bound (rad²) of the rotation of a body about a known centre, structure unknown.
pub fn bound_about_center(scene: &Scene, center: &Vector3<f64>, sigma_px: f64) -> Matrix3<f64> {
    let r = scene.rotation.to_rotation_matrix().into_inner();
    let mut information = Matrix3::<f64>::zeros();
    for point in &scene.points {
        let a: Matrix2x3<f64> = scene.camera.project_with_jacobian(point).unwrap().1;
        let b: Matrix2x3<f64> = scene.camera.project_with_jacobian(&scene.second(point)).unwrap().1;
        let by_turn = -b * so3::hat(&(r * (point - center)));
        let by_point = b * r;
        let points = a.transpose() * a + by_point.transpose() * by_point;
        let cross = by_turn.transpose() * by_point;
        information += by_turn.transpose() * by_turn - cross * points.try_inverse().unwrap() * cross.transpose();
    }
    information.try_inverse().unwrap() * sigma_px.powi(2)
}

pub fn angle_deg(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    so3::log(&(a * b.inverse())).norm().to_degrees()
}

pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Median length of a normal error of this covariance, degrees.
pub fn median_angle_deg(covariance: &Matrix3<f64>) -> f64 {
    let factor = covariance.cholesky().unwrap().l();
    let mut random = random_stream(1, "median", 0);
    let draw =
        |_| (factor * Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) })).norm().to_degrees();
    median((0..4000).map(draw).collect())
}
