//! Meshes from Wavefront OBJ files.

use super::Mesh;
use crate::scene::{SceneError, limits};
use nalgebra::Vector3;
use std::collections::HashMap;
use std::path::Path;

impl Mesh {
    /// Reads an OBJ file. All groups make one mesh, polygons are cut into triangles, and vertices at one place become
    /// one; normals, textures and materials are left out.
    ///
    /// # Errors
    /// Names the file, and the line where there is one, of: a missing file, a line cut short, a coordinate that is not
    /// a finite number, a face that names a vertex that is not there, no faces at all, faces of zero area.
    pub fn read_obj(path: &Path, metres_per_unit: f64) -> Result<Mesh, SceneError> {
        limits::positive("metres_per_unit", metres_per_unit).map_err(|e| e.in_file(path))?;
        let text = std::fs::read_to_string(path).map_err(|source| SceneError::Io {
            action: "read the shape",
            path: path.into(),
            source,
        })?;
        check_lines(&text).map_err(|(line, problem)| SceneError::Malformed {
            path: path.into(),
            line: line as u64,
            problem,
        })?;
        let unusable = |problem: String| SceneError::Unusable { path: path.into(), problem };
        let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
        let no_material = |_: &Path| Ok((Vec::new(), Default::default()));
        let (models, _) =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, no_material).map_err(|e| unusable(e.to_string()))?;
        let mesh = joined(&models, metres_per_unit);
        if let flat @ [first, ..] = mesh.zero_area_faces().as_slice() {
            let problem = format!(
                "{} faces have no area, the first is face {}: remove them with a mesh editor",
                flat.len(),
                first + 1
            );
            return Err(unusable(problem));
        }
        Ok(mesh)
    }
}

/// Checks vertices and faces line by line; the error is a line number from 1 and what is wrong there.
fn check_lines(text: &str) -> Result<(), (usize, String)> {
    let mut vertices = 0_i64;
    let mut faces = 0;
    let mut highest = (0_i64, 0_usize); // largest vertex number, and its line
    for (index, line) in text.lines().enumerate() {
        let fault = |problem: String| (index + 1, problem);
        let mut fields = line.split_whitespace();
        match fields.next() {
            Some("v") => {
                check_vertex(&fields.collect::<Vec<_>>()).map_err(fault)?;
                vertices += 1;
            }
            Some("f") => {
                let numbers = face_numbers(&fields.collect::<Vec<_>>(), vertices).map_err(fault)?;
                let largest = numbers.into_iter().max().unwrap_or(0);
                highest = highest.max((largest, index + 1));
                faces += 1;
            }
            _ => {}
        }
    }
    if faces == 0 {
        return Err((text.lines().count().max(1), "the file ends without a face: is it cut short?".into()));
    }
    if highest.0 > vertices {
        return Err((highest.1, format!("a face names vertex {}, and the file has {vertices}", highest.0)));
    }
    Ok(())
}

fn check_vertex(fields: &[&str]) -> Result<(), String> {
    if fields.len() < 3 {
        return Err(format!("a vertex has {} coordinates instead of 3: is the file cut short?", fields.len()));
    }
    for field in &fields[..3] {
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() => {}
            _ => return Err(format!("the coordinate '{field}' is not a finite number")),
        }
    }
    Ok(())
}

/// Vertex numbers of a face from 1; negative ones in the file count back from the last vertex so far.
fn face_numbers(fields: &[&str], vertices: i64) -> Result<Vec<i64>, String> {
    if fields.len() < 3 {
        return Err(format!("a face has {} corners, and 3 are needed: is the file cut short?", fields.len()));
    }
    let number = |field: &&str| {
        let text = field.split('/').next().unwrap_or_default();
        let number = text.parse::<i64>().map_err(|_| format!("'{field}' is not a corner of a face"))?;
        let absolute = if number < 0 { vertices.saturating_add(number).saturating_add(1) } else { number };
        if absolute < 1 {
            return Err(format!("a face names vertex {number}, which does not exist: numbers start from 1"));
        }
        Ok(absolute)
    };
    fields.iter().map(number).collect()
}

/// All models in one mesh, with one vertex a place.
fn joined(models: &[tobj::Model], metres_per_unit: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let mut number_at: HashMap<[u64; 3], u32> = HashMap::new();
    for model in models {
        let vertex = |position: &[f64]| {
            let point = Vector3::from_column_slice(position) * metres_per_unit;
            let place = [point.x, point.y, point.z].map(|c| (c + 0.0).to_bits()); // + 0.0 makes -0 and 0 one place
            *number_at.entry(place).or_insert_with(|| {
                mesh.vertices_m.push(point);
                (mesh.vertices_m.len() - 1) as u32
            })
        };
        let numbers: Vec<u32> = model.mesh.positions.chunks_exact(3).map(vertex).collect();
        let corners = model.mesh.indices.chunks_exact(3);
        mesh.faces.extend(corners.map(|c| [c[0], c[1], c[2]].map(|i| numbers[i as usize])));
    }
    mesh
}
