//! Innovation gate.

use crate::stats::ConsistencyBounds;

/// Accepts innovations that a consistent filter would see with probability `confidence`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gate {
    /// Probability that a good measurement passes, in (0, 1).
    pub confidence: f64,
}

impl Gate {
    /// Whether a normalised innovation squared of so many degrees of freedom passes the χ² test
    /// (Bar-Shalom, Li, Kirubarajan 2001, section 5.4).
    pub fn passes(&self, normalized_innovation_squared: f64, degrees_of_freedom: usize) -> bool {
        normalized_innovation_squared <= ConsistencyBounds::gate(degrees_of_freedom, self.confidence)
    }
}
