//! Small bodies on the adapter: vertices and materials (`body_geometry`), images and maps of albedo (`albedo_map`), and
//! whether the camera would stand inside the body (`enclosure`). `surface` uses it beside `terrain`.

mod albedo_map;
mod body_geometry;
mod enclosure;

pub use body_geometry::BodyGeometry;

#[cfg(test)]
pub use albedo_map::SOURCE;
