//! Small bodies on the adapter: vertices, albedo, and what hides what.

mod albedo_map;
mod body_geometry;
mod enclosure;

pub use body_geometry::BodyGeometry;

#[cfg(test)]
pub use albedo_map::SOURCE;
