//! The pose from which points of the map are seen where they were found.

use crate::geometry::{Camera, so3};
use crate::observations::PredictedCamera;
use crate::stats::{
    LeastSquares, LeastSquaresOptions, NORMAL_MEDIAN_2D, NormalEquations, Steps, Stop, minimize, upper_median,
};
use nalgebra::{Const, Isometry3, Matrix2x6, Matrix3, Matrix6, Vector2, Vector3, Vector6};

/// A point of the map in the site frame (m), and its pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pointing {
    pub(super) point_in_site_m: Vector3<f64>,
    pub(super) pixel_px: Vector2<f64>,
    /// 1σ of each coordinate, px.
    pub(super) sigma_px: f64,
}

/// A pose with each point's residual.
#[derive(Debug, Clone)]
pub(super) struct PoseFit {
    pub(super) camera_from_site: Isometry3<f64>,
    /// Found less predicted, px; infinite where the point lies behind the camera.
    pub(super) residuals_px: Vec<Vector2<f64>>,
    /// Robust 1σ of the residuals, over the points' own.
    pub(super) scale: f64,
}

/// Gauss–Newton steps whose weights follow the residuals, so that no cost can be compared.
const DESCENT: LeastSquaresOptions =
    LeastSquaresOptions { steps: Steps::Full, most_steps: 20, least_step: 1.0, least_drop_share: 0.0, least_drop: 0.0 };
/// Least turn and shift that count as a step.
const LEAST_TURN_RAD: f64 = 1e-9;
const LEAST_SHIFT_M: f64 = 1e-5;
/// Residuals beyond this many robust 1σ count less and less (Geman and McClure's weights).
const SOFT: f64 = 3.0;
/// That robust 1σ is no less than this.
const LEAST_SCALE: f64 = 0.05;

/// Pixel of a point, and its derivative (2×6, px by rad and m) by a small turn of the pose and a small shift in camera axes:
/// `p' = exp(φ) p + τ`. `None` behind the camera.
pub(super) fn pixel_with_jacobian(
    camera: &Camera,
    camera_from_site: &Isometry3<f64>,
    point_in_site_m: &Vector3<f64>,
) -> Option<(Vector2<f64>, Matrix2x6<f64>)> {
    let p = (camera_from_site * nalgebra::Point3::from(*point_in_site_m)).coords;
    let (pixel_px, by_point) = camera.project_with_jacobian(&p)?;
    let mut jacobian = Matrix2x6::zeros();
    jacobian.fixed_view_mut::<2, 3>(0, 0).copy_from(&(by_point * -so3::hat(&p)));
    jacobian.fixed_view_mut::<2, 3>(0, 3).copy_from(&by_point);
    Some((pixel_px, jacobian))
}

/// The pose moved by a small turn and shift in camera axes.
pub(super) fn moved(camera_from_site: &Isometry3<f64>, step: &Vector6<f64>) -> Isometry3<f64> {
    let turn = so3::exp(&step.fixed_rows::<3>(0).into_owned());
    let shift = turn * camera_from_site.translation.vector + step.fixed_rows::<3>(3);
    Isometry3::from_parts(shift.into(), turn * camera_from_site.rotation)
}

/// The pose that fits the points, found by robust Gauss–Newton steps from `start`; the prediction counts with its 1σ.
/// `None` where the points leave it open.
pub(super) fn fit_pose(
    camera: &Camera,
    points: &[Pointing],
    predicted: &PredictedCamera,
    start: &Isometry3<f64>,
) -> Option<PoseFit> {
    let problem = PoseProblem { camera, points, predicted };
    let end = minimize(&problem, PoseFit::at(*start, camera, points), &DESCENT);
    (end.stop != Stop::Singular).then_some(end.state)
}

/// Points that pull at a pose, by Geman and McClure's weights of their residuals there.
struct PoseProblem<'a> {
    camera: &'a Camera,
    points: &'a [Pointing],
    predicted: &'a PredictedCamera,
}

impl LeastSquares for PoseProblem<'_> {
    type Size = Const<6>;
    type State = PoseFit;

    fn normal_equations(&self, fit: &PoseFit) -> NormalEquations<Const<6>> {
        let pose = &fit.camera_from_site;
        let mut normal = prior(self.predicted, pose);
        for (point, residual) in self.points.iter().zip(&fit.residuals_px) {
            let Some((_, jacobian)) = pixel_with_jacobian(self.camera, pose, &point.point_in_site_m) else { continue };
            let unit = residual.norm() / (SOFT * fit.scale * point.sigma_px);
            let weight = (1.0 / (1.0 + unit * unit).powi(2)) / (fit.scale * point.sigma_px).powi(2);
            normal.information += jacobian.transpose() * jacobian * weight;
            normal.right_side += jacobian.transpose() * residual * weight;
            normal.cost += 0.5 * weight * residual.norm_squared();
        }
        normal
    }

    fn moved(&self, fit: &PoseFit, step: &Vector6<f64>) -> Option<PoseFit> {
        Some(PoseFit::at(moved(&fit.camera_from_site, step), self.camera, self.points))
    }

    /// In units of the least turn and shift.
    fn length(&self, step: &Vector6<f64>) -> f64 {
        let (turn_rad, shift_m) = (step.fixed_rows::<3>(0).norm(), step.fixed_rows::<3>(3).norm());
        (turn_rad / LEAST_TURN_RAD).max(shift_m / LEAST_SHIFT_M)
    }
}

/// Normal equations of the prediction at a pose. A shift τ in camera axes moves the camera by -Rᵀτ.
fn prior(predicted: &PredictedCamera, pose: &Isometry3<f64>) -> NormalEquations<Const<6>> {
    let turn_1_rad2 = predicted.sigma_attitude_rad.powi(-2);
    let shift_1_m2 = predicted.sigma_position_m.powi(-2);
    let turned = so3::log(&(predicted.camera_from_site.rotation * pose.rotation.inverse()));
    let place = |p: &Isometry3<f64>| p.inverse().translation.vector;
    let moved_m = -(pose.rotation * (place(&predicted.camera_from_site) - place(pose)));
    let mut information = Matrix6::zeros();
    information.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * turn_1_rad2));
    information.fixed_view_mut::<3, 3>(3, 3).copy_from(&(Matrix3::identity() * shift_1_m2));
    let mut right_side = Vector6::zeros();
    right_side.fixed_rows_mut::<3>(0).copy_from(&(turned * turn_1_rad2));
    right_side.fixed_rows_mut::<3>(3).copy_from(&(moved_m * shift_1_m2));
    let cost = 0.5 * (turned.norm_squared() * turn_1_rad2 + moved_m.norm_squared() * shift_1_m2);
    NormalEquations { information, right_side, cost }
}

impl PoseFit {
    fn at(camera_from_site: Isometry3<f64>, camera: &Camera, points: &[Pointing]) -> PoseFit {
        let residual = |point: &Pointing| match pixel_with_jacobian(camera, &camera_from_site, &point.point_in_site_m) {
            Some((pixel_px, _)) => point.pixel_px - pixel_px,
            None => Vector2::repeat(f64::INFINITY),
        };
        let residuals_px: Vec<Vector2<f64>> = points.iter().map(residual).collect();
        let mut sizes: Vec<f64> = residuals_px.iter().zip(points).map(|(r, p)| r.norm() / p.sigma_px).collect();
        let scale = upper_median(&mut sizes).map_or(1.0, |median| median / NORMAL_MEDIAN_2D);
        PoseFit { camera_from_site, residuals_px, scale: scale.clamp(LEAST_SCALE, 1e6) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::central_difference;
    use crate::stats::random_stream;
    use nalgebra::{Point3, SVector};
    use rand::RngExt;

    fn camera() -> Camera {
        Camera::from_fov(512, 512, 1.5)
    }

    fn true_pose() -> Isometry3<f64> {
        let rotation = so3::exp(&Vector3::new(3.0, 0.05, -0.1));
        Isometry3::from_parts((rotation * Vector3::new(-30.0, 20.0, -400.0)).into(), rotation)
    }

    /// Points of hilly ground before the camera, one in so many of them found 20 px off.
    fn points(wrong: Option<usize>) -> Vec<Pointing> {
        let mut random = random_stream(3, "map pose", 0);
        let point = |index: usize| {
            let mut draw = |half: f64| random.random_range(-half..half);
            let point_in_site_m = Vector3::new(30.0 + draw(250.0), -20.0 + draw(250.0), draw(20.0));
            let seen = (true_pose() * Point3::from(point_in_site_m)).coords;
            let off_px = if wrong.is_some_and(|every: usize| index.is_multiple_of(every)) { 20.0 } else { 0.0 };
            let pixel_px = camera().project(&seen).expect("before the camera") + Vector2::new(off_px, -off_px);
            Pointing { point_in_site_m, pixel_px, sigma_px: 0.1 }
        };
        (0..40).map(point).collect()
    }

    fn predicted() -> PredictedCamera {
        let off = Vector6::new(0.02, -0.03, 0.01, 8.0, -5.0, 9.0);
        PredictedCamera {
            camera_from_site: moved(&true_pose(), &off),
            sigma_position_m: 500.0,
            sigma_attitude_rad: 0.5,
        }
    }

    #[test]
    fn the_jacobian_is_that_of_central_differences() {
        let point = Vector3::new(80.0, -90.0, 15.0);
        let (pixel_px, jacobian) = pixel_with_jacobian(&camera(), &true_pose(), &point).expect("before the camera");
        let pixel = |step: &SVector<f64, 6>| {
            let pose = moved(&true_pose(), step);
            pixel_with_jacobian(&camera(), &pose, &point).expect("before the camera").0
        };
        let numeric: Matrix2x6<f64> = central_difference(pixel, &SVector::<f64, 6>::zeros(), 1e-5);
        assert!((numeric - jacobian).abs().max() < 1e-5 * jacobian.abs().max(), "{numeric} {jacobian}");
        assert!((pixel(&SVector::zeros()) - pixel_px).norm() < 1e-12);
    }

    #[test]
    fn exact_points_give_the_exact_pose_and_wrong_ones_are_passed_over() {
        for wrong in [None, Some(4)] {
            let fit = fit_pose(&camera(), &points(wrong), &predicted(), &predicted().camera_from_site).expect("a pose");
            let off = fit.camera_from_site * true_pose().inverse();
            assert!(off.translation.vector.norm() < 0.02, "{wrong:?}: {off}");
            assert!(off.rotation.angle() < 5e-5, "{wrong:?}: {off}");
            let far = fit.residuals_px.iter().filter(|r| r.norm() > 10.0).count();
            assert_eq!(far, wrong.map_or(0, |every| 40 / every));
        }
    }

    /// With a third of the points wrong and no robust weights, the pose would be far off: the test can fail.
    #[test]
    fn plain_least_squares_would_follow_wrong_points() {
        let wrong: Vec<Pointing> = points(Some(4)).iter().map(|p| Pointing { sigma_px: 1e3, ..*p }).collect();
        let fit = fit_pose(&camera(), &wrong, &predicted(), &predicted().camera_from_site).expect("a pose");
        let off = fit.camera_from_site * true_pose().inverse();
        assert!(off.translation.vector.norm() > 1.0, "{off}");
    }

    #[test]
    fn without_points_the_prediction_stays() {
        let fit = fit_pose(&camera(), &[], &predicted(), &true_pose()).expect("a pose");
        let off = fit.camera_from_site * predicted().camera_from_site.inverse();
        assert!(off.translation.vector.norm() < 1e-6 && off.rotation.angle() < 1e-9, "{off}");
    }
}
