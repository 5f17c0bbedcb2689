//! Meshes of three million faces: time and memory from the file to the landmarks.

use nalgebra::Vector3;
use opnav::scene::Mesh;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Faces along an edge of each of a cube's sides: 12 · 500² = 3,000,000 faces.
const CELLS: i32 = 500;
/// Longest time in s that reading, mass properties and landmarks may take together on one processor.
const LONGEST_S: f64 = 30.0;
/// Most memory in MiB.
const MOST_MIB: f64 = 2048.0;

/// A cube blown up to an ellipsoid, each side with vertices of its own: a reader has to weld them.
fn sides() -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for side in 0..6 {
        let first = vertices.len() as u32;
        for (i, j) in (0..=CELLS).flat_map(|i| (0..=CELLS).map(move |j| (i, j))) {
            let [a, b] = [i, j].map(|k| f64::from(2 * k - CELLS));
            let c = f64::from(CELLS);
            let cube = match side {
                0 => Vector3::new(c, a, b),
                1 => Vector3::new(-c, b, a),
                2 => Vector3::new(b, c, a),
                3 => Vector3::new(a, -c, b),
                4 => Vector3::new(a, b, c),
                _ => Vector3::new(b, a, -c),
            };
            let place = cube.normalize().component_mul(&Vector3::new(300.0, 200.0, 150.0));
            vertices.push(place.map(|v| f64::from(v as f32)));
        }
        let number = |i: i32, j: i32| first + (i * (CELLS + 1) + j) as u32;
        for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
            faces.push([number(i, j), number(i + 1, j), number(i + 1, j + 1)]);
            faces.push([number(i, j), number(i + 1, j + 1), number(i, j + 1)]);
        }
    }
    (vertices, faces)
}

fn written(folder: &Path) -> Vec<PathBuf> {
    let (vertices, faces) = sides();
    let create = |name: &str| BufWriter::new(std::fs::File::create(folder.join(name)).unwrap());
    let mut obj = create("large.obj");
    vertices.iter().for_each(|v| writeln!(obj, "v {} {} {}", v.x, v.y, v.z).unwrap());
    faces.iter().for_each(|[a, b, c]| writeln!(obj, "f {} {} {}", a + 1, b + 1, c + 1).unwrap());
    let mut ply = create("large.ply");
    write!(
        ply,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        vertices.len(),
        faces.len()
    )
    .unwrap();
    let mut stl = create("large.stl");
    stl.write_all(&[b' '; 80]).unwrap();
    stl.write_all(&(faces.len() as u32).to_le_bytes()).unwrap();
    let floats = |v: &Vector3<f64>| [v.x, v.y, v.z].map(|c| (c as f32).to_le_bytes()).concat();
    vertices.iter().for_each(|v| ply.write_all(&floats(v)).unwrap());
    for face in &faces {
        ply.write_all(&[3]).unwrap();
        face.iter().for_each(|corner| ply.write_all(&corner.to_le_bytes()).unwrap());
        stl.write_all(&[0; 12]).unwrap();
        face.iter().for_each(|corner| stl.write_all(&floats(&vertices[*corner as usize])).unwrap());
        stl.write_all(&[0; 2]).unwrap();
    }
    ["large.obj", "large.ply", "large.stl"].map(|name| folder.join(name)).into()
}

/// Most memory that this process has held so far in MiB, where the system tells.
fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kib| kib / 1024.0)
}

#[test]
#[ignore = "writes 500 MB of shape files"]
fn accuracy_and_time_of_three_million_faces() {
    let folder = tempfile::tempdir().unwrap();
    let paths = written(folder.path());
    println!(
        "file        read s  mass s  landmarks s  inside s  peak MiB  (bounds: {LONGEST_S} s in all, {MOST_MIB} MiB)"
    );
    for path in paths {
        let start = Instant::now();
        let mesh = Mesh::read(&path, 1.0).unwrap();
        let read_s = start.elapsed().as_secs_f64();
        assert_eq!((mesh.faces.len(), mesh.vertices_m.len()), (3_000_000, 1_500_002));
        let start = Instant::now();
        let found = mesh.mass_properties().unwrap();
        let mass_s = start.elapsed().as_secs_f64();
        let start = Instant::now();
        assert_eq!(mesh.spread_landmarks(500, 1).len(), 500);
        let landmarks_s = start.elapsed().as_secs_f64();
        let start = Instant::now();
        assert_eq!(
            (mesh.surrounds(&Vector3::new(250.0, 10.0, 5.0)), mesh.surrounds(&Vector3::new(250.0, 200.0, 5.0))),
            (1, 0)
        );
        let inside_s = 0.5 * start.elapsed().as_secs_f64();
        let peak = peak_mib();
        let name = path.file_name().unwrap().to_string_lossy();
        println!(
            "{name}  {read_s:7.2} {mass_s:7.2} {landmarks_s:12.2} {inside_s:9.3} {:9.0}",
            peak.unwrap_or(f64::NAN)
        );
        let (a, b, c) = (300.0_f64, 200.0_f64, 150.0_f64);
        let ellipsoid = 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
        assert!((found.volume_m3 / ellipsoid - 1.0).abs() < 2e-5, "{}", found.volume_m3 / ellipsoid - 1.0);
        let moments = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * 0.2 * ellipsoid;
        assert!((found.inertia_m5.diagonal().component_div(&moments).add_scalar(-1.0)).amax() < 4e-5);
        assert!(read_s + mass_s + landmarks_s < LONGEST_S && peak.is_none_or(|mib| mib < MOST_MIB));
    }
}
