//! What the flights of a campaign have in common.

use super::flight::{FlightEpoch, FlightRecord, fly};
use super::options::CampaignOptions;
use crate::evaluation::{EvaluationError, root_mean_square};
use rayon::prelude::*;
use serde::Serialize;

/// The flights of a campaign, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Campaign {
    /// What was flown.
    pub options: CampaignOptions,
    /// One record a flight.
    pub flights: Vec<FlightRecord>,
}

/// Errors at touchdown over all flights, as 3 r.m.s. an axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FinalErrors {
    /// Flights that converged: horizontal below 1 m, z below 40 m, speed below 0.5 m/s, roll and pitch below 0.1°.
    pub converged: usize,
    /// Flights flown.
    pub runs: usize,
    /// Horizontal, an axis, m.
    pub horizontal_m: f64,
    /// Vertical, m.
    pub z_m: f64,
    /// Vertical by the filter's own covariance, m.
    pub z_believed_m: f64,
    /// Velocity, an axis, m/s.
    pub velocity_m_s: f64,
    /// Tilt about the site's x axis, °.
    pub roll_deg: f64,
    /// Tilt about the site's y axis, °.
    pub pitch_deg: f64,
    /// Mean over 30 to 182 s of the runs' mean NEES / 9.
    pub nees: f64,
}

/// Flies a campaign, `progress` hearing of each flight. The result does not depend on the number of threads.
///
/// # Errors
/// [`EvaluationError::OutOfRange`] for an option out of range.
pub fn run_campaign(options: &CampaignOptions, progress: &(dyn Fn() + Sync)) -> Result<Campaign, EvaluationError> {
    options.validate()?;
    let flown = |run: u64| {
        let record = fly(options, run);
        progress();
        record
    };
    let flights = (0..options.runs).into_par_iter().map(flown).collect();
    Ok(Campaign { options: options.clone(), flights })
}

impl FlightRecord {
    /// Whether the flight landed as it should.
    pub fn converged(&self) -> bool {
        let Some(end) = self.epochs.last().filter(|_| self.complete) else { return false };
        let e = &end.error;
        let tilt = 0.1f64.to_radians();
        e.fixed_rows::<2>(0).norm() < 1.0
            && e[2].abs() < 40.0
            && e.fixed_rows::<3>(3).norm() < 0.5
            && e[6].abs() < tilt
            && e[7].abs() < tilt
    }
}

impl Campaign {
    /// Seconds of a flight, the first and the last included.
    pub fn seconds(&self) -> usize {
        self.flights.iter().map(|f| f.epochs.len()).max().unwrap_or(0)
    }

    /// The epochs of one second, of the flights that came that far.
    pub fn at(&self, second: usize) -> impl Iterator<Item = &FlightEpoch> {
        self.flights.iter().filter_map(move |f| f.epochs.get(second))
    }

    /// Root mean square error of a component at a second.
    pub fn rms(&self, second: usize, component: usize) -> f64 {
        root_mean_square(self.at(second).map(|e| e.error[component])).unwrap_or(f64::NAN)
    }

    /// Root mean square of the filter's 1σ of a component at a second.
    pub fn believed(&self, second: usize, component: usize) -> f64 {
        root_mean_square(self.at(second).map(|e| e.sigma[component])).unwrap_or(f64::NAN)
    }

    /// Root mean square of the Cramér–Rao bound of a component at a second.
    pub fn bound(&self, second: usize, component: usize) -> f64 {
        root_mean_square(self.at(second).map(|e| e.bound[component])).unwrap_or(f64::NAN)
    }

    /// Mean over the flights of NEES / 9 at a second.
    pub fn nees(&self, second: usize) -> f64 {
        mean(self.at(second).map(|e| e.nees))
    }

    /// Mean of the normalised innovation squared over its degrees of freedom, over all images of the seconds.
    pub fn nis(&self, seconds: std::ops::RangeInclusive<usize>) -> f64 {
        let (mut sum, mut dof) = (0.0, 0);
        for epoch in seconds.flat_map(|second| self.at(second)) {
            if let Some(nis) = epoch.nis {
                sum += nis * epoch.nis_dof as f64;
                dof += epoch.nis_dof;
            }
        }
        sum / dof as f64
    }

    /// Number of flights that converged.
    pub fn converged(&self) -> usize {
        self.flights.iter().filter(|f| f.converged()).count()
    }

    /// Errors at touchdown.
    pub fn final_errors(&self) -> FinalErrors {
        let end = self.seconds().saturating_sub(1);
        let axis = |components: &[usize]| {
            3.0 * root_mean_square(components.iter().map(|c| self.rms(end, *c))).unwrap_or(f64::NAN)
        };
        FinalErrors {
            converged: self.converged(),
            runs: self.flights.len(),
            horizontal_m: axis(&[0, 1]),
            z_m: axis(&[2]),
            z_believed_m: 3.0 * self.believed(end, 2),
            velocity_m_s: axis(&[3, 4, 5]),
            roll_deg: axis(&[6]).to_degrees(),
            pitch_deg: axis(&[7]).to_degrees(),
            nees: mean((30..=182.min(end)).map(|second| self.nees(second))),
        }
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}
