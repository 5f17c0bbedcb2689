//! What an arc of observations can tell at best. `lie_derivatives` gives the rank of observability order by order,
//! `arc_bound` the Cramér–Rao bound of a planned arc, `determinacy` the directions of the inertia that a motion leaves
//! undetermined, which the shooting holds fixed instead of inventing.

mod arc_bound;
mod determinacy;
mod lie_derivatives;

pub use arc_bound::{ArcBound, ArcDesign, arc_bound, planned_pairs};
pub use determinacy::{
    INERTIA_UNIT, UndeterminedDirection, determined_elements, projector, undetermined_directions, weak_ratios,
};
pub use lie_derivatives::lie_derivatives;
