//! Estimators: one wing a mission ([`landing`], [`tumbling`]), and three that know no spacecraft and serve both:
//! [`filter`] (corrections and gates), [`landmark`] (which point of the ground tells most) and [`observability`] (what
//! can be told at all). They see observations and inertial measurements, never images, scenes or the truth. Each
//! mission has one short `step` or `estimate` to begin reading at.

pub mod filter;
pub mod landing;
pub mod landmark;
pub mod observability;
pub mod tumbling;

pub use landing::{correct, predict};
