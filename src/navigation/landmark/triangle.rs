//! The triangle of lander C, landmark P and the point D where the velocity line meets the ground (Li et al. 2023, fig. 2).

use super::golden::golden_section;
use super::viewpoint::Viewpoint;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Geometry of a descent along a straight line, with the depth-error model of Li et al. 2023, section 2.1.
///
/// α is the interior angle at D (between the velocity line, back to the lander, and the landmark), β the one at C
/// (between the velocity and the landmark), φ the azimuth of the landmark at D from the uprange direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Distance |CD| along the velocity to the ground, m.
    pub range_to_ground_m: f64,
    /// Distance b covered between two observations, m; less than |CD|.
    pub baseline_m: f64,
    /// Path angle γ below the horizontal, rad.
    pub path_angle_rad: f64,
}

impl Triangle {
    /// Evaluations of the golden-section search over β.
    pub const EVALUATIONS: usize = 19;

    /// The triangle of a viewpoint: |CD| = r_z / sin γ, b = |v| t_s. `None` unless it descends by at least 3° towards a
    /// ground below it, where the line has no useful intersection.
    pub fn of(view: &Viewpoint) -> Option<Self> {
        let path_angle_rad = view.path_angle_rad();
        if path_angle_rad < 3f64.to_radians() || view.lander_in_site_m.z <= 0.0 {
            return None;
        }
        let range_to_ground_m = view.lander_in_site_m.z / path_angle_rad.sin();
        let travelled_m = view.lander_velocity_in_site_m_s.norm() * view.interval_s;
        Some(Triangle { range_to_ground_m, baseline_m: travelled_m.min(0.9 * range_to_ground_m), path_angle_rad })
    }

    /// α of an azimuth φ: cos α = cos γ cos φ.
    pub fn alpha_rad(&self, azimuth_rad: f64) -> f64 {
        (self.path_angle_rad.cos() * azimuth_rad.cos()).acos()
    }

    /// Distance |CP| = |CD| sin α / sin(α + β), m.
    pub fn depth_m(&self, alpha_rad: f64, beta_rad: f64) -> f64 {
        self.range_to_ground_m * alpha_rad.sin() / (alpha_rad + beta_rad).sin()
    }

    /// Distance |DP| = |CD| sin β / sin(α + β), m.
    pub fn offset_m(&self, alpha_rad: f64, beta_rad: f64) -> f64 {
        self.range_to_ground_m * beta_rad.sin() / (alpha_rad + beta_rad).sin()
    }

    /// Depth error δr / (ε_v t_s) of equations (23) to (25): 2 |r_{k+s}| / (b sin β).
    ///
    /// The velocity's error bound ε_v and the interval t_s only scale it and never move the minimum.
    pub fn depth_error(&self, alpha_rad: f64, beta_rad: f64) -> f64 {
        let (b, d) = (self.baseline_m, self.depth_m(alpha_rad, beta_rad));
        let later_m = (b * b + d * d - 2.0 * b * d * beta_rad.cos()).sqrt();
        2.0 * later_m / (b * beta_rad.sin())
    }

    /// (α, β) of the least depth error by golden section over β; the optimum lies on the boundary α = γ.
    pub fn minimum_by_search(&self) -> (f64, f64) {
        let alpha_rad = self.path_angle_rad;
        let (beta_rad, _) =
            golden_section(|beta| self.depth_error(alpha_rad, beta), 0.0, PI - alpha_rad, Self::EVALUATIONS);
        (alpha_rad, beta_rad)
    }

    /// (α, β) of the least depth error in closed form, exact: with d2 = |CD|, d1 = d2 - b, ρ = √(d1 d2),
    /// α* = max(γ, acos(2ρ/(d1 + d2))), β* = atan2(ρ sin α*, d2 - ρ cos α*).
    pub fn minimum(&self) -> (f64, f64) {
        let d2 = self.range_to_ground_m;
        let d1 = d2 - self.baseline_m;
        let rho = (d1 * d2).sqrt();
        let alpha = (2.0 * rho / (d1 + d2)).min(1.0).acos().max(self.path_angle_rad);
        (alpha, (rho * alpha.sin()).atan2(d2 - rho * alpha.cos()))
    }

    /// The ground point of (α, β) in the site frame, m: (α, β) fix it up to a mirror image; the one to the left of the
    /// course is given.
    pub fn landmark_in_site_m(&self, view: &Viewpoint, alpha_rad: f64, beta_rad: f64) -> Vector3<f64> {
        let course = view.course_in_site();
        let forward_m = self.range_to_ground_m * self.path_angle_rad.cos();
        let nadir_m = Vector3::new(view.lander_in_site_m.x, view.lander_in_site_m.y, 0.0);
        let cos_azimuth = (alpha_rad.cos() / self.path_angle_rad.cos()).clamp(-1.0, 1.0);
        let left = Vector3::z().cross(&course);
        let from_d = -course * cos_azimuth + left * (1.0 - cos_azimuth * cos_azimuth).sqrt();
        nadir_m + course * forward_m + from_d * self.offset_m(alpha_rad, beta_rad)
    }
}
