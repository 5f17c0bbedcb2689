//! One interface to every way of choosing the unknown landmark.

use super::golden::golden_section;
use super::lookahead::posterior_position_variance_m2;
use super::metrics::{Metric, metric, scaled_metric};
use super::triangle::Triangle;
use super::viewpoint::Viewpoint;
use nalgebra::Vector3;
use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// How the ideal landmark is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Selector {
    /// Least depth error, closed form (Li et al. 2023).
    #[default]
    DepthError,
    /// Least depth error by golden section, as the paper searches it.
    DepthErrorSearch,
    /// Largest non-zero smallest singular value of H.
    Svd,
    /// Least geometric dilution of precision.
    Gdop,
    /// Best condition number of H.
    Condition,
    /// The optimum that the three share, closed form: p* = |r| r_h / |r_h| with r_h the lander's place on the ground.
    Lambda4,
    /// As `svd`, on three epochs scaled by the noise and the prior.
    SvdScaled,
    /// As `gdop`, on three epochs scaled by the noise and the prior.
    GdopScaled,
    /// As `condition`, on three epochs scaled by the noise and the prior.
    ConditionScaled,
    /// Least position covariance after three epochs, terrain prior included.
    Covariance,
    /// Anywhere within 45° of nadir, uniform in solid angle.
    Random,
    /// No unknown landmark at all.
    None,
}

impl Selector {
    /// Every selector, in the order of their words.
    pub const ALL: [Selector; 12] = [
        Selector::DepthError,
        Selector::DepthErrorSearch,
        Selector::Svd,
        Selector::Gdop,
        Selector::Condition,
        Selector::Lambda4,
        Selector::SvdScaled,
        Selector::GdopScaled,
        Selector::ConditionScaled,
        Selector::Covariance,
        Selector::Random,
        Selector::None,
    ];

    /// Its word on the command line and in files.
    pub fn word(self) -> &'static str {
        match self {
            Selector::DepthError => "depth-error",
            Selector::DepthErrorSearch => "depth-error-search",
            Selector::Svd => "svd",
            Selector::Gdop => "gdop",
            Selector::Condition => "condition",
            Selector::Lambda4 => "lambda4",
            Selector::SvdScaled => "svd-scaled",
            Selector::GdopScaled => "gdop-scaled",
            Selector::ConditionScaled => "condition-scaled",
            Selector::Covariance => "covariance",
            Selector::Random => "random",
            Selector::None => "none",
        }
    }

    /// The ideal landmark on the ground plane, in the site frame (m); `None` where the lander is not above the plane,
    /// and always for [`Selector::None`].
    ///
    /// The searches run over β in the vertical plane of the velocity (α = γ). Where the lander hardly descends and the
    /// triangle has no corner D, the ground point at nadir is given. `random` is drawn from by [`Selector::Random`] alone.
    pub fn ideal_landmark_in_site_m(&self, view: &Viewpoint, random: &mut impl Rng) -> Option<Vector3<f64>> {
        let point_m = match self {
            Selector::None => return None,
            Selector::DepthError => by_triangle(view, Triangle::minimum),
            Selector::DepthErrorSearch => by_triangle(view, Triangle::minimum_by_search),
            Selector::Svd => by_metric(view, Metric::SingularValue),
            Selector::Gdop => by_metric(view, Metric::Dilution),
            Selector::Condition => by_metric(view, Metric::Condition),
            Selector::Lambda4 => lambda4_optimum_in_site_m(view),
            Selector::SvdScaled => by_scaled_metric(view, Metric::SingularValue),
            Selector::GdopScaled => by_scaled_metric(view, Metric::Dilution),
            Selector::ConditionScaled => by_scaled_metric(view, Metric::Condition),
            Selector::Covariance => by_covariance(view),
            Selector::Random => view.lander_in_site_m + random_direction(random),
        };
        view.ground_point_in_site_m(&(point_m - view.lander_in_site_m))
    }
}

fn nadir_in_site_m(view: &Viewpoint) -> Vector3<f64> {
    Vector3::new(view.lander_in_site_m.x, view.lander_in_site_m.y, 0.0)
}

fn by_triangle(view: &Viewpoint, minimum: impl Fn(&Triangle) -> (f64, f64)) -> Vector3<f64> {
    Triangle::of(view).map_or(nadir_in_site_m(view), |triangle| {
        let (alpha_rad, beta_rad) = minimum(&triangle);
        triangle.landmark_in_site_m(view, alpha_rad, beta_rad)
    })
}

fn by_metric(view: &Viewpoint, kind: Metric) -> Vector3<f64> {
    by_search(view, |point_m| metric(kind, &view.lander_in_site_m, point_m))
}

fn by_scaled_metric(view: &Viewpoint, kind: Metric) -> Vector3<f64> {
    by_search(view, |point_m| scaled_metric(kind, view, point_m))
}

/// Golden section over β for the largest merit, in the vertical plane of the velocity.
fn by_search(view: &Viewpoint, merit: impl Fn(&Vector3<f64>) -> f64) -> Vector3<f64> {
    by_triangle(view, |triangle| {
        let alpha_rad = triangle.path_angle_rad;
        let cost = |beta_rad: f64| -merit(&triangle.landmark_in_site_m(view, alpha_rad, beta_rad));
        (alpha_rad, golden_section(cost, 0.0, PI - alpha_rad, Triangle::EVALUATIONS).0)
    })
}

/// Maximum of λ4 over the ground: p* = |r| r_h / |r_h|.
fn lambda4_optimum_in_site_m(view: &Viewpoint) -> Vector3<f64> {
    let r = view.lander_in_site_m;
    Vector3::new(r.x, r.y, 0.0).try_normalize(1e-9).unwrap_or(Vector3::x()) * r.norm()
}

/// Best of two polar grids, about the site and about nadir, with radii in proportion to the height, then refined.
fn by_covariance(view: &Viewpoint) -> Vector3<f64> {
    const AZIMUTHS: usize = 12;
    let height_m = view.lander_in_site_m.z;
    let spoke = |azimuth: usize| {
        let angle_rad = TAU * azimuth as f64 / AZIMUTHS as f64;
        Vector3::new(angle_rad.cos(), angle_rad.sin(), 0.0) * height_m
    };
    let grid = [(Vector3::zeros(), [0.03, 0.1, 0.3]), (nadir_in_site_m(view), [0.3, 0.6, 1.2])];
    let points = grid.iter().flat_map(|(center_m, radii)| {
        radii.iter().flat_map(move |radius| (0..AZIMUTHS).map(move |azimuth| center_m + spoke(azimuth) * *radius))
    });
    let best = points.map(|p| (variance_m2(view, &p), p)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(nadir_in_site_m(view), |start| refined(view, start))
}

/// Compass search: steps of a fifth of the height, halved where none of four helps.
fn refined(view: &Viewpoint, start: (f64, Vector3<f64>)) -> Vector3<f64> {
    let (mut least, mut at_m) = start;
    let mut step_m = 0.2 * view.lander_in_site_m.z;
    for _ in 0..10 {
        let around = [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y()].map(|d| at_m + d * step_m);
        match around.iter().map(|p| (variance_m2(view, p), *p)).min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((variance, p)) if variance < least => (least, at_m) = (variance, p),
            _ => step_m *= 0.5,
        }
    }
    at_m
}

/// The look-ahead's variance, infinite beyond the largest angle off nadir.
fn variance_m2(view: &Viewpoint, point_m: &Vector3<f64>) -> f64 {
    let off_nadir_rad = (-Vector3::z()).angle(&(point_m - view.lander_in_site_m));
    if off_nadir_rad > view.ground.largest_off_nadir_rad {
        return f64::INFINITY;
    }
    posterior_position_variance_m2(view, point_m)
}

/// Uniform in solid angle within 45° of nadir, site axes.
fn random_direction(random: &mut impl Rng) -> Vector3<f64> {
    let cosine = random.random_range(FRAC_PI_4.cos()..1.0);
    let azimuth_rad = random.random_range(0.0..TAU);
    let sine = (1.0 - cosine * cosine).sqrt();
    Vector3::new(sine * azimuth_rad.cos(), sine * azimuth_rad.sin(), -cosine)
}
