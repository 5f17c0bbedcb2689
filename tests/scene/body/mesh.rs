//! Reading meshes and their mass properties.

use crate::scene::datasets;
use nalgebra::{Matrix3, Rotation3, Vector3};
use opnav::scene::Mesh;
use std::path::PathBuf;

/// A box of 2 × 3 × 5 m (semi-axes 1, 1.5, 2.5), as OBJ.
const BOX: &str = "v -1 -1.5 -2.5\nv 1 -1.5 -2.5\nv 1 1.5 -2.5\nv -1 1.5 -2.5\nv -1 -1.5 2.5\nv 1 -1.5 2.5\nv 1 1.5 2.5\n\
v -1 1.5 2.5\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn written(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shape.obj");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn read(text: &str) -> Mesh {
    let (_folder, path) = written(text);
    Mesh::read(&path, 1.0).unwrap()
}

fn error(text: &str) -> String {
    let (_folder, path) = written(text);
    let error = Mesh::read(&path, 1.0).unwrap_err().to_string();
    assert!(error.contains("shape.obj"), "{error}");
    error
}

#[test]
fn box_has_its_textbook_mass_properties() {
    let found = read(BOX).mass_properties().unwrap();
    assert!((found.volume_m3 - 30.0).abs() < 1e-12);
    assert!(found.center_m.norm() < 1e-14);
    let expected = Vector3::new(9.0 + 25.0, 4.0 + 25.0, 4.0 + 9.0) * (30.0 / 12.0);
    assert!((found.inertia_m5 - Matrix3::from_diagonal(&expected)).abs().max() < 1e-11);
}

#[test]
fn mass_properties_follow_a_turned_and_far_away_box() {
    let turn = Rotation3::from_euler_angles(0.4, -0.9, 2.0);
    let place = Vector3::new(1e4, -2e4, 5e3);
    let mut mesh = read(BOX);
    let at_home = mesh.mass_properties().unwrap();
    mesh.vertices_m.iter_mut().for_each(|v| *v = turn * *v + place);
    let found = mesh.mass_properties().unwrap();
    assert!((found.volume_m3 - 30.0).abs() < 1e-8);
    assert!((found.center_m - place).norm() < 1e-8);
    let expected = turn.matrix() * at_home.inertia_m5 * turn.matrix().transpose();
    assert!((found.inertia_m5 - expected).abs().max() < 1e-6);
    let moments = found.principal_moments_m5();
    assert!((moments - Vector3::new(32.5, 72.5, 85.0)).norm() < 1e-6, "{moments}");
}

#[test]
fn fine_ellipsoid_approaches_its_analytic_mass_properties() {
    let (a, b, c) = (3.0, 2.0, 1.5);
    let mut mesh = Mesh::icosphere(5);
    mesh.vertices_m.iter_mut().for_each(|v| v.component_mul_assign(&Vector3::new(a, b, c)));
    let found = mesh.mass_properties().unwrap();
    let volume = 4.0 / 3.0 * std::f64::consts::PI * a * b * c;
    assert!((found.volume_m3 / volume - 1.0).abs() < 1e-3, "{}", found.volume_m3 / volume);
    let moments = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * 0.2; // over the mass
    let ratio = (found.inertia_m5.diagonal() / found.volume_m3).component_div(&moments);
    assert!((ratio - Vector3::repeat(1.0)).abs().max() < 1e-3, "{ratio}");
}

#[test]
fn icosphere_is_closed_and_has_the_stated_size() {
    let mesh = Mesh::icosphere(3);
    assert_eq!(mesh.faces.len(), 1280);
    assert_eq!(mesh.vertices_m.len(), 642);
    mesh.check_closed().unwrap();
    assert!(mesh.mass_properties().unwrap().volume_m3 > 4.1);
}

#[test]
fn real_bodies_have_their_published_volume_and_inertia() {
    let known = [("itokawa", 0.0178, [0.281, 0.951]), ("bennu", 0.0616, [0.852, 0.881])];
    for (name, volume_km3, ratios) in known {
        let mesh = Mesh::read(&datasets().join(format!("shapes/{name}.obj")), 1000.0).unwrap();
        assert_eq!((mesh.vertices_m.len(), mesh.faces.len()), (24_578, 49_152), "{name}");
        let found = mesh.mass_properties().unwrap();
        assert!((found.volume_m3 * 1e-9 - volume_km3).abs() < 0.5e-4, "{name}: {}", found.volume_m3);
        let moments = found.principal_moments_m5();
        for (axis, ratio) in ratios.iter().enumerate() {
            assert!((moments[axis] / moments[2] - ratio).abs() < 0.5e-3, "{name}: {moments}");
        }
    }
}

#[test]
fn groups_normals_and_polygons_make_one_closed_mesh() {
    let mut text = String::from("mtllib none.mtl\no first\nvn 0 0 1\nvt 0 0\n");
    for (index, line) in BOX.lines().enumerate() {
        if index == 11 {
            text.push_str("g second\nusemtl red\n");
        }
        let line = if line.starts_with('f') {
            line.replace(' ', "/1/1 ").replacen("f/1/1", "f", 1) + "/1/1"
        } else {
            line.into()
        };
        text.push_str(&(line + "\n"));
    }
    let mesh = read(&text);
    assert_eq!((mesh.vertices_m.len(), mesh.faces.len()), (8, 12));
    assert!((mesh.mass_properties().unwrap().volume_m3 - 30.0).abs() < 1e-12);
}

#[test]
fn bad_files_name_file_line_and_fault() {
    let missing = Mesh::read(&datasets().join("none.obj"), 1.0).unwrap_err().to_string();
    assert!(missing.contains("none.obj"), "{missing}");
    let cases = [
        ("", "line 1", "without a face"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "line 3", "without a face"),
        (&BOX.replace("v 1 1.5 -2.5", "v 1 nan -2.5"), "line 3", "'nan'"),
        (&BOX.replace("v 1 1.5 -2.5", "v 1 1e999 -2.5"), "line 3", "'1e999'"),
        (&BOX.replace("v 1 1.5 -2.5", "v 1 x -2.5"), "line 3", "'x'"),
        (&BOX.replace("v 1 1.5 -2.5", "v 1 1.5"), "line 3", "2 coordinates"),
        (&BOX.replace("f 5 6 7 8", "f 5 6 7 9"), "line 10", "vertex 9"),
        (&BOX.replace("f 5 6 7 8", "f 5 6 7 0"), "line 10", "vertex 0"),
        (&BOX.replace("f 5 6 7 8", "f 5 6 7 -9"), "line 10", "vertex -9"),
        (&BOX.replace("f 5 6 7 8", "f 5 6 x 8"), "line 10", "'x'"),
        (&BOX[..BOX.len() - 5], "line 14", "2 corners"),
        (&BOX.replace("f 5 6 7 8", "f 5 6 7\nf 5 7 8\nf 5 5 6"), "1 faces have no area", "face 5"),
    ];
    for (text, line, fault) in cases {
        let error = error(text);
        assert!(error.contains(line) && error.contains(fault), "{error}");
    }
    let (_folder, path) = written(BOX);
    for scale in [0.0, -1.0, f64::NAN] {
        let error = Mesh::read(&path, scale).unwrap_err().to_string();
        assert!(error.contains("shape.obj") && error.contains("metres_per_unit"), "{error}");
    }
}

#[test]
fn what_is_no_solid_is_reported() {
    let fault = |text: &str| read(text).mass_properties().unwrap_err().to_string();
    let open = fault(&BOX.replace("f 5 6 7 8\n", ""));
    assert!(open.contains("open: 4 edges"), "{open}");
    let flipped = fault(&BOX.replace("f 5 6 7 8", "f 8 7 6 5"));
    assert!(flipped.contains("flipped") && flipped.contains("4 edges"), "{flipped}");
    let twice = fault(&BOX.replace("f 5 6 7 8", "f 5 6 7 8\nf 5 6 7 8"));
    assert!(twice.contains("more than two faces"), "{twice}");
    let mut inside_out = read(BOX);
    inside_out.faces.iter_mut().for_each(|face| face.reverse());
    let inside_out = inside_out.mass_properties().unwrap_err().to_string();
    assert!(inside_out.contains("inside out"), "{inside_out}");
    let nothing = Mesh::default().mass_properties().unwrap_err().to_string();
    assert!(nothing.contains("volume of 0"), "{nothing}");
}
