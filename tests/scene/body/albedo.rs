//! Albedo painted on bodies.

use crate::scene::{datasets, scenario};
use nalgebra::Vector3;
use opnav::scene::{AlbedoImage, GlobeMap, ImageEdge, Mesh, MeshAlbedo, Scene, SmallBody};
use std::f64::consts::PI;
use std::path::Path;

/// A cube with texture coordinates: every side shows the whole picture, upright seen from outside.
const CUBE: &str = "v -5 -5 -5\nv 5 -5 -5\nv 5 5 -5\nv -5 5 -5\nv -5 -5 5\nv 5 -5 5\nv 5 5 5\nv -5 5 5\nvt 0 0\nvt 1 0\n\
vt 1 1\nvt 0 1\nf 2/1 1/2 4/3 3/4\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\n\
f 4/1 1/2 5/3 8/4\n";

fn grey(path: &Path, width: u32, height: u32, value: impl Fn(u32, u32) -> u8) {
    image::GrayImage::from_fn(width, height, |x, y| image::Luma([value(x, y)])).save(path).unwrap();
}

fn body(folder: &Path, text: &str) -> Result<SmallBody, String> {
    let text = format!("[tumbling]\nframes = 1\nrange_m = 50\n{text}");
    match scenario(&text).map_err(|e| e.to_string())?.build(folder).map_err(|e| e.to_string())? {
        Scene::Tumbling(scene) => Ok(scene.body),
        _ => panic!("not a body"),
    }
}

#[test]
fn images_are_read_between_pixel_centres() {
    let image = AlbedoImage::new(4, 2, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], ImageEdge::Clamp);
    assert_eq!(image.at([0.125, 0.25]), 0.0);
    assert_eq!(image.at([0.25, 0.25]), 0.5);
    assert_eq!(image.at([0.125, 0.5]), 2.0);
    assert_eq!(image.at([0.0, 0.25]), 1.5, "the left edge meets the right one");
    assert_eq!(image.at([0.125, 0.0]), 0.0, "the upper edge goes on");
    assert_eq!(image.at([1.375, 0.75]), 5.0, "it starts again");
    let tiled = AlbedoImage::new(1, 2, vec![1.0, 3.0], ImageEdge::Repeat);
    assert_eq!(tiled.at([0.5, 0.0]), 2.0);
}

#[test]
fn texture_lies_upright_on_its_faces_with_the_mean_albedo() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.obj"), CUBE).unwrap();
    // Rows from the top: dark, bright; columns grow brighter to the right.
    grey(&folder.path().join("t.png"), 8, 8, |x, y| (10 * x + 20 * y) as u8);
    let shape = "[tumbling.shape.mesh]\npath = \"cube.obj\"\nunit = \"m\"\ntexture = \"t.png\"\n";
    let mesh = body(folder.path(), shape).unwrap().mesh;
    // The side z = 5 has its lower left corner at x = y = -5: the picture's column grows with x, its row falls with y.
    let at = |x: f64, y: f64| {
        mesh.faces.iter().enumerate().find_map(|(index, face)| {
            let [a, b, c] = mesh.corners_m(face);
            let area = |p: Vector3<f64>, q: Vector3<f64>, r: Vector3<f64>| (q - p).cross(&(r - p)).z;
            let point = Vector3::new(x, y, 5.0);
            let weights = [area(point, b, c), area(a, point, c), area(a, b, point)].map(|w| w / area(a, b, c));
            let is_top = [a, b, c].iter().all(|v| (v.z - 5.0).abs() < 1e-9);
            (is_top && weights.iter().all(|w| *w >= -1e-9)).then(|| mesh.relative_albedo(index, weights))
        })
    };
    let mean = (10.0 + 20.0) * 3.5;
    for (column, row) in [(0, 0), (3, 2), (7, 7), (2, 6)] {
        let (x, y) = (10.0 * (f64::from(column) + 0.5) / 8.0 - 5.0, 5.0 - 10.0 * (f64::from(row) + 0.5) / 8.0);
        let expected = f64::from(10 * column + 20 * row) / mean;
        let found = at(x, y).unwrap();
        assert!((found - expected).abs() < 2e-3, "{column} {row}: {found} {expected}");
        let flipped = f64::from(10 * column + 20 * (7 - row)) / mean;
        assert!((found - flipped).abs() > 0.05, "the check can tell a flipped picture");
    }
}

#[test]
fn map_lies_by_longitude_and_latitude() {
    let folder = tempfile::tempdir().unwrap();
    grey(&folder.path().join("m.png"), 360, 180, |x, y| (x / 2 + y / 4) as u8);
    let surface = "[tumbling.surface.albedo_map]\npath = \"m.png\"\nwest_edge_deg = 0\n\
                   [tumbling.shape.procedural]\nsubdivisions = 5\nrelief = 0.0\ncraters = 0\n";
    let mesh = body(folder.path(), surface).unwrap().mesh;
    let MeshAlbedo::Globe(map) = &mesh.albedo else { panic!("no map") };
    let at = |longitude_deg: f64, latitude_deg: f64| {
        let (l, b) = (longitude_deg.to_radians(), latitude_deg.to_radians());
        map.at(&(map.origin_m + Vector3::new(b.cos() * l.cos(), b.cos() * l.sin(), b.sin()) * 250.0))
    };
    let value = |x: u32, y: u32| f64::from((x / 2 + y / 4) as u8);
    let scale = at(90.5, 0.5) / value(90, 89);
    for (longitude_deg, latitude_deg, x, y) in [(0.5, 89.5, 0, 0), (200.5, -45.5, 200, 135), (-10.5, 30.5, 349, 59)] {
        let expected = scale * value(x, y);
        assert!((at(longitude_deg, latitude_deg) - expected).abs() < 1e-6, "{longitude_deg} {latitude_deg}");
    }
    // Its mean over the surface is 1.
    let (mut sum, mut area_m2) = (0.0, 0.0);
    for (index, face) in mesh.faces.iter().enumerate() {
        sum += mesh.relative_albedo(index, [1.0 / 3.0; 3]) * mesh.face_area_m2(face);
        area_m2 += mesh.face_area_m2(face);
    }
    assert!((sum / area_m2 - 1.0).abs() < 1e-3, "{}", sum / area_m2);
}

#[test]
fn map_stays_where_it_was_when_the_mesh_moves() {
    let image = AlbedoImage::new(4, 2, (0..8).map(|k| k as f32).collect(), ImageEdge::Clamp);
    let map = GlobeMap { image, west_edge_rad: -PI, origin_m: Vector3::zeros() };
    let mesh = Mesh { albedo: MeshAlbedo::Globe(map), ..Mesh::icosphere(2) };
    let moved = mesh.clone().translated(&Vector3::new(0.3, -2.0, 5.0));
    for face in 0..mesh.faces.len() {
        let weights = [0.2, 0.5, 0.3];
        assert!((mesh.relative_albedo(face, weights) - moved.relative_albedo(face, weights)).abs() < 1e-9);
    }
}

#[test]
fn textures_that_cannot_be_laid_on_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(datasets().join("shapes/README.md")).unwrap();
    std::fs::write(folder.path().join("text.png"), text).unwrap();
    grey(&folder.path().join("black.png"), 4, 4, |_, _| 0);
    std::fs::write(folder.path().join("cube.obj"), CUBE).unwrap();
    std::fs::write(folder.path().join("plain.obj"), CUBE.replace("vt", "#")).unwrap();
    let plain = CUBE
        .lines()
        .filter(|l| !l.starts_with("vt"))
        .map(|l| l.split(' ').map(|f| f.split('/').next().unwrap().to_string()).collect::<Vec<_>>().join(" ") + "\n");
    std::fs::write(folder.path().join("plain.obj"), plain.collect::<String>()).unwrap();
    let mesh = |path: &str, texture: &str| {
        let text = format!("[tumbling.shape.mesh]\npath = \"{path}\"\nunit = \"m\"\ntexture = \"{texture}\"\n");
        body(folder.path(), &text).unwrap_err()
    };
    let cases = [
        (mesh("cube.obj", "none.png"), "none.png"),
        (mesh("cube.obj", "text.png"), "text.png"),
        (mesh("cube.obj", "black.png"), "black"),
        (mesh("plain.obj", "black.png"), "texture coordinates"),
    ];
    for (error, fault) in cases {
        assert!(error.contains(fault), "{error}");
    }
}

#[test]
fn a_wrong_unit_gets_a_hint() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(datasets().join("shapes/bennu.obj"), folder.path().join("bennu.obj")).unwrap();
    let with = |scale: &str| body(folder.path(), &format!("[tumbling.shape.mesh]\npath = \"bennu.obj\"\n{scale}\n"));
    let error = with("unit = \"m\"").unwrap_err();
    assert!(error.contains("bennu.obj") && error.contains("in kilometres?"), "{error}");
    assert!(error.contains("tumbling.shape.mesh.unit") || error.contains("shape.mesh.unit"), "{error}");
    let radius_m = with("unit = \"km\"").unwrap().mesh.radius_m();
    assert!((250.0..320.0).contains(&radius_m), "{radius_m}");
    assert!(with("metres_per_unit = 1").is_ok(), "taken at its word");
}
