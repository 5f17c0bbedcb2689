//! Bodies grown from a seed: an `icosphere` moved by `relief` and `crater`s, with `boulder`s sunk into it; `build`
//! joins them in this order. The same seed gives the same body.

mod boulder;
mod build;
mod crater;
mod icosphere;
mod relief;

pub use build::ProceduralBody;
