//! Tests of the wing `navigation::landing`.

mod accuracy;
mod bearings;
mod biases;
pub mod chart;
mod delayed;
pub mod descent;
mod designated;
mod error_state;
mod flight;
mod flown;
mod from_pixels;
mod image_rotation;
mod in_place;
mod map;
mod monte_carlo;
mod outages;
mod reference_run;
mod refusals;
mod speed;
mod wrong_point;
