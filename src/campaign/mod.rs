//! Monte Carlo campaigns of simulated landings: a flight draws the truth, the inertial measurements and the bearings and
//! lets the landing filter navigate by them, beside the posterior Cramér–Rao bound of the same flight; a campaign flies
//! many and tells what they have in common.

mod landing;

pub use landing::{
    Campaign, CampaignOptions, FieldOfView, FinalErrors, FlightEpoch, FlightRecord, StepNoise, TrueState, fly,
    measured_bearing, run_campaign, true_states, uncertain_start,
};
