//! What an arc of observations can tell at best: Lie derivatives, Fisher information, directions that stay undetermined.

mod arc_bound;
mod determinacy;
mod lie_derivatives;

pub use arc_bound::{ArcBound, ArcDesign, arc_bound, planned_pairs};
pub use determinacy::{
    INERTIA_UNIT, UndeterminedDirection, determined_elements, projector, undetermined_directions, weak_ratios,
};
pub use lie_derivatives::lie_derivatives;
