//! Small bodies: triangle meshes with their mass properties, shapes from files or from a seed, and how the surface looks.
//!
//! A [`Mesh`] is what everything works on, in asteroid axes and metres. [`BodySource`] says where it comes from: a shape
//! file ([`MeshFile`]) or a seed ([`ProceduralBody`]). [`MassProperties`] are exact for the polyhedron. [`SmallBody`] is
//! the mesh with its [`BodySurface`], ready to be drawn.

mod formats;
mod mesh;
mod mesh_file;
mod procedural;
mod source;
mod surface;

pub use mesh::{AlbedoImage, AlbedoMapFile, GlobeMap, ImageEdge, MassProperties, Mesh, MeshAlbedo, principal_moments};
pub use mesh_file::{LengthUnit, MeshFile};
pub use procedural::ProceduralBody;
pub use source::BodySource;
pub use surface::{BodySurface, SmallBody, SurfaceConfig};
