//! Meshes from STL files.

use super::shape::{ShapeFault, ShapeFile};
use super::welder::Welder;
use nalgebra::Vector3;
use std::io::{Cursor, ErrorKind};

const HEADER_BYTES: usize = 84;
const FACE_BYTES: usize = 50;

/// Whether the length is that of a binary file with as many faces as it says. Some programs start binary files with
/// the word that should mark text, so the length decides.
pub(super) fn is_binary(content: &[u8]) -> bool {
    said_faces(content).is_some_and(|faces| content.len() == HEADER_BYTES + FACE_BYTES * faces)
}

fn said_faces(content: &[u8]) -> Option<usize> {
    let count = content.get(HEADER_BYTES - 4..HEADER_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().expect("four bytes")) as usize)
}

/// Reads a binary or ASCII file; its unconnected triangles are welded.
pub(super) fn read(mut content: Vec<u8>, metres_per_unit: f64) -> Result<ShapeFile, ShapeFault> {
    let is_binary = is_binary(&content);
    if is_binary {
        content[0] = b'b'; // nothing that starts with the mark of a text file
    } else if content.starts_with(b"solid") {
        content.insert(5, b' '); // a solid without a name need not have this space
    } else {
        return Err(ShapeFault::Whole(no_stl(&content)));
    }
    let mut reader = Cursor::new(content);
    let triangles = stl_io::create_stl_reader(&mut reader).map_err(|e| e.to_string())?;
    let mut welder = Welder::default();
    for (index, triangle) in triangles.enumerate() {
        let face = index + 1;
        let triangle = triangle.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => format!("the file ends within face {face}: is it cut short?"),
            _ => format!("face {face}: {error}"),
        })?;
        let corners = triangle.vertices.map(|v| Vector3::from(v.0).map(f64::from));
        if !corners.iter().flatten().all(|c| c.is_finite()) {
            return Err(ShapeFault::Whole(format!("face {face} has a coordinate that is not a finite number")));
        }
        let numbers = corners.map(|corner| welder.vertex(corner * metres_per_unit).0);
        welder.mesh.faces.push(numbers);
    }
    Ok(ShapeFile { mesh: welder.mesh, texture_corners: None })
}

fn no_stl(content: &[u8]) -> String {
    match said_faces(content) {
        Some(faces) => format!(
            "it is no STL file: it does not start with 'solid', and a binary file of {faces} faces has {} bytes instead of \
             {}: is it cut short?",
            HEADER_BYTES.saturating_add(FACE_BYTES.saturating_mul(faces)),
            content.len()
        ),
        None => "it is no STL file: it is shorter than the header of one".into(),
    }
}
