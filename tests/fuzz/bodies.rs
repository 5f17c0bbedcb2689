//! Shapes of small bodies.

use super::campaign::Target;
use super::fuzzed;
use opnav::scene::Mesh;
use std::path::Path;

fn read(path: &Path) -> Result<(), String> {
    let mesh = Mesh::read(path, 1.0).map_err(|e| e.to_string())?;
    assert!(mesh.vertices_m.iter().flatten().all(|c| c.is_finite()));
    assert!(mesh.faces.iter().flatten().all(|corner| (*corner as usize) < mesh.vertices_m.len()));
    Ok(())
}

const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn obj() -> Target {
    let whole = [
        "# a tetrahedron\no body\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0.5 1\nvn 0 0 1\nf 1/1/1 3/2/1 2/3/1\nf 1/1 2/2 4/3\n\
         f -4/1 -1/2 -2/3\nf 2/1 3/2 4/3\n",
    ];
    let whole = whole.map(|text| text.as_bytes().to_vec()).into();
    Target { name: "obj", file: "body.obj", beside: vec![], whole, read: |folder| read(&folder.join("body.obj")) }
}

fn ply_bytes(format: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment a test\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\nproperty list uchar int \
         vertex_indices\nend_header\n"
    )
    .into_bytes();
    let (text, big) = (format == "ascii", format == "binary_big_endian");
    let ordered = |mut b: [u8; 4]| {
        if big {
            b.reverse();
        }
        b
    };
    for [x, y, z] in CORNERS {
        match text {
            true => bytes.extend(format!("{x} {y} {z} 10 20 30\n").bytes()),
            false => {
                bytes.extend([x, y, z].into_iter().flat_map(|v| ordered(v.to_le_bytes())));
                bytes.extend([10, 20, 30]);
            }
        }
    }
    for [a, b, c] in FACES {
        match text {
            true => bytes.extend(format!("3 {a} {b} {c}\n").bytes()),
            false => bytes.extend([3].into_iter().chain([a, b, c].into_iter().flat_map(|i| ordered(i.to_le_bytes())))),
        }
    }
    bytes
}

fn ply() -> Target {
    let whole = ["ascii", "binary_little_endian", "binary_big_endian"].map(ply_bytes).into();
    Target { name: "ply", file: "body.ply", beside: vec![], whole, read: |folder| read(&folder.join("body.ply")) }
}

fn stl() -> Target {
    let mut text = String::from("solid body\n");
    let mut binary = vec![0; 80];
    binary.extend(4_u32.to_le_bytes());
    for face in FACES {
        let corners = face.map(|corner| CORNERS[corner as usize]);
        let lines = corners.map(|[x, y, z]| format!("  vertex {x} {y} {z}\n")).concat();
        text += &format!("facet normal 0 0 1\n outer loop\n{lines} endloop\nendfacet\n");
        let numbers = [[0.0, 0.0, 1.0]].into_iter().chain(corners).flatten();
        binary.extend(numbers.flat_map(f32::to_le_bytes).chain([0, 0]));
    }
    text += "endsolid body\n";
    let whole = vec![text.into_bytes(), binary];
    Target { name: "stl", file: "body.stl", beside: vec![], whole, read: |folder| read(&folder.join("body.stl")) }
}

fuzzed! {
    obj_files: obj();
    ply_files: ply();
    stl_files: stl();
}
