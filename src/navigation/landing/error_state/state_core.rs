//! The part of the error state that every form of the filter shares.

use super::state::DescentState;

/// The lander's part of a state, which a transition starts from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Core {
    /// Position r in the site frame, m.
    pub lander_in_site_m: nalgebra::Vector3<f64>,
    /// Velocity v in the site frame, m/s.
    pub lander_velocity_in_site_m_s: nalgebra::Vector3<f64>,
    /// Attitude.
    pub lander_from_site: nalgebra::UnitQuaternion<f64>,
}

impl Core {
    /// That part of a state.
    pub fn of(state: &DescentState) -> Self {
        Core {
            lander_in_site_m: state.lander_in_site_m,
            lander_velocity_in_site_m_s: state.lander_velocity_in_site_m_s,
            lander_from_site: state.lander_from_site,
        }
    }
}
