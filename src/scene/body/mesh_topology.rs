//! Whether a mesh is the closed surface of a solid.

use super::Mesh;
use crate::scene::SceneError;
use std::collections::HashMap;

impl Mesh {
    /// Checks that every edge joins exactly two faces which run through it in opposite directions.
    ///
    /// # Errors
    /// [`SceneError::NotSolid`] counts the edges at fault and says whether the mesh has holes, flipped faces or edges
    /// with more than two faces.
    pub fn check_closed(&self) -> Result<(), SceneError> {
        let mut runs: HashMap<(u32, u32), (u32, u32)> = HashMap::with_capacity(self.faces.len() * 2);
        for &[a, b, c] in &self.faces {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (forward, backward) = runs.entry((from.min(to), from.max(to))).or_default();
                *(if from < to { forward } else { backward }) += 1;
            }
        }
        let count = |fault: fn(u32, u32) -> bool| runs.values().filter(|(f, b)| fault(*f, *b)).count();
        let open = count(|f, b| f + b == 1);
        let flipped = count(|f, b| f + b == 2 && f != b);
        let crowded = count(|f, b| f + b > 2);
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
}
