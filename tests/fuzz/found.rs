//! Damaged files that once broke a reader.

use opnav::dataset::truth::read_flow;
use opnav::dataset::{CameraSource, ImageSequence, read_camera_sensor, read_tum};
use opnav::observations::read_relative_rotations;
use opnav::scene::{Mesh, Raster, RasterFile};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The size overflowed when it was multiplied.
#[test]
fn a_flow_field_of_impossible_size() {
    let dir = folder();
    let path = dir.path().join("7.flo");
    let size = [0xff; 8];
    std::fs::write(&path, [&b"PIEH"[..], &size].concat()).expect("a file");
    let error = read_flow(&path).expect_err("refused").to_string();
    assert!(error.ends_with("7.flo: it has 12 bytes, 147573952520956936212 expected: make it anew"), "{error}");
}

/// The count of a tag was believed, and 27 GB asked for.
#[test]
fn a_geotiff_with_an_endless_tag() {
    let dir = folder();
    let mut bytes = super::scenarios::geotiff_bytes();
    let tag = 33_550_u16.to_le_bytes();
    let at = bytes.windows(4).position(|w| w[..2] == tag && w[2..] == [12, 0]).expect("the tag of the scale");
    bytes[at + 4..at + 8].copy_from_slice(&u32::MAX.to_le_bytes());
    std::fs::write(dir.path().join("map.tif"), bytes).expect("a file");
    let error = Raster::read(&RasterFile::from_path("map.tif"), dir.path()).expect_err("refused").to_string();
    assert!(error.contains("map.tif"), "{error}");
}

/// The square of the quaternion's length overflowed, and the pose that was read had none.
#[test]
fn a_trajectory_with_an_endless_quaternion() {
    let dir = folder();
    let path = dir.path().join("a.tum");
    std::fs::write(&path, "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1e308\n").expect("a file");
    let error = read_tum(&path).expect_err("refused").to_string();
    assert!(error.ends_with("a.tum, line 2: the quaternion's length is inf, 1 expected"), "{error}");
}

/// A fourth number made the vertex one at no place.
#[test]
fn a_shape_with_a_vertex_of_four_numbers() {
    let dir = folder();
    let path = dir.path().join("body.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 2 4\n1 0\nv 0 0 2 NaN\nf 2 3 4\n").expect("a file");
    if let Ok(mesh) = Mesh::read(&path, 1.0) {
        assert!(mesh.vertices_m.iter().flatten().all(|c| c.is_finite()), "{mesh:?}");
    }
    std::fs::write(&path, "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    let error = Mesh::read(&path, 1e10).expect_err("refused").to_string();
    assert!(
        error.ends_with("body.obj: vertex 2 is not at a finite place: give it three coordinates in range"),
        "{error}"
    );
}

/// The focal length was positive, and too small to divide by.
#[test]
fn a_camera_of_no_focal_length() {
    let dir = folder();
    let path = dir.path().join("sensor.yaml");
    std::fs::write(&path, "resolution: [64, 48]\nintrinsics: [1e-320, 60, 32, 24]\n").expect("a file");
    let error = read_camera_sensor(&path).expect_err("refused").to_string();
    assert!(error.contains("sensor.yaml: the distortion cannot be inverted at pixel (-0.5, -0.5)"), "{error}");
}

/// The label was not named, only the place that it points to.
#[test]
fn a_label_that_points_to_a_folder() {
    let dir = folder();
    let label = include_str!("../../datasets/mola/coprates.lbl").replace("COPRATES.IMG", "/");
    std::fs::write(dir.path().join("coprates.lbl"), label).expect("a file");
    let error = Raster::read(&RasterFile::from_path("coprates.lbl"), dir.path()).expect_err("refused").to_string();
    assert!(error.contains("coprates.lbl: its image / cannot be read (Is a directory"), "{error}");
}

/// The number of a texture coordinate overflowed in the library that reads the file.
#[test]
fn a_shape_with_an_impossible_texture_number() {
    let dir = folder();
    let path = dir.path().join("body.obj");
    let whole = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
    std::fs::write(&path, format!("{whole}f 1/1 2/1 3/-9223372036854775808\n")).expect("a file");
    let error = Mesh::read(&path, 1.0).expect_err("refused").to_string();
    assert!(error.ends_with("body.obj, line 5: '3/-9223372036854775808' is not a corner of a face"), "{error}");
    std::fs::write(&path, format!("{whole}f 1/1 2/-2 3/1\n")).expect("a file");
    let error = Mesh::read(&path, 1.0).expect_err("refused").to_string();
    assert!(error.ends_with("body.obj, line 5: '2/-2' is not a corner of a face"), "{error}");
    for odd in
        ["f 1/ 2/1 3/1\n", "f 1/-1 2/-1 3/-1\n", "f 1/2147483647 2/1 3/1\n", "f 1/-2 2/1 3/1\n", "f 1/0 2/1 3/1\n"]
    {
        std::fs::write(&path, format!("{whole}{odd}")).expect("a file");
        if let Err(error) = Mesh::read(&path, 1.0) {
            assert!(error.to_string().contains("body.obj"), "{error}");
        }
    }
}

/// The folder was blamed.
#[test]
fn a_list_without_images() {
    let dir = folder();
    image::GrayImage::new(4, 4).save(dir.path().join("x.png")).expect("a picture");
    std::fs::write(dir.path().join("data.csv"), "#timestamp [ns],filename\n").expect("a file");
    let error = ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(1.0)).expect_err("refused").to_string();
    assert!(
        error.contains("data.csv: it lists no pictures: write a line 'timestamp [ns],filename' for each"),
        "{error}"
    );
}

/// The covariance overflowed, and what was written could not be read again.
#[test]
fn a_standard_deviation_whose_square_is_no_number() {
    let dir = folder();
    let path = dir.path().join("relative_rotations.csv");
    let header = "t_ns_from,t_ns_to,qw,qx,qy,qz,sigma_x_rad,sigma_y_rad,sigma_z_rad,matches,inliers,model,status";
    let with = |sigma: &str| {
        std::fs::write(&path, format!("{header}\n9,12,1,0,0,0,0,0,{sigma},12,0,none,few-matches\n")).expect("a file");
        read_relative_rotations(&path)
    };
    let error = with("1e308").expect_err("refused").to_string();
    assert!(error.contains("relative_rotations.csv, line 2: a standard deviation is 1"), "{error}");
    assert_eq!(with("3.2").expect("read").len(), 1);
}
