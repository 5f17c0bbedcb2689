//! Landings from simulated tracks against their bounds.

use super::flight::{FLIGHT, fly};
use super::flown::{error, land, last_frame, nees};
use crate::accuracy_bar::{Bar, check_table};
use opnav::navigation::landing::{LandingConfig, LandingEpoch, LandingInput};
use opnav::navigation::landmark::Selector;
use opnav::stats::ConsistencyBounds;
use rayon::prelude::*;

/// How landmarks are chosen, and what the reference simulation reaches in the same way.
struct Row {
    selector: Selector,
    unknown_landmarks: usize,
    reselect_after: usize,
    reference: Reference,
}

/// 3 r.m.s. of 300 flights of the reference simulation at touchdown: the table that `accuracy_of_the_reference_table`
/// judges too. One axis each.
struct Reference {
    horizontal_m: f64,
    z_m: f64,
    velocity_m_s: f64,
    roll_deg: f64,
    pitch_deg: f64,
}

/// Of a landmark chosen by its depth error.
const ONE: Reference =
    Reference { horizontal_m: 0.106, z_m: 4.69, velocity_m_s: 0.080, roll_deg: 0.024, pitch_deg: 0.012 };

/// What these flights may be worse than the reference, whose bearings are of 1 mrad, once a second for 191 s. Here are 60
/// images whose 0.2 px are 0.78 mrad: by the bearings' information, 0.78 √(191 / 60) = 1.4 of its errors. An r.m.s. of 40
/// flights has 11 % of scatter, 1σ an axis: 1.3 is 2.7σ.
const MARGIN: f64 = 1.4 * 1.3;

const FLIGHTS: u64 = 40;

fn rows() -> [Row; 7] {
    let row = |selector, unknown_landmarks, reselect_after, reference| Row {
        selector,
        unknown_landmarks,
        reselect_after,
        reference,
    };
    [
        row(Selector::None, 1, 3, Reference { horizontal_m: 0.120, z_m: 22.0, velocity_m_s: 0.107, ..ONE }),
        row(Selector::DepthError, 1, 3, ONE),
        row(Selector::Svd, 1, 3, Reference { z_m: 5.27, ..ONE }),
        row(Selector::Random, 1, 3, Reference { horizontal_m: 0.101, z_m: 2.98, velocity_m_s: 0.079, ..ONE }),
        row(Selector::Covariance, 1, 3, Reference { horizontal_m: 0.097, z_m: 1.33, velocity_m_s: 0.078, ..ONE }),
        // No more than with one landmark; and no more than with five.
        row(Selector::DepthError, 3, 8, ONE),
        row(Selector::DepthError, 8, 8, Reference { horizontal_m: 0.096, z_m: 2.02, velocity_m_s: 0.077, ..ONE }),
    ]
}

/// R.m.s. errors at the last image, and the mean NEES a degree of freedom.
struct Measured {
    horizontal_m: f64,
    z_m: f64,
    velocity_m_s: f64,
    tilt_deg: f64,
    nees: f64,
}

impl Row {
    fn measured(&self, flights: &[LandingInput]) -> Measured {
        let &Row { selector, unknown_landmarks, reselect_after, .. } = self;
        let config = LandingConfig { selector, unknown_landmarks, reselect_after, ..LandingConfig::default() };
        let last: Vec<LandingEpoch> =
            flights.par_iter().map(|input| last_frame(input, &land(input, &config))).collect();
        let rms = |start: usize, size: usize| {
            let square = |e: &LandingEpoch| error(e).rows(start, size).norm_squared();
            (last.iter().map(square).sum::<f64>() / last.len() as f64).sqrt()
        };
        Measured {
            horizontal_m: rms(0, 2),
            z_m: rms(2, 1),
            velocity_m_s: rms(3, 3),
            tilt_deg: rms(6, 2).to_degrees(),
            nees: last.iter().map(nees).sum::<f64>() / last.len() as f64,
        }
    }

    fn name(&self, quantity: &str) -> String {
        format!("{:?} {}x{}: {quantity}", self.selector, self.unknown_landmarks, self.reselect_after)
    }

    fn bars(&self, flights: &[LandingInput]) -> Vec<Bar> {
        let (measured, reference) = (self.measured(flights), &self.reference);
        let bar = |quantity: &str, measured: f64, three_rms: f64, unit: &'static str| {
            Bar::at_most(self.name(quantity), measured, MARGIN * three_rms / 3.0, unit)
        };
        let bounds = ConsistencyBounds::of_mean(9, flights.len(), 0.999);
        let tilt_deg = reference.roll_deg.hypot(reference.pitch_deg);
        vec![
            bar("horizontal, r.m.s.", measured.horizontal_m, 2f64.sqrt() * reference.horizontal_m, "m"),
            bar("z, r.m.s.", measured.z_m, reference.z_m, "m"),
            bar("velocity, r.m.s.", measured.velocity_m_s, 3f64.sqrt() * reference.velocity_m_s, "m/s"),
            bar("tilt, r.m.s.", measured.tilt_deg, tilt_deg, "°"),
            Bar::at_least(self.name("NEES/9, 99.9 % of chance"), measured.nees, bounds.lower, ""),
            Bar::at_most(self.name("NEES/9, 99.9 % of chance"), measured.nees, bounds.upper, ""),
        ]
    }

    /// The negative control: height is not known as it is with a landmark. The reference's margin holds downwards too.
    fn bars_of_the_control(&self, flights: &[LandingInput]) -> Vec<Bar> {
        let measured = self.measured(flights);
        vec![
            Bar::at_least(self.name("z, r.m.s., the control"), measured.z_m, self.reference.z_m / 3.0 / MARGIN, "m"),
            Bar::stated(self.name("horizontal, r.m.s."), measured.horizontal_m, "m"),
            Bar::stated(self.name("velocity, r.m.s."), measured.velocity_m_s, "m/s"),
            Bar::stated(self.name("tilt, r.m.s."), measured.tilt_deg, "°"),
            Bar::stated(self.name("NEES/9"), measured.nees, ""),
        ]
    }
}

/// Errors at the last image of 40 flights for each way to choose landmarks, and without one.
#[test]
#[ignore = "40 flights a row"]
fn accuracy_of_simulated_flights() {
    let flights: Vec<_> = (0..FLIGHTS).into_par_iter().map(|run| fly(&FLIGHT, run)).collect();
    let judged = rows().into_iter().map(|row| match row.selector {
        Selector::None => row.bars_of_the_control(&flights),
        _ => row.bars(&flights),
    });
    check_table("Landing from simulated tracks, at the last image", judged);
}
