//! Triangle meshes: the `mesh` itself, whether it is closed (`topology`), rays (`ray`), volume and inertia
//! (`mass_properties`), points on it (`landmarks`), and albedo by vertex, texture or map (`albedo*`). Procedural bodies
//! and shape files end here; the renderer draws it.

mod albedo;
mod albedo_image;
mod albedo_map;
mod landmarks;
mod mass_properties;
mod mesh;
mod ray;
mod topology;

pub use albedo::{GlobeMap, MeshAlbedo};
pub use albedo_image::{AlbedoImage, ImageEdge};
pub use albedo_map::AlbedoMapFile;
pub use mass_properties::{MassProperties, principal_moments};
pub use mesh::Mesh;
