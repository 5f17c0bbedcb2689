//! Meshes from PLY files.

use super::shape::{ShapeFault, ShapeFile};
use super::welder::Welder;
use crate::scene::body::mesh::MeshAlbedo;
use nalgebra::Vector3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Encoding, Header, Property, PropertyAccess, PropertyAccessResult};
use std::io::Cursor;

/// A vertex as the file has it.
struct PlyVertex {
    position: [f64; 3],
    /// Grey value, or red, green and blue, 0 to 1.
    grey: Option<f64>,
    color: [Option<f64>; 3],
}

/// A polygon as the file has it; no corners if their numbers are not whole or negative.
struct PlyFace {
    corners: Vec<u32>,
}

/// Anything else.
struct Skipped;

/// A number of the file; integers as fractions of their range where they stand for a colour.
fn number(property: &Property, is_color: bool) -> Option<f64> {
    let over = |range: f64| if is_color { range } else { 1.0 };
    match property {
        Property::Float(v) => Some(f64::from(*v)),
        Property::Double(v) => Some(*v),
        Property::UChar(v) => Some(f64::from(*v) / over(f64::from(u8::MAX))),
        Property::UShort(v) => Some(f64::from(*v) / over(f64::from(u16::MAX))),
        Property::Char(v) => Some(f64::from(*v)),
        Property::Short(v) => Some(f64::from(*v)),
        Property::Int(v) => Some(f64::from(*v)),
        Property::UInt(v) => Some(f64::from(*v)),
        _ => None,
    }
}

impl PropertyAccess for PlyVertex {
    fn new() -> Self {
        PlyVertex { position: [f64::NAN; 3], grey: None, color: [None; 3] }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let coordinate = number(&property, false).unwrap_or(f64::NAN);
        match name {
            "x" => self.position[0] = coordinate,
            "y" => self.position[1] = coordinate,
            "z" => self.position[2] = coordinate,
            "albedo" | "intensity" | "grey" | "gray" => self.grey = number(&property, true),
            "red" | "r" | "diffuse_red" => self.color[0] = number(&property, true),
            "green" | "g" | "diffuse_green" => self.color[1] = number(&property, true),
            "blue" | "b" | "diffuse_blue" => self.color[2] = number(&property, true),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Skipped
    }
}

impl PropertyAccess for PlyFace {
    fn new() -> Self {
        PlyFace { corners: Vec::new() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.corners = property.to_u32_list().unwrap_or_default();
        PropertyAccessResult::Set
    }
}

impl PlyVertex {
    /// Albedo: the grey value, or the colour's mean.
    fn albedo(&self) -> Option<f64> {
        self.grey.or_else(|| match self.color {
            [Some(red), Some(green), Some(blue)] => Some((red + green + blue) / 3.0),
            _ => None,
        })
    }
}

/// Reads a file in any of the three encodings.
pub(super) fn read(content: &[u8], metres_per_unit: f64) -> Result<ShapeFile, ShapeFault> {
    let mut reader = Reader::new(Cursor::new(content));
    let header = Parser::<Skipped>::new().read_header(&mut reader).map_err(|e| fault(e, true))?;
    let is_text = header.encoding == Encoding::Ascii;
    check_header(&header)?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                let found = Parser::<PlyVertex>::new().read_payload_for_element(&mut reader, element, &header);
                vertices = found.map_err(|e| fault(e, is_text))?;
            }
            "face" => {
                let found = Parser::<PlyFace>::new().read_payload_for_element(&mut reader, element, &header);
                faces = found.map_err(|e| fault(e, is_text))?;
            }
            _ => {
                let skipped = Parser::<Skipped>::new().read_payload_for_element(&mut reader, element, &header);
                skipped.map_err(|e| fault(e, is_text))?;
            }
        }
    }
    assemble(&vertices, &faces, metres_per_unit)
}

/// An error of the parser in one line; a binary file has no lines to name.
fn fault(error: ParseError, is_text: bool) -> ShapeFault {
    let text = error.to_string();
    let text =
        text.strip_prefix("Line ").and_then(|rest| rest.split_once(": ")).map_or(text.as_str(), |(_, rest)| rest);
    let cut = if error.kind() == std::io::ErrorKind::UnexpectedEof { " Is the file cut short?" } else { "" };
    let problem = text.split_whitespace().collect::<Vec<_>>().join(" ") + cut;
    match error.line() {
        Some(line) if is_text => ShapeFault::Line(line, problem),
        _ => ShapeFault::Whole(problem),
    }
}

fn check_header(header: &Header) -> Result<(), ShapeFault> {
    let has = |element: &str, names: &[&str]| {
        let properties = header.elements.get(element).map(|e| &e.properties);
        properties.is_some_and(|p| names.iter().any(|name| p.contains_key(*name)))
    };
    if !["x", "y", "z"].iter().all(|name| has("vertex", &[name])) {
        return Err(ShapeFault::Whole("its header has no element 'vertex' with x, y and z".into()));
    }
    if !has("face", &["vertex_indices", "vertex_index"]) {
        return Err(ShapeFault::Whole("its header has no element 'face' with vertex_indices: it is no mesh".into()));
    }
    Ok(())
}

/// The mesh of the vertices and polygons; numbers of faces and vertices count from 0, as in the file.
fn assemble(vertices: &[PlyVertex], faces: &[PlyFace], metres_per_unit: f64) -> Result<ShapeFile, ShapeFault> {
    let mut welder = Welder::default();
    let mut numbers = Vec::with_capacity(vertices.len());
    let mut albedo = Vec::new();
    for (index, vertex) in vertices.iter().enumerate() {
        if !vertex.position.iter().all(|c| c.is_finite()) {
            return Err(format!("vertex {index} (from 0) has a coordinate that is not a finite number").into());
        }
        let (number, is_new) = welder.vertex(Vector3::from(vertex.position) * metres_per_unit);
        numbers.push(number);
        if is_new {
            albedo.extend(vertex.albedo());
        }
    }
    let mut mesh = welder.mesh;
    for (index, face) in faces.iter().enumerate() {
        let triangles = triangles(&face.corners, &numbers).map_err(|what| format!("face {index} (from 0) {what}"))?;
        mesh.faces.extend(triangles);
    }
    if albedo.len() == mesh.vertices_m.len() {
        mesh.albedo = MeshAlbedo::of_vertices(&albedo);
    }
    Ok(ShapeFile { mesh, texture_corners: None })
}

/// A fan of triangles for a polygon; `numbers` are the mesh's numbers of the file's vertices.
fn triangles(corners: &[u32], numbers: &[u32]) -> Result<Vec<[u32; 3]>, String> {
    if corners.is_empty() {
        return Err("has no corners, or corners with negative numbers".into());
    }
    if corners.len() < 3 {
        return Err(format!("has {} corners, and 3 are needed", corners.len()));
    }
    let corner = |vertex: &u32| {
        let fault = || format!("names vertex {vertex}, and the file has {} (from 0)", numbers.len());
        numbers.get(*vertex as usize).copied().ok_or_else(fault)
    };
    let first = corner(&corners[0])?;
    corners[1..].windows(2).map(|pair| Ok([first, corner(&pair[0])?, corner(&pair[1])?])).collect()
}
