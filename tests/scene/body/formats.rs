//! Shape files in every format, and what is wrong with bad ones.

use nalgebra::Vector3;
use opnav::scene::{Mesh, MeshAlbedo};
use std::fmt::Write as _;
use std::path::PathBuf;

/// A closed body whose coordinates are exact in f32, so that every format holds the same one.
fn body() -> Mesh {
    let mut mesh = Mesh::icosphere(2);
    mesh.vertices_m.iter_mut().for_each(|v| *v = (*v * 100.0).component_mul(&Vector3::new(3.0, 2.0, 1.5)).map(rounded));
    mesh
}

fn rounded(value: f64) -> f64 {
    f64::from(value as f32)
}

fn obj(mesh: &Mesh) -> Vec<u8> {
    let mut text = String::new();
    for v in &mesh.vertices_m {
        writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
    }
    for [a, b, c] in &mesh.faces {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
    }
    text.into_bytes()
}

const PLY_PROPERTIES: &str = "property float x\nproperty float y\nproperty float z\n";

fn ply_header(mesh: &Mesh, format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a test\nelement vertex {}\n{PLY_PROPERTIES}element face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        mesh.vertices_m.len(),
        mesh.faces.len()
    )
}

fn ascii_ply(mesh: &Mesh) -> Vec<u8> {
    let mut text = ply_header(mesh, "ascii");
    for v in &mesh.vertices_m {
        writeln!(text, "{} {} {}", v.x, v.y, v.z).unwrap();
    }
    for [a, b, c] in &mesh.faces {
        writeln!(text, "3 {a} {b} {c}").unwrap();
    }
    text.into_bytes()
}

fn binary_ply(mesh: &Mesh, is_big_endian: bool) -> Vec<u8> {
    let order =
        |bytes: [u8; 4]| if is_big_endian { bytes.into_iter().rev().collect::<Vec<u8>>() } else { bytes.into() };
    let format = if is_big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = ply_header(mesh, format).into_bytes();
    for v in mesh.vertices_m.iter().flat_map(|v| [v.x, v.y, v.z]) {
        bytes.extend(order((v as f32).to_le_bytes()));
    }
    for face in &mesh.faces {
        bytes.push(3);
        face.iter().for_each(|corner| bytes.extend(order(corner.to_le_bytes())));
    }
    bytes
}

fn ascii_stl(mesh: &Mesh, name: &str) -> Vec<u8> {
    let mut text = format!("solid{name}\n");
    for face in &mesh.faces {
        text.push_str("facet normal 0 0 0\n  outer loop\n");
        for v in mesh.corners_m(face) {
            writeln!(text, "    vertex {} {} {}", v.x, v.y, v.z).unwrap();
        }
        text.push_str("  endloop\nendfacet\n");
    }
    (text + "endsolid\n").into_bytes()
}

fn binary_stl(mesh: &Mesh, header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((mesh.faces.len() as u32).to_le_bytes());
    for face in &mesh.faces {
        bytes.extend([0; 12]);
        for c in mesh.corners_m(face).iter().flat_map(|v| [v.x, v.y, v.z]) {
            bytes.extend((c as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn written(name: &str, content: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    (folder, path)
}

fn read(name: &str, content: &[u8]) -> Mesh {
    let (_folder, path) = written(name, content);
    Mesh::read(&path, 1.0).unwrap()
}

fn error(name: &str, content: &[u8]) -> String {
    let (_folder, path) = written(name, content);
    let error = Mesh::read(&path, 1.0).unwrap_err().to_string();
    assert!(error.contains(name) && !error.contains('\n'), "{error}");
    error
}

fn all_formats(mesh: &Mesh) -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("body.obj", obj(mesh)),
        ("body.ply", ascii_ply(mesh)),
        ("little.ply", binary_ply(mesh, false)),
        ("big.ply", binary_ply(mesh, true)),
        ("named.stl", ascii_stl(mesh, " of a kind")),
        ("nameless.STL", ascii_stl(mesh, "")),
        ("binary.stl", binary_stl(mesh, b"made by a test")),
        ("misleading.stl", binary_stl(mesh, b"solid, and yet binary")),
    ]
}

#[test]
fn every_format_holds_the_same_body() {
    let mesh = body();
    let expected = mesh.mass_properties().unwrap();
    for (name, content) in all_formats(&mesh) {
        let found = read(name, &content);
        assert_eq!((found.vertices_m.len(), found.faces.len()), (mesh.vertices_m.len(), mesh.faces.len()), "{name}");
        let mass = found.mass_properties().unwrap();
        assert!((mass.volume_m3 / expected.volume_m3 - 1.0).abs() < 1e-12, "{name}");
        assert!((mass.inertia_m5 - expected.inertia_m5).norm() < 1e-12 * expected.inertia_m5.norm(), "{name}");
        for (face, same) in found.faces.iter().zip(&mesh.faces) {
            assert_eq!(found.corners_m(face), mesh.corners_m(same), "{name}");
        }
    }
    // The comparison can tell the other byte order.
    let mut wrong = binary_ply(&mesh, true);
    let at = wrong.windows(10).position(|w| w == b"big_endian").unwrap();
    wrong.splice(at..at + 10, *b"little_endian");
    assert!(Mesh::read(&written("wrong.ply", &wrong).1, 1.0).is_err());
}

#[test]
fn content_tells_the_format_where_the_name_does_not() {
    let mesh = body();
    for (index, (name, content)) in all_formats(&mesh).into_iter().enumerate() {
        assert_eq!(read(&format!("shape{index}.dat"), &content).faces.len(), mesh.faces.len(), "{name}");
    }
    assert_eq!(read("ply.obj", &ascii_ply(&mesh)).faces.len(), mesh.faces.len());
    assert!(error("notes.txt", b"nothing of a shape\n").contains("OBJ, PLY or STL"));
}

#[test]
fn scale_turns_file_units_into_metres() {
    let mesh = body();
    for (name, content) in all_formats(&mesh) {
        let (_folder, path) = written(name, &content);
        let radius_m = Mesh::read(&path, 1000.0).unwrap().radius_m();
        assert!((radius_m / mesh.radius_m() - 1000.0).abs() < 1e-9, "{name}: {radius_m}");
    }
}

#[test]
fn polygons_of_a_ply_file_are_cut_into_triangles_and_double_vertices_welded() {
    let text = format!(
        "ply\nformat ascii 1.0\nelement vertex 9\n{PLY_PROPERTIES}element face 6\nproperty list uchar uint vertex_index\n\
         end_header\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n-1 -1 -1\n4 8 3 2 1\n4 4 5 6 7\n\
         4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
    );
    let mesh = read("cube.ply", text.as_bytes());
    assert_eq!((mesh.vertices_m.len(), mesh.faces.len()), (8, 12));
    assert!((mesh.mass_properties().unwrap().volume_m3 - 8.0).abs() < 1e-12);
}

#[test]
fn colours_of_vertices_become_albedo() {
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n";
    let faces = "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    let body = "0 0 0 C\n1 0 0 D\n0 1 0 D\n0 0 1 D\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    let colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let with = |properties: &str, c: &str, d: &str| {
        let text = head.to_string() + properties + faces + &body.replace('C', c).replace('D', d);
        read("colored.ply", text.as_bytes()).albedo
    };
    let expected = MeshAlbedo::Vertices(vec![1.0, 0.4, 0.4, 0.4]);
    assert_eq!(with(colors, "255 255 255", "51 102 153"), expected);
    assert_eq!(with("property float albedo\n", "1.0", "0.4"), expected);
    assert_eq!(with("property float quality\n", "1.0", "0.4"), MeshAlbedo::Uniform);
}

#[test]
fn bad_ply_files_name_the_fault() {
    let mesh = body();
    let text = String::from_utf8(ascii_ply(&mesh)).unwrap();
    let cases = [
        (text.replace("property float y\n", ""), "x, y and z"),
        (text.replace("vertex_indices", "corners"), "vertex_indices"),
        (text.replace("format ascii 1.0", "format unknown 1.0"), "line 2"),
        (text.replacen("end_header\n", "end_header\nnan 0 0\n", 1), "line"),
        (text[..text.len() - 30].to_string(), "cut short"),
        (text.replace("\n3 0 ", "\n3 99999 "), "names vertex 99999"),
        (text.replace("\n3 0 ", "\n3 -1 "), "negative"),
        (text.replace("\n3 0 ", "\n2 "), "3 are needed"),
    ];
    for (text, fault) in cases {
        let error = error("bad.ply", text.as_bytes());
        assert!(error.contains(fault), "{fault}: {error}");
    }
    let mut bytes = binary_ply(&mesh, false);
    let cut = error("cut.ply", &bytes[..bytes.len() - 7]);
    assert!(cut.contains("cut short") && cut.contains("face"), "{cut}");
    let start = bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    bytes[start + 24..start + 28].copy_from_slice(&f32::NAN.to_le_bytes());
    let nan = error("nan.ply", &bytes);
    assert!(nan.contains("vertex 2") && nan.contains("finite"), "{nan}");
}

#[test]
fn bad_stl_files_name_the_face() {
    let mesh = body();
    let text = String::from_utf8(ascii_stl(&mesh, " x")).unwrap();
    let nan = error("nan.stl", text.replacen("vertex ", "vertex nan ", 7).as_bytes());
    assert!(nan.contains("face 1"), "{nan}");
    let cut = error("cut.stl", &text.as_bytes()[..text.len() / 2]);
    assert!(cut.contains("face 16"), "{cut}");
    let bytes = binary_stl(&mesh, b"");
    let short = error("short.stl", &bytes[..bytes.len() - 60]);
    assert!(short.contains("cut short") && short.contains("320 faces"), "{short}");
    let mut wrong = bytes.clone();
    wrong[84 + 50 * 3 + 20..84 + 50 * 3 + 24].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let infinite = error("infinite.stl", &wrong);
    assert!(infinite.contains("face 4") && infinite.contains("finite"), "{infinite}");
    let mut flat = bytes;
    flat.copy_within(84 + 50 * 9 + 12..84 + 50 * 9 + 24, 84 + 50 * 9 + 24);
    let flat = error("flat.stl", &flat);
    assert!(flat.contains("no area") && flat.contains("face 10"), "{flat}");
    for content in [&b""[..], b"solid\n", b"solid x\nendsolid x\n", &[0; 84]] {
        let empty = error("empty.stl", content);
        assert!(empty.contains("no faces") || empty.contains("shorter") || empty.contains("cut short"), "{empty}");
    }
}

#[test]
fn an_inside_out_or_open_body_is_reported_in_every_format() {
    let mut inside_out = body();
    inside_out.faces.iter_mut().for_each(|face| face.reverse());
    let mut open = body();
    open.faces.pop();
    for (mesh, fault) in [(inside_out, "inside out"), (open, "is open: 3 edges")] {
        for (name, content) in all_formats(&mesh) {
            let error = read(name, &content).mass_properties().unwrap_err().to_string();
            assert!(error.contains(fault), "{name}: {error}");
        }
    }
}
