//! Tests of the room `navigation::landing`.

#[path = "landing/descent.rs"]
mod descent;
#[path = "landing/flight.rs"]
mod flight;
#[path = "landing/linear.rs"]
mod linear;
#[path = "landing/monte_carlo.rs"]
mod monte_carlo;
#[path = "landing/pixels.rs"]
mod pixels;
