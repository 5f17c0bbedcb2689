//! The ground: relief and features over a plane or a measured base. `config` is its table, `terrain` the ground with
//! heights, normals and albedo at any place and fineness; `relief` sums octaves, `features` lie on it, `measured_base`
//! and `on_base` put it on an elevation model, `ray` and `patch` are what views ask of it. The renderer draws what this
//! wing says.

mod config;
mod features;
mod measured_base;
mod on_base;
mod patch;
mod ray;
mod relief;
mod rocks;
mod terrain;

pub use config::TerrainConfig;
pub use features::{
    CraterClass, Feature, HummockClass, RippleClass, Rock, RockClass, Scatter, UnitClass, rock_density_1_m2,
};
pub use measured_base::GroundBase;
pub use patch::TerrainPatch;
pub use relief::{FeatureSample, GroundDetail, GroundSample};
pub use terrain::Terrain;
