//! Monte Carlo campaigns of simulated landings: a flight draws the truth, the inertial measurements and the bearings and
//! lets the landing filter navigate by them, beside the posterior Cramér–Rao bound of the same flight; a campaign flies
//! many and tells what they have in common.

mod bound;
mod flight;
mod ground;
mod options;
mod outcome;
mod sensors;

pub use flight::{FlightEpoch, FlightRecord, fly};
pub use options::{CampaignOptions, FieldOfView};
pub use outcome::{Campaign, FinalErrors, run_campaign};
pub use sensors::{TrueState, true_states};
