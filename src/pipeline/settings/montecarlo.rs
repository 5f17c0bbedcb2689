//! Settings of campaigns.

use crate::campaign::CampaignOptions;
use crate::navigation::landmark::Selector;
use crate::settings::{OutOfRange, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Settings of `opnav montecarlo landing`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MonteCarloSettings {
    /// One campaign for each, instead of one with the filter's selector (default: none).
    pub selectors: Vec<Selector>,
    /// What every campaign has in common.
    pub campaign: CampaignOptions,
}

impl Settings for MonteCarloSettings {
    fn validate(&self) -> Result<(), OutOfRange> {
        self.campaign.validate().map_err(|e| e.under("campaign"))
    }
}
