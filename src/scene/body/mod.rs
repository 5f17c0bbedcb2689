//! Small bodies: triangle meshes with their mass properties, shapes from files or from a seed, and how the surface looks.
//!
//! A [`Mesh`] is what everything works on, in asteroid axes and metres. [`BodySource`] says where it comes from: a shape
//! file ([`MeshFile`]) or a seed ([`ProceduralBody`]). [`MassProperties`] are exact for the polyhedron. [`SmallBody`] is
//! the mesh with its [`BodySurface`], ready to be drawn.

mod crater;
mod icosphere;
mod mass_properties;
mod mesh;
mod mesh_landmarks;
mod mesh_topology;
mod obj;
mod procedural;
mod relief;
mod source;
mod surface;

pub(super) use mass_properties::principal_moments;

pub use mass_properties::MassProperties;
pub use mesh::Mesh;
pub use procedural::ProceduralBody;
pub use source::{BodySource, MeshFile};
pub use surface::{BodySurface, SmallBody, SurfaceConfig};
