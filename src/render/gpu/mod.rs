//! The adapter and what every pass shares: `device` chooses and opens it, `targets` are what is drawn into,
//! `geometry_pass` draws any geometry with any role, `uniforms` lays numbers out as the shaders read them, `read_back`
//! fetches images, `timing` measures. Nothing here knows ground, body or lens; all other wings of the room stand on it.

#[cfg(test)]
mod compute_twin;
mod device;
mod geometry_pass;
mod read_back;
mod targets;
mod timing;
mod uniforms;

#[cfg(test)]
pub use compute_twin::Twin;
pub use device::{AdapterReport, Gpu, list_adapters};
pub use geometry_pass::{DEPTH_FORMAT, GeometryKind, GeometryPipelines, Role, buffer, storage_entry, uniform_entry};
pub use read_back::ReadBack;
pub use targets::{SampleTarget, cleared, texture};
pub use timing::{StageTime, submit_timed};
pub use uniforms::{
    AlbedoMap, BodyVertex, Geometry, OCTAVES, Octave, PaintedVertex, Photometry, Shading, Tile, columns, dropped, four,
};
