//! What the nodes believe at the start.

use crate::dataset::InitialState;
use crate::dataset::truth::LanderState;
use crate::geometry::Manifold;
use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::{Isometry3, Translation3, Vector3};
use rand_distr::{Distribution, StandardNormal};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// 1σ of the first states' errors, Gaussian: one draw that all nodes share, and one of each node's own.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NodeErrorConfig {
    /// Shared position error in m an axis, 1e-9 to 1e6 (default 5).
    pub shared_position_m: f64,
    /// Shared velocity error in m/s an axis, 1e-9 to 10000 (default 0.1).
    pub shared_velocity_m_s: f64,
    /// Shared attitude error in degrees an axis, 1e-9 to 90 (default 5).
    pub shared_attitude_deg: f64,
    /// A node's own position error in m an axis, 1e-9 to 1e6 (default 0.03).
    pub own_position_m: f64,
    /// A node's own velocity error in m/s an axis, 1e-9 to 10000 (default 0.004).
    pub own_velocity_m_s: f64,
    /// A node's own attitude error in degrees an axis, 1e-9 to 90 (default 2).
    pub own_attitude_deg: f64,
}

impl Default for NodeErrorConfig {
    fn default() -> Self {
        NodeErrorConfig {
            shared_position_m: 5.0,
            shared_velocity_m_s: 0.1,
            shared_attitude_deg: 5.0,
            own_position_m: 0.03,
            own_velocity_m_s: 0.004,
            own_attitude_deg: 2.0,
        }
    }
}

impl NodeErrorConfig {
    /// A node's first estimate with seeded errors around the truth; its 1σ are those of both errors together.
    pub fn initial_state(&self, truth: &LanderState, (seed, node): (u64, u32)) -> InitialState {
        let shared = draws(seed, "initial-state-shared", 0);
        let own = draws(seed, "initial-state-node", u64::from(node));
        let error = |index: usize, of_all: f64, of_node: f64| shared[index] * of_all + own[index] * of_node;
        let [shared_rad, own_rad] = [self.shared_attitude_deg, self.own_attitude_deg].map(f64::to_radians);
        let position_m =
            truth.site_from_lander.translation.vector + error(0, self.shared_position_m, self.own_position_m);
        let attitude = truth.site_from_lander.rotation.plus(&error(2, shared_rad, own_rad));
        InitialState {
            t_ns: truth.t_ns,
            site_from_lander: Isometry3::from_parts(Translation3::from(position_m), attitude),
            lander_velocity_in_site_m_s: truth.lander_velocity_in_site_m_s
                + error(1, self.shared_velocity_m_s, self.own_velocity_m_s),
            sigma_position_m: self.shared_position_m.hypot(self.own_position_m),
            sigma_velocity_m_s: self.shared_velocity_m_s.hypot(self.own_velocity_m_s),
            sigma_attitude_rad: shared_rad.hypot(own_rad),
        }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        let ranges = [
            ("shared_position_m", self.shared_position_m, 1e6),
            ("shared_velocity_m_s", self.shared_velocity_m_s, 1e4),
            ("shared_attitude_deg", self.shared_attitude_deg, 90.0),
            ("own_position_m", self.own_position_m, 1e6),
            ("own_velocity_m_s", self.own_velocity_m_s, 1e4),
            ("own_attitude_deg", self.own_attitude_deg, 90.0),
        ];
        ranges.into_iter().try_for_each(|(key, value, most)| limits::within(key, value, 1e-9, most))
    }
}

/// Standard normal vectors for position, velocity and attitude.
fn draws(seed: u64, purpose: &str, index: u64) -> [Vector3<f64>; 3] {
    let mut random = random_stream(seed, purpose, index);
    std::array::from_fn(|_| Vector3::from_fn(|_, _| StandardNormal.sample(&mut random)))
}
