//! Triangle meshes: topology, rays, mass properties, landmarks, albedo.

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
