//! What lies on the ground: `crater`, `rock`, `hummock`, `ripple` and geological `unit`, each a class with its law of
//! sizes and one shape; `scatter` strews a class reproducibly over cells, `bins` and `classes` find what is near a
//! place, `softened` and `site_taper` fade it. A new kind of feature is a file here and a line in `classes`.

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
