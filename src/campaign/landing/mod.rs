//! Simulated landings: what a descent would measure, flown through the real filter. Read `options` (what is flown),
//! `simulated_sensors` (the true path, the IMU and the bearings of it), `relief` (the ground's heights), then `flight`,
//! one flight from truth to record; `bound` is the posterior Cramér–Rao bound of the same measurements, and `outcome`
//! flies many and sums up. Only stories, reports and tests use it.

mod bound;
mod flight;
mod options;
mod outcome;
mod relief;
mod simulated_sensors;

pub use flight::{FlightEpoch, FlightRecord, fly};
pub use options::{CampaignOptions, FieldOfView};
pub use outcome::{Campaign, FinalErrors, run_campaign};
pub use simulated_sensors::{StepNoise, TrueState, measured_bearing, true_states, uncertain_start};
