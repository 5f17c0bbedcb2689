//! Small bodies: triangle meshes with their mass properties, shapes from files or from a seed, and how the surface looks.
//!
//! A [`Mesh`] is what everything works on, in asteroid axes and metres. [`BodySource`] says where it comes from: a shape
//! file ([`MeshFile`]) or a seed ([`ProceduralBody`]). [`MassProperties`] are exact for the polyhedron. [`SmallBody`] is
//! the mesh with its [`BodySurface`], ready to be drawn.

mod albedo_image;
mod albedo_map;
mod boulder;
mod crater;
mod icosphere;
mod mass_properties;
mod mesh;
mod mesh_albedo;
mod mesh_file;
mod mesh_landmarks;
mod mesh_ray;
mod mesh_topology;
mod obj;
mod ply;
mod procedural;
mod relief;
mod shape_file;
mod source;
mod stl;
mod surface;
mod welder;

pub(super) use mass_properties::principal_moments;

pub use albedo_image::{AlbedoImage, PictureEdge};
pub use albedo_map::AlbedoMapFile;
pub use mass_properties::MassProperties;
pub use mesh::Mesh;
pub use mesh_albedo::{GlobeMap, MeshAlbedo};
pub use mesh_file::{LengthUnit, MeshFile};
pub use procedural::ProceduralBody;
pub use source::BodySource;
pub use surface::{BodySurface, SmallBody, SurfaceConfig};
