//! One simulated landing.

use super::bound::Bound;
use super::options::CampaignOptions;
use super::relief::{Relief, features_m, is_seen, surface_point_m};
use super::simulated_sensors::{StepNoise, TrueState, measured_bearing, true_states, uncertain_start};
use crate::navigation::landing::{
    BearingObservation, CameraMount, FrameInput, ImuIncrement, InitializationModel, KnownPoint, Navigator, step,
    viewpoint, with_landmark, without_landmark,
};
use crate::observations::TrackObservation;
use crate::stats::{normalized_error_squared, random_stream};
use nalgebra::{SVector, Unit, UnitQuaternion, Vector3};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::time::Instant;

/// Errors of one second of a flight; position (m), velocity (m/s) and attitude ψ (rad), all in site axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightEpoch {
    /// True less estimated.
    pub error: SVector<f64, 9>,
    /// 1σ by the filter.
    pub sigma: SVector<f64, 9>,
    /// 1σ by the posterior Cramér–Rao bound.
    pub bound: SVector<f64, 9>,
    /// Normalised error squared over its 9 degrees of freedom; infinite for a covariance that is not positive definite.
    pub nees: f64,
    /// Normalised innovation squared of the image over its degrees of freedom; `None` without an image.
    pub nis: Option<f64>,
    /// Its degrees of freedom.
    pub nis_dof: usize,
}

/// A simulated landing.
#[derive(Debug, Clone, PartialEq)]
pub struct FlightRecord {
    /// One epoch a second, from 0.
    pub epochs: Vec<FlightEpoch>,
    /// Whether the filter came to the end; it ends early where its covariance breaks down.
    pub complete: bool,
    /// Bearings that were gated.
    pub gated: usize,
    /// Wall time of each choice of a landmark, ns. The only thing that differs from one execution to the next.
    pub selection_ns: Vec<f64>,
}

/// First number of the tracks of further known landmarks.
const FIRST_TRACK: u64 = 1;

/// Everything that a flight carries from second to second.
struct Flight<'a> {
    options: &'a CampaignOptions,
    mount: Option<CameraMount>,
    relief: Relief,
    /// Places of the tracks that are followed, by number.
    places_m: BTreeMap<u64, Vector3<f64>>,
    next_track: u64,
    random: ChaCha8Rng,
    selection_ns: Vec<f64>,
}

/// Flies number `run` of a campaign.
pub fn fly(options: &CampaignOptions, run: u64) -> FlightRecord {
    let states = true_states(options);
    let mut random = random_stream(options.seed, "simulated landing", run);
    let relief = Relief::new(options, &mut random);
    let believed = uncertain_start(&states[0], &mut random);
    let mount = options.field_of_view.mount();
    let mut flight = Flight {
        options,
        mount,
        relief,
        places_m: BTreeMap::from([(TrackObservation::DESIGNATED, Vector3::zeros())]),
        next_track: FIRST_TRACK,
        random,
        selection_ns: Vec::new(),
    };
    let mut record = FlightRecord { epochs: Vec::new(), complete: false, gated: 0, selection_ns: Vec::new() };
    let mut bound = Bound::new(&states[0], &believed, &options.filter);
    let mut navigator = Navigator::new(&believed, &options.filter);
    for (second, truth) in states.iter().enumerate() {
        let exact = second
            .checked_sub(1)
            .map(|before| StepNoise::of(options).stated(&states[before].increment_to(truth, 1.0, &options.planet())));
        if let Some(exact) = &exact {
            bound = bound.predicted(exact, truth, &options.planet());
        }
        let Some((after, epoch)) = flight.second(navigator, (&mut bound, truth), exact.as_ref()) else {
            record.selection_ns = flight.selection_ns;
            return record;
        };
        record.gated += epoch.1;
        record.epochs.push(epoch.0);
        navigator = after;
    }
    FlightRecord { complete: true, selection_ns: flight.selection_ns, ..record }
}

impl Flight<'_> {
    /// One second: an increment, an image if the lander is high enough, a choice of landmarks. `None` if a covariance
    /// broke down.
    fn second(
        &mut self,
        navigator: Navigator,
        (bound, truth): (&mut Bound, &TrueState),
        exact: Option<&ImuIncrement>,
    ) -> Option<(Navigator, (FlightEpoch, usize))> {
        let config = &self.options.filter;
        let increment = match exact {
            Some(exact) => StepNoise::of(self.options).measured(exact, &mut self.random),
            None => ImuIncrement::identity(),
        };
        let navigator = if self.mount.is_none() { self.without_served(navigator) } else { navigator };
        let bearings = self.bearings(&navigator, truth);
        let frame = FrameInput { increment: increment.clone(), bearings, rotation: None };
        let mount = self.mount.unwrap_or_else(everywhere);
        let (mut after, report) = step(navigator, &frame, &mount, config)?;
        if !report.outcomes.is_empty() {
            let followed = |b: &&BearingObservation| report.outcomes.iter().any(|o| o.track_id == b.track_id);
            let seen: Vec<_> = frame.bearings.iter().filter(followed).copied().collect();
            *bound = bound.clone().corrected(truth, &seen)?;
            if self.mount.is_none() {
                self.choose(&mut after, truth, &increment);
            }
            let place_of = |id: u64| self.places_m.get(&id).copied();
            *bound = bound.clone().following(truth, &after.estimate, place_of, self.options.sigma_bearing_rad);
        }
        let follows = |id: u64| id == TrackObservation::DESIGNATED || after.estimate.state.landmark_of(id).is_some();
        self.places_m.retain(|id, _| follows(*id));
        let covariance = config.filter.site_covariance(&after.estimate);
        let state = &after.estimate.state;
        let error = truth.error_of(&state.site_from_lander(), &state.lander_velocity_in_site_m_s);
        let epoch = FlightEpoch {
            error,
            sigma: covariance.diagonal().map(|v| v.max(0.0).sqrt()),
            bound: bound.variances().map(|v| v.max(0.0).sqrt()),
            nees: normalized_error_squared(&error, &covariance).map_or(f64::INFINITY, |x| x / 9.0),
            nis: report.normalized_innovation_squared.map(|x| x / (2 * report.used()) as f64),
            nis_dof: 2 * report.used(),
        };
        Some((after, (epoch, report.outcomes.len() - report.used())))
    }

    /// Bearings of the known landmarks, of those followed and, in a camera's image, of features.
    fn bearings(&mut self, navigator: &Navigator, truth: &TrueState) -> Vec<BearingObservation> {
        let mut bearings = Vec::new();
        let followed = navigator.estimate.state.landmarks.iter().map(|l| l.track_id);
        for id in [TrackObservation::DESIGNATED].into_iter().chain(followed) {
            let Some(place_m) = self.places_m.get(&id) else { continue };
            if is_seen(truth, self.mount.as_ref(), place_m) {
                bearings.push(measured_bearing(truth, (id, place_m), self.options, &mut self.random));
            }
        }
        for place in &self.options.known_landmarks_m {
            let place_m = Vector3::from(*place);
            if is_seen(truth, self.mount.as_ref(), &place_m) {
                let bearing = measured_bearing(truth, (u64::MAX, &place_m), self.options, &mut self.random);
                let known = Some(KnownPoint { position_in_site_m: place_m, sigma_m: 0.0 });
                bearings.push(BearingObservation { known, ..bearing });
            }
        }
        if let Some(mount) = self.mount {
            for place_m in features_m(truth, &mount, (self.options, &self.relief), &mut self.random) {
                let id = self.new_track(place_m);
                bearings.push(measured_bearing(truth, (id, &place_m), self.options, &mut self.random));
            }
        }
        bearings
    }

    fn new_track(&mut self, place_m: Vector3<f64>) -> u64 {
        let id = self.next_track;
        self.next_track += 1;
        self.places_m.insert(id, place_m);
        id
    }

    /// Where everything is seen, a landmark that has served gives way before the next image, as in the reference
    /// simulation: then no image observes one landmark and places another.
    fn without_served(&self, mut navigator: Navigator) -> Navigator {
        let least = self.options.filter.reselect_after;
        while let Some(k) = navigator.estimate.state.landmarks.iter().position(|l| l.observations >= least) {
            navigator.estimate = without_landmark(&navigator.estimate, k);
        }
        navigator
    }

    /// Where everything is seen: a surface point in the ideal direction itself for every landmark that is missing.
    fn choose(&mut self, navigator: &mut Navigator, truth: &TrueState, increment: &ImuIncrement) {
        let config = &self.options.filter;
        for slot in 0..config.unknown_landmarks {
            if navigator.estimate.state.landmarks.iter().any(|l| l.slot == slot) {
                continue;
            }
            let Some(direction) = self.ideal_direction(navigator, increment, slot) else { continue };
            let in_lander = navigator.estimate.state.lander_from_site * direction;
            let ground = (self.options, &self.relief);
            let Some(place_m) = surface_point_m(truth, &in_lander, ground, &mut self.random) else { continue };
            let id = self.new_track(place_m);
            let bearing = measured_bearing(truth, (id, &place_m), self.options, &mut self.random);
            let model = InitializationModel {
                kind: config.filter,
                camera_in_lander_m: Vector3::zeros(),
                ground: config.ground,
            };
            if let Some(estimate) = with_landmark(&navigator.estimate, &bearing, slot, &model) {
                navigator.estimate = estimate;
            }
        }
    }

    fn ideal_direction(
        &mut self,
        navigator: &Navigator,
        increment: &ImuIncrement,
        slot: usize,
    ) -> Option<Unit<Vector3<f64>>> {
        let config = &self.options.filter;
        let mut increment = increment.clone();
        if increment.duration_s == 0.0 {
            // Before the first increment the lander is taken to hang on its thrust.
            increment.duration_s = 1.0;
            increment.velocity_in_before_m_s =
                navigator.estimate.state.lander_from_site * -config.planet().gravity_in_site_m_s2;
        }
        let view = viewpoint(&navigator.estimate, &increment, self.options.sigma_bearing_rad, config);
        let start = Instant::now();
        let ideal_m = config.selector.ideal_landmark_in_site_m(&view, &mut self.random);
        self.selection_ns.push(start.elapsed().as_nanos() as f64);
        let turn = TAU * slot as f64 / config.unknown_landmarks as f64;
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) * (ideal_m? - view.lander_in_site_m);
        Some(Unit::new_normalize(turned))
    }
}

/// A camera that sees everything, as far as the filter's step needs one: it places the bearings' origin.
fn everywhere() -> CameraMount {
    CameraMount {
        camera: crate::geometry::Camera::from_fov(1024, 1024, 90f64.to_radians()),
        lander_from_camera: nalgebra::Isometry3::identity(),
    }
}
