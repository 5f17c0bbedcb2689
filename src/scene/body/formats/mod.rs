//! Shape files: OBJ, PLY, STL, and the shape that each is read into.

mod obj;
mod ply;
mod read;
mod shape;
mod stl;
mod welder;

pub use shape::ShapeFile;
