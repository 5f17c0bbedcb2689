//! Terrain on the adapter: tiles with levels of detail, their pool, rocks as meshes of their own.

mod level_of_detail;
mod octaves;
mod pipelines;
mod rock_mesh;
mod rock_pages;
mod rocks;
mod seen_ground;
mod terrain_geometry;
mod tile;
mod tile_pool;
mod vertex_heights;

pub use level_of_detail::LevelRange;
pub use octaves::ShadedWavelengths;
pub use seen_ground::SeenGround;
pub use terrain_geometry::TerrainGeometry;
