//! Tests of the room `navigation::landing`.

#[path = "landing/campaign.rs"]
mod campaign;
#[path = "landing/descent.rs"]
mod descent;
#[path = "landing/extras.rs"]
mod extras;
#[path = "landing/flight.rs"]
mod flight;
#[path = "landing/in_place.rs"]
mod in_place;
#[path = "landing/linear.rs"]
mod linear;
#[path = "landing/monte_carlo.rs"]
mod monte_carlo;
#[path = "landing/pixels.rs"]
mod pixels;
#[path = "landing/speed.rs"]
mod speed;
#[path = "landing/wrong_point.rs"]
mod wrong_point;
