//! Shape files: OBJ, PLY and STL, each read into the same plain `shape` with its textures; `read` chooses by extension,
//! `welder` joins the corners of formats that repeat them. Errors name file and line. `mesh_file` makes a mesh of the
//! shape.

mod obj;
mod ply;
mod read;
mod shape;
mod stl;
mod welder;

pub use shape::ShapeFile;
