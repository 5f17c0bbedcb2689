//! The triangles of one rock: rings of vertices inside its outline, and a skirt from the outline down into the ground.

use crate::scene::Rock;
use nalgebra::Vector2;

/// Triangles lie within this many spacings of the rock.
const CHORD_SPACINGS: f64 = 0.08;
/// The outline's corners are this much more curved than a circle of the rock's radius.
const CORNER_CURVATURE: f64 = 1.6;
/// Fewest vertices around a rock.
const LEAST_SIDES: usize = 6;

/// The grid of a rock's vertices: `sides` around each of `rings` rings, the last one on the outline, one in the middle, and
/// once more the last ring, sunk into the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RockMesh {
    sides: usize,
    rings: usize,
}

impl RockMesh {
    /// For vertices of a spacing in m around.
    pub(super) fn new(rock: &Rock, spacing_m: f64) -> RockMesh {
        let radius_m = 0.5 * rock.diameter_m();
        // A chord of length L leaves a circle of radius R by L²/(8R).
        let chord_m = (8.0 * radius_m / CORNER_CURVATURE * CHORD_SPACINGS * spacing_m).sqrt();
        let sides = (std::f64::consts::TAU * radius_m / chord_m).ceil() as usize;
        // The height 1 - r⁴ bends by 12 r²: rings at equal steps of r² leave it by as much everywhere.
        let step = (CHORD_SPACINGS * spacing_m * 2.0 / (3.0 * rock.height_m().max(1e-9))).sqrt();
        let rings = (0.5 / step).ceil() as usize;
        RockMesh { sides: sides.max(LEAST_SIDES), rings: rings.max(1) }
    }

    /// Places of the vertices in the site frame, m: the middle, the rings from the innermost on. The skirt has those of the
    /// last ring, which are the last `sides` of them.
    pub(super) fn places_m(self, rock: &Rock) -> impl Iterator<Item = Vector2<f64>> {
        let rock = *rock;
        let ring = move |index: usize| {
            let share = (index as f64 / self.rings as f64).sqrt();
            (0..self.sides).map(move |k| {
                let turn = k as f64 + 0.5 * (index % 2) as f64;
                rock.place_m(turn / self.sides as f64 * std::f64::consts::TAU, share)
            })
        };
        std::iter::once(rock.center_m()).chain((1..=self.rings).flat_map(ring))
    }

    /// Vertices around.
    pub(super) fn sides(self) -> usize {
        self.sides
    }

    /// Three vertices a triangle, counter-clockwise from outside; the skirt's vertices follow the others.
    pub(super) fn triangles(self) -> impl Iterator<Item = [u32; 3]> {
        let at = move |ring: usize, k: usize| (1 + (ring - 1) * self.sides + k % self.sides) as u32;
        let top = (0..self.sides).map(move |k| [0, at(1, k), at(1, k + 1)]);
        let between = move |ring: usize| {
            // Every other ring is turned by half a side.
            (0..self.sides).flat_map(move |k| match ring % 2 {
                1 => [
                    [at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)],
                    [at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)],
                ],
                _ => [
                    [at(ring, k), at(ring + 1, k), at(ring, k + 1)],
                    [at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)],
                ],
            })
        };
        let skirt = (0..self.sides).flat_map(move |k| {
            let (a, b) = (at(self.rings, k), at(self.rings, k + 1));
            let (c, d) = (at(self.rings + 1, k), at(self.rings + 1, k + 1));
            [[a, c, b], [b, c, d]]
        });
        top.chain((1..self.rings).flat_map(between)).chain(skirt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Terrain, TerrainConfig};
    use nalgebra::Vector3;
    use std::collections::BTreeMap;

    fn some_rocks() -> Vec<Rock> {
        let terrain = Terrain::new(&TerrainConfig::default(), 5);
        let mut rocks = terrain.rocks_in(&Vector2::new(100.0, 40.0), &Vector2::new(130.0, 80.0), [0.06, 8.0]);
        rocks.truncate(200);
        rocks
    }

    fn raised(rock: &Rock, at_m: Vector2<f64>) -> Vector3<f64> {
        at_m.push(rock.sample(&at_m).height_m)
    }

    /// The most that the middles of sides and triangles lie off the rock, along its normal there, in spacings.
    fn farthest_off(rock: &Rock, mesh: RockMesh, spacing_m: f64) -> f64 {
        let vertices: Vec<_> = mesh.places_m(rock).map(|at_m| raised(rock, at_m)).collect();
        let off_m = |middle: Vector3<f64>| {
            let on_it = rock.sample(&middle.xy());
            (middle.z - on_it.height_m).abs() / on_it.gradient.norm().hypot(1.0)
        };
        let top = mesh.triangles().filter(|t| t.iter().all(|i| (*i as usize) < vertices.len()));
        let of_triangle = |t: [u32; 3]| {
            let [a, b, c] = t.map(|i| vertices[i as usize]);
            [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0].map(off_m).into_iter().fold(0.0, f64::max)
        };
        top.map(of_triangle).fold(0.0, f64::max) / spacing_m
    }

    #[test]
    fn triangles_lie_near_the_rock() {
        let rocks = some_rocks();
        assert!(rocks.len() > 50);
        let (mut far, mut coarse_far) = (0.0_f64, 0.0_f64);
        for (rock, spacings) in rocks.iter().zip([1.0, 2.0, 4.0, 9.0, 20.0, 32.0].into_iter().cycle()) {
            let spacing_m = rock.diameter_m() / spacings;
            let mesh = RockMesh::new(rock, spacing_m);
            far = far.max(farthest_off(rock, mesh, spacing_m));
            let coarse = RockMesh { sides: mesh.sides / 2, rings: mesh.rings.div_ceil(2) };
            coarse_far = coarse_far.max(farthest_off(rock, coarse, spacing_m));
        }
        println!("{far:.3} spacings, {coarse_far:.3} with half the vertices a side");
        assert!(far < 0.15, "a triangle lies {far} spacings off its rock");
        assert!(coarse_far > 0.15, "the check cannot tell half the vertices: {coarse_far}");
    }

    #[test]
    fn a_rock_is_closed_down_to_the_lower_edge_of_its_skirt() {
        for rock in some_rocks().iter().take(20) {
            let mesh = RockMesh::new(rock, 0.3 * rock.diameter_m());
            let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
            for [a, b, c] in mesh.triangles() {
                for [from, to] in [[a, b], [b, c], [c, a]] {
                    *sides.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
                }
            }
            let lower_edge = mesh.places_m(rock).count() as u32;
            let open: Vec<_> = sides.iter().filter(|(_, turns)| **turns != 0).map(|(side, _)| side).collect();
            assert_eq!(open.len(), mesh.sides());
            assert!(open.iter().all(|side| side.iter().all(|v| *v >= lower_edge)), "a hole in the rock: {open:?}");
        }
    }

    #[test]
    fn triangles_turn_counter_clockwise_from_above() {
        for rock in some_rocks().iter().take(50) {
            let mesh = RockMesh::new(rock, 0.2 * rock.diameter_m());
            let places: Vec<_> = mesh.places_m(rock).collect();
            for t in mesh.triangles().filter(|t| t.iter().all(|i| (*i as usize) < places.len())) {
                let [a, b, c] = t.map(|i| places[i as usize]);
                assert!((b - a).perp(&(c - a)) > 0.0, "{t:?} of {mesh:?}");
            }
        }
    }
}
