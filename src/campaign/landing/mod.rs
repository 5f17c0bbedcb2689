//! Simulated landings: ground, sensors, one flight, its posterior Cramér–Rao bound, and what a campaign of them shows.

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
