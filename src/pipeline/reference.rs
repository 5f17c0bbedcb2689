//! The types of a scenario to the reference of its keys.

use crate::report;
use crate::scene::Scenario;

/// Every key of a scenario with its type, unit, default and meaning, in Markdown.
pub fn scenario_reference() -> String {
    report::scenario_reference(&Scenario::schema())
}
