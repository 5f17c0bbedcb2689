//! The posterior Cramér–Rao bound along a flight: the covariance of the filter's own recursion, linearised at the truth
//! and without what its noise adds for its own errors (Tichavský, Muravchik, Nehorai, "Posterior Cramér–Rao bounds for
//! discrete-time nonlinear filtering", 1998; for Gaussian noise the recursion of the information is the Kalman filter's).

use super::simulated_sensors::{TrueState, exact_direction};
use crate::dataset::InitialState;
use crate::navigation::filter::Gate;
use crate::navigation::landing::{
    BearingObservation, CorrectionModel, DescentEstimate, FilterKind, ImuIncrement, InitializationModel, LandingConfig,
    Planet, initial_estimate, with_landmark_at_height, without_landmark,
};
use crate::navigation::{correct, predict};
use nalgebra::{Isometry3, SVector, Vector3};

/// The bound on the covariance at one time of a flight.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    estimate: DescentEstimate,
    config: LandingConfig,
}

impl Bound {
    /// Before the first image.
    pub fn new(start: &TrueState, believed: &InitialState, config: &LandingConfig) -> Self {
        let at_truth = InitialState {
            site_from_lander: Isometry3::from_parts(start.position_m.into(), start.lander_from_site.inverse()),
            lander_velocity_in_site_m_s: start.velocity_m_s,
            ..*believed
        };
        // Both coordinates have the same bound; the hybrid ones keep yaw apart exactly.
        let config = LandingConfig { filter: FilterKind::Hybrid, ..config.clone() };
        Bound { estimate: initial_estimate(&at_truth, &config), config }
    }

    /// After an exact increment to a true state.
    pub fn predicted(self, increment: &ImuIncrement, to: &TrueState, planet: &Planet) -> Self {
        let mut estimate = predict(self.estimate, increment, planet, FilterKind::Hybrid);
        estimate.state.lander_in_site_m = to.position_m;
        estimate.state.lander_velocity_in_site_m_s = to.velocity_m_s;
        estimate.state.lander_from_site = to.lander_from_site;
        Bound { estimate, ..self }
    }

    /// After bearings: each tells of its true direction.
    pub fn corrected(self, truth: &TrueState, bearings: &[BearingObservation]) -> Option<Self> {
        let exact: Vec<BearingObservation> = bearings
            .iter()
            .map(|b| {
                let place = self.estimate.state.landmark_of(b.track_id);
                let point_m = match (&b.known, place) {
                    (Some(known), _) => known.position_in_site_m,
                    (None, Some(k)) => self.estimate.state.landmarks[k].position_in_site_m,
                    (None, None) => Vector3::zeros(),
                };
                let direction_in_lander = exact_direction(truth, &point_m);
                BearingObservation { direction_in_lander, ..*b }
            })
            .collect();
        let model = CorrectionModel {
            kind: FilterKind::Hybrid,
            gate: Gate { confidence: self.config.gate_confidence },
            iterations: 1,
            camera_in_lander_m: Vector3::zeros(),
            second_order: false,
        };
        let estimate = correct(self.estimate, &exact, &model)?.estimate;
        Some(Bound { estimate, ..self })
    }

    /// With the landmarks that a filter follows now: others dropped, new ones placed by a bearing on a true point.
    pub fn following(
        mut self,
        truth: &TrueState,
        filter: &DescentEstimate,
        place_of: impl Fn(u64) -> Option<Vector3<f64>>,
        sigma_bearing_rad: f64,
    ) -> Self {
        let follows = |id: u64| filter.state.landmark_of(id).is_some();
        while let Some(k) = self.estimate.state.landmarks.iter().position(|l| !follows(l.track_id)) {
            self.estimate = without_landmark(&self.estimate, k);
        }
        let model = InitializationModel {
            kind: FilterKind::Hybrid,
            camera_in_lander_m: Vector3::zeros(),
            ground: self.config.ground,
        };
        for landmark in &filter.state.landmarks {
            let Some(point_m) = place_of(landmark.track_id) else { continue };
            if self.estimate.state.landmark_of(landmark.track_id).is_none() {
                let direction = exact_direction(truth, &point_m);
                let bearing = BearingObservation::from_sigma(landmark.track_id, direction, sigma_bearing_rad);
                let placed = with_landmark_at_height(&self.estimate, &bearing, (landmark.slot, point_m.z), &model);
                self.estimate = placed.unwrap_or(self.estimate);
            }
        }
        self
    }

    /// Least variances of the errors of position (m²), velocity (m²/s²) and attitude (rad²), site axes.
    pub fn variances(&self) -> SVector<f64, 9> {
        let j = FilterKind::Hybrid.site_jacobian(&self.estimate.state);
        let own = self.estimate.covariance.fixed_view::<9, 9>(0, 0);
        (j * own * j.transpose()).diagonal()
    }
}
