//! Terrain on the adapter. `seen_ground` finds what a view can see, `level_of_detail` how fine it must be, `tile` and
//! `tile_pool` keep patches of it, `vertex_heights` and `octaves` split relief between vertices and shading,
//! `terrain_geometry` draws them all; rocks are meshes of their own (`rocks`, `rock_mesh`, `rock_pages`). Read
//! `terrain_geometry` first.

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
