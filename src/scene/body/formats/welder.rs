//! Puts a mesh together with one vertex a place.

use crate::scene::body::mesh::Mesh;
use nalgebra::Vector3;
use std::collections::HashMap;

/// A mesh in the making: vertices at exactly one place become one, as formats without shared vertices need it.
#[derive(Default)]
pub(super) struct Welder {
    pub mesh: Mesh,
    number_at: HashMap<[u64; 3], u32>,
}

impl Welder {
    /// Number of the vertex at a point, and whether it is new.
    pub fn vertex(&mut self, point_m: Vector3<f64>) -> (u32, bool) {
        let place = [point_m.x, point_m.y, point_m.z].map(|c| (c + 0.0).to_bits()); // + 0.0 makes -0 and 0 one place
        let next = self.mesh.vertices_m.len() as u32;
        let number = *self.number_at.entry(place).or_insert(next);
        if number == next {
            self.mesh.vertices_m.push(point_m);
        }
        (number, number == next)
    }
}
