//! Whether a mesh is the closed surface of a solid.

use super::mesh::Mesh;
use crate::scene::error::SceneError;
use rayon::prelude::*;

impl Mesh {
    /// Checks that every edge joins exactly two faces which run through it in opposite directions.
    ///
    /// # Errors
    /// [`SceneError::NotSolid`] counts the edges at fault and says whether the mesh has holes, flipped faces or edges
    /// with more than two faces.
    pub fn check_closed(&self) -> Result<(), SceneError> {
        let (mut open, mut flipped, mut crowded) = (0, 0, 0);
        for runs in self.sorted_edges().chunk_by(|a, b| a[..2] == b[..2]) {
            match runs {
                [_] => open += 1,
                [one, other] if one[2] == other[2] => flipped += 1,
                [_, _] => {}
                _ => crowded += 1,
            }
        }
        let problem = if open > 0 {
            format!("is open: {open} edges have one face only; close its holes")
        } else if flipped > 0 {
            format!("has flipped faces: at {flipped} edges two faces disagree on which side is outside")
        } else if crowded > 0 {
            format!("is not a surface: {crowded} edges have more than two faces")
        } else {
            return Ok(());
        };
        Err(SceneError::NotSolid { problem })
    }

    /// Number of parts that share no vertex.
    pub fn part_count(&self) -> usize {
        let mut root: Vec<u32> = (0..self.vertices_m.len() as u32).collect();
        let mut joins = 0;
        for &[a, b, c] in &self.faces {
            for other in [b, c] {
                let (one, other) = (find(&mut root, a), find(&mut root, other));
                joins += usize::from(one != other);
                root[one.max(other) as usize] = one.min(other);
            }
        }
        self.vertices_m.len() - joins
    }

    /// Every face's run through its three edges: lower vertex, higher vertex, and whether it runs downwards (1) or
    /// upwards (0). Runs through one edge are neighbours.
    fn sorted_edges(&self) -> Vec<[u32; 3]> {
        let run = |from: u32, to: u32| [from.min(to), from.max(to), u32::from(from > to)];
        let mut runs: Vec<[u32; 3]> =
            self.faces.par_iter().flat_map_iter(|&[a, b, c]| [run(a, b), run(b, c), run(c, a)]).collect();
        runs.par_sort_unstable();
        runs
    }
}

/// Root of a vertex's part; the way there is halved for the next time.
fn find(root: &mut [u32], mut vertex: u32) -> u32 {
    while root[vertex as usize] != vertex {
        let next = root[vertex as usize];
        root[vertex as usize] = root[next as usize];
        vertex = next;
    }
    vertex
}
