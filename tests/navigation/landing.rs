//! Tests of the wing `navigation::landing`.

pub mod descent;
mod extras;
mod flight;
mod in_place;
mod linear;
mod monte_carlo;
mod pixels;
mod speed;
mod wrong_point;
