//! Can a quantity be seen at all, and how well at best? Criteria that know no spacecraft.
//!
//! [`rank_by_order`] answers the first question from the Taylor coefficients of a measurement (the Lie derivatives of
//! Hermann and Krener 1977); [`FisherInformation`] answers the second for one arc of noisy measurements (Cramér–Rao).
//! Rank alone is no criterion for a product: a direction may be observable and still take years to see.

mod fisher;
mod rank;

pub use fisher::{FisherInformation, WeakDirection};
pub use rank::{ObservabilityRank, RELATIVE_RANK_TOLERANCE, rank_by_order};
