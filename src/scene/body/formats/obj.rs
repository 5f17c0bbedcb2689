//! Meshes from Wavefront OBJ files.

use super::shape::{ShapeFault, ShapeFile};
use super::welder::Welder;
use nalgebra::Vector3;
use std::path::Path;

/// Reads a file. All groups make one mesh; normals and materials are left out, texture coordinates are kept if every
/// face has them.
pub(super) fn read(content: &[u8], metres_per_unit: f64) -> Result<ShapeFile, ShapeFault> {
    let text = std::str::from_utf8(content).map_err(|e| {
        let line = 1 + content[..e.valid_up_to()].iter().filter(|byte| **byte == b'\n').count();
        ShapeFault::Line(line, "it is no text: is the file damaged?".into())
    })?;
    check_lines(text).map_err(|(line, problem)| ShapeFault::Line(line, problem))?;
    let options =
        tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..Default::default() };
    let no_material = |_: &Path| Ok((Vec::new(), Default::default()));
    let mut bytes = content;
    let (models, _) = tobj::load_obj_buf(&mut bytes, &options, no_material).map_err(|e| e.to_string())?;
    joined(&models, metres_per_unit)
}

/// Checks vertices and faces line by line; the error is a line number from 1 and what is wrong there.
fn check_lines(text: &str) -> Result<(), (usize, String)> {
    let (mut vertices, mut textures, mut normals) = (0_i64, 0_i64, 0_i64);
    let mut faces = 0;
    let mut highest = (0_i64, 0_usize); // largest vertex number, and its line
    for (index, line) in text.lines().enumerate() {
        let fault = |problem: String| (index + 1, problem);
        let mut fields = line.split_whitespace();
        match fields.next() {
            Some("v") => {
                check_vertex(fields).map_err(fault)?;
                vertices += 1;
            }
            Some("vt") => textures += 1,
            Some("vn") => normals += 1,
            Some("f") => {
                let counts = [vertices, textures, normals];
                highest = highest.max((largest_number(fields, counts).map_err(fault)?, index + 1));
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

fn check_vertex<'a>(fields: impl Iterator<Item = &'a str>) -> Result<(), String> {
    let mut count = 0;
    for field in fields.take(3) {
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() => count += 1,
            _ => return Err(format!("the coordinate '{field}' is not a finite number")),
        }
    }
    match count {
        3 => Ok(()),
        _ => Err(format!("a vertex has {count} coordinates instead of 3: is the file cut short?")),
    }
}

/// Largest vertex number of a face, from 1; negative ones in the file count back from the last so far, of which there are
/// `vertices`, `textures` and `normals`.
fn largest_number<'a>(
    fields: impl Iterator<Item = &'a str>,
    [vertices, textures, normals]: [i64; 3],
) -> Result<i64, String> {
    let (mut count, mut largest) = (0, 0);
    for field in fields {
        let mut numbers = field.split('/');
        let fault = || format!("'{field}' is not a corner of a face");
        let number = numbers.next().and_then(|text| text.parse::<i64>().ok()).ok_or_else(fault)?;
        // The numbers of texture coordinates and normals, either of which may be left out.
        let exists = |text: &str, count: i64| text.parse::<i32>().is_ok_and(|n| count + i64::from(n) >= 0);
        let mut others = numbers.zip([textures, normals]);
        if !others.all(|(text, count)| text.is_empty() || exists(text, count)) {
            return Err(fault());
        }
        let absolute = if number < 0 { vertices.saturating_add(number).saturating_add(1) } else { number };
        if absolute < 1 {
            return Err(format!("a face names vertex {number}, which does not exist: numbers start from 1"));
        }
        largest = largest.max(absolute);
        count += 1;
    }
    match count {
        0..3 => Err(format!("a face has {count} corners, and 3 are needed: is the file cut short?")),
        _ => Ok(largest),
    }
}

/// All models in one mesh.
fn joined(models: &[tobj::Model], metres_per_unit: f64) -> Result<ShapeFile, ShapeFault> {
    let mut welder = Welder::default();
    let mut texture_corners = Vec::new();
    for tobj::Model { mesh, .. } in models {
        let vertex = |position: &[f64]| welder.vertex(Vector3::from_column_slice(position) * metres_per_unit).0;
        let numbers: Vec<u32> = mesh.positions.chunks_exact(3).map(vertex).collect();
        let corners = mesh.indices.chunks_exact(3);
        welder.mesh.faces.extend(corners.map(|c| [c[0], c[1], c[2]].map(|i| numbers[i as usize])));
        let textures = mesh.texcoord_indices.chunks_exact(3);
        let texture = |i: u32| [0, 1].map(|axis| mesh.texcoords[2 * i as usize + axis] as f32);
        texture_corners.extend(textures.map(|c| [c[0], c[1], c[2]].map(texture)));
    }
    if !texture_corners.iter().flatten().flatten().all(|c| c.is_finite()) {
        return Err(ShapeFault::Whole("a texture coordinate (vt) is not a finite number".into()));
    }
    let complete = texture_corners.len() == welder.mesh.faces.len();
    Ok(ShapeFile { mesh: welder.mesh, texture_corners: complete.then_some(texture_corners) })
}
