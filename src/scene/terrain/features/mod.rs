//! What lies on the ground: craters, rocks, hummocks, ripples, units, and how they are scattered.

mod bins;
mod classes;
mod crater;
mod hummock;
mod ripple;
mod rock;
mod scatter;
mod site_taper;
mod sizes;
mod softened;
mod unit;

pub use bins::Bins;
pub use classes::TerrainFeatures;
pub use crater::{Crater, CraterClass};
pub use hummock::{Hummock, HummockClass};
pub use ripple::{RippleClass, RippleTables};
pub use rock::{Rock, RockClass, rock_density_1_m2};
pub use scatter::{Feature, Scatter};
pub use softened::Softened;
pub use unit::UnitClass;
