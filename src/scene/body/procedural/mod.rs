//! Bodies made of nothing: relief, craters and boulders on an icosphere.

mod boulder;
mod build;
mod crater;
mod icosphere;
mod relief;

pub use build::ProceduralBody;
