//! Where a ray meets the ground.

use super::state::DescentState;
use nalgebra::Vector3;

/// Where a ray from the camera along `direction_in_lander` meets the height `height_m` (site frame, m), and how far
/// along the ray that is, m; `None` if it does not fall by at least 1° or the camera is not above.
pub fn ground_point(
    state: &DescentState,
    direction_in_lander: &Vector3<f64>,
    camera_in_lander_m: &Vector3<f64>,
    height_m: f64,
) -> Option<(Vector3<f64>, f64)> {
    let site_from_lander = state.lander_from_site.inverse();
    let camera_in_site_m = state.lander_in_site_m + site_from_lander * camera_in_lander_m;
    let u = site_from_lander * direction_in_lander;
    let depth_m = (height_m - camera_in_site_m.z) / u.z;
    (u.z < -1f64.to_radians().sin() && depth_m > 0.0).then(|| (camera_in_site_m + u * depth_m, depth_m))
}
