//! Tests of the room `dataset`.

mod ground_map;
mod images;

use image::{DynamicImage, GrayImage, ImageBuffer, Luma};
use nalgebra::{Isometry3, Matrix2, Translation3, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::truth::{
    AsteroidInertia, AsteroidState, LanderState, Landmark, LandmarkObservation, read_asteroid, read_lander_states,
    read_landmarks, read_observations, write_asteroid, write_lander_states, write_landmarks, write_observations,
};
use opnav::dataset::*;
use opnav::geometry::{Camera, Distortion};
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn put(root: &Path, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let path = root.join(name);
    fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
    fs::write(&path, text).expect("a file");
    path
}

fn pose(x: f64) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.1 * x, -0.2, 0.3));
    Isometry3::from_parts(Translation3::new(x, 1.0 / 3.0, -1e-7), rotation)
}

fn close(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    a.translation == b.translation && a.rotation.angle_to(&b.rotation) < 1e-15
}

fn sensor(distortion: Distortion) -> CameraSensor {
    let camera = Camera { distortion, ..Camera::from_fov(64, 48, 1.0) };
    CameraSensor { camera, spacecraft_from_camera: pose(2.0), rate_hz: Some(20.0), bits: None }
}

/// The error's text, which has to name the file and, if given, the line and a word of the problem.
fn complaint<T>(result: Result<T, DatasetError>, file: &Path, line: Option<u64>, words: &[&str]) -> String {
    let Err(error) = result else { panic!("{} should have been refused ({words:?})", file.display()) };
    let text = error.to_string();
    assert!(text.contains(&file.display().to_string()), "no file in: {text}");
    if let Some(line) = line {
        assert!(text.contains(&format!("line {line}:")), "line {line} not in: {text}");
    }
    for word in words {
        assert!(text.contains(word), "'{word}' not in: {text}");
    }
    text
}

// ---------------------------------------------------------------------------------------------------- round trips

#[test]
fn timed_tables_return_every_digit() {
    let (dir, values) = (folder(), [1.0 / 3.0, -0.0, f64::MIN_POSITIVE, 1e300, 5e-324]);
    let path = dir.path().join("deep/down/table.csv");
    write_timed_table(&path, "t_ns,a,b,c,d,e", [(-5, values.as_slice()), (i64::MAX, values.as_slice())])
        .expect("write");
    let table = read_timed_table(&path, 5).expect("read");
    assert_eq!(table.columns, ["a", "b", "c", "d", "e"]);
    assert_eq!((table.rows[0].t_ns, table.rows[1].t_ns), (-5, i64::MAX));
    assert_eq!(table.rows[1].values, values);
}

#[test]
fn imu_files_return() {
    let dir = folder();
    let sample = |k: i64| ImuSample {
        t_ns: k * 10_000_000,
        rate_in_lander_rad_s: Vector3::new(0.1, 0.2, 1.0 / 7.0) * k as f64,
        specific_force_in_lander_m_s2: Vector3::new(-1.0, 3.711, 1e-9),
    };
    let samples: Vec<ImuSample> = (0..5).map(sample).collect();
    let noise =
        ImuNoise { rate_hz: 100.0, gyroscope_noise_density: 4.8e-7, accelerometer_noise_density: 5e-4, bias: None };
    write_imu(dir.path(), &samples).expect("write");
    write_imu_sensor(dir.path(), &noise).expect("write");
    assert_eq!(read_imu(dir.path()).expect("read"), (noise, samples));
}

#[test]
fn camera_files_return_for_every_lens() {
    let dir = folder();
    let path = dir.path().join("cam0/sensor.yaml");
    let lenses = [
        Distortion::None,
        Distortion::RadialTangential([-0.28, 0.07, 2e-4, 1.7e-5]),
        Distortion::Equidistant([0.003, 0.0007, -0.002, 0.0002]),
    ];
    for lens in lenses {
        write_camera_sensor(&path, &sensor(lens)).expect("write");
        let back = read_camera_sensor(&path).expect("read");
        assert_eq!((back.camera, back.rate_hz), (sensor(lens).camera, Some(20.0)));
        let (a, b) = (back.spacecraft_from_camera, pose(2.0));
        assert!(a.translation == b.translation && a.rotation.angle_to(&b.rotation) < 1e-12);
    }
}

#[test]
fn designated_point_and_initial_state_return() {
    let dir = folder();
    let point = DesignatedPoint {
        t_ns: 12,
        pixel_px: Vector2::new(511.25, 400.5),
        covariance_px2: Matrix2::new(0.25, 0.01, 0.01, 0.3),
    };
    write_designated(dir.path(), &point).expect("write");
    assert_eq!(read_designated(dir.path()).expect("read"), point);
    let state = InitialState {
        t_ns: -3,
        site_from_lander: pose(3300.0),
        lander_velocity_in_site_m_s: Vector3::new(-56.0, -66.0, -90.0),
        sigma_position_m: 577.0,
        sigma_velocity_m_s: 5.77,
        sigma_attitude_rad: 0.02,
    };
    write_initial_state(dir.path(), &state).expect("write");
    let back = read_initial_state(dir.path()).expect("read");
    assert!(close(&back.site_from_lander, &state.site_from_lander));
    assert_eq!(InitialState { site_from_lander: state.site_from_lander, ..back }, state);
}

#[test]
fn true_states_return() {
    let dir = folder();
    let state = |k: i64| LanderState {
        t_ns: k,
        site_from_lander: pose(k as f64),
        lander_velocity_in_site_m_s: Vector3::new(1.0, 2.0, 3.0 + k as f64),
        gyro_bias_rad_s: Vector3::new(1e-6, 0.0, -1e-6),
        accelerometer_bias_m_s2: Vector3::new(0.0, 1e-4, 0.0),
    };
    let states: Vec<LanderState> = (0..4).map(state).collect();
    write_lander_states(dir.path(), &states).expect("write");
    for (back, state) in read_lander_states(dir.path()).expect("read").iter().zip(&states) {
        assert!(close(&back.site_from_lander, &state.site_from_lander));
        assert_eq!(LanderState { site_from_lander: state.site_from_lander, ..*back }, *state);
    }
}

#[test]
fn asteroid_truth_returns() {
    let dir = folder();
    let state = |k: i64| AsteroidState {
        t_ns: k * 1_000_000_000,
        asteroid_from_inertial: pose(k as f64).rotation,
        rate_in_asteroid_rad_s: Vector3::new(0.087, 0.04, 0.061),
    };
    let states: Vec<AsteroidState> = (0..3).map(state).collect();
    let inertia = AsteroidInertia { inertia: [[0.85, 0.13, 0.17], [0.13, 1.37, -0.11], [0.17, -0.11, 1.0]] };
    write_asteroid(dir.path(), &states, &inertia).expect("write");
    let (back, back_inertia) = read_asteroid(dir.path()).expect("read");
    assert_eq!(back_inertia, inertia);
    assert_eq!(inertia.matrix()[(0, 2)], 0.17);
    for (a, b) in back.iter().zip(&states) {
        assert_eq!((a.t_ns, a.rate_in_asteroid_rad_s), (b.t_ns, b.rate_in_asteroid_rad_s));
        assert!(a.asteroid_from_inertial.angle_to(&b.asteroid_from_inertial) < 1e-15);
    }
}

#[test]
fn landmark_files_have_the_promised_columns() {
    let dir = folder();
    let landmark = Landmark { id: 4, position_m: Vector3::new(1.0, 2.5, -3.0) };
    let seen = LandmarkObservation { t_ns: 9, camera: 0, id: 4, pixel_px: Vector2::new(10.5, 20.25), visible: true };
    let hidden = LandmarkObservation { visible: false, ..seen };
    write_landmarks(dir.path(), &[landmark]).expect("write");
    write_observations(dir.path(), None, &[seen, hidden]).expect("write");
    assert_eq!(read_landmarks(dir.path()).expect("read"), [landmark]);
    assert_eq!(read_observations(dir.path(), None).expect("read"), [seen, hidden]);
    let text = |name: &str| fs::read_to_string(dir.path().join(name)).expect("written");
    assert_eq!(text("truth/landmarks.csv"), "id,x_m,y_m,z_m\n4,1,2.5,-3\n");
    assert_eq!(
        text("truth/observations.csv"),
        "t_ns,cam,id,u_px,v_px,visible\n9,0,4,10.5,20.25,1\n9,0,4,10.5,20.25,0\n"
    );
}

#[test]
fn trajectories_return_with_negative_and_long_times() {
    let dir = folder();
    let path = dir.path().join("trajectory.tum");
    let times = [
        i64::MIN,
        -1_500_000_001,
        -1_000_000_000,
        -500_000_000,
        -1,
        0,
        1,
        999_999_999,
        1_403_636_579_763_555_584,
        i64::MAX,
    ];
    let poses: Vec<StampedPose> =
        times.iter().map(|&t_ns| StampedPose { t_ns, reference_from_moving: pose(1.0) }).collect();
    write_tum(&path, &poses).expect("write");
    let back = read_tum(&path).expect("read");
    assert_eq!(back.iter().map(|p| p.t_ns).collect::<Vec<_>>(), times);
    assert!(back.iter().all(|p| close(&p.reference_from_moving, &pose(1.0))));
    assert!(fs::read_to_string(&path).expect("text").contains("\n-0.500000000 "));
}

#[test]
fn trajectories_of_other_tools_are_read() {
    let dir = folder();
    let text = "# timestamp tx ty tz qx qy qz qw\n\n1.5e0 0 0 0 0 0 0 1\n1305031102.1758 1 2 3 0 0 0 2\n";
    let back = read_tum(&put(dir.path(), "a.tum", text)).expect("read");
    assert_eq!((back[0].t_ns, back[1].t_ns), (1_500_000_000, 1_305_031_102_175_800_000));
    assert_eq!(back[1].reference_from_moving.rotation, UnitQuaternion::identity());
}

#[test]
fn depth_and_masks_return() {
    let dir = folder();
    let depth: Vec<f32> = (0..12).map(|k| if k == 5 { f32::NAN } else { 1234.567 * k as f32 }).collect();
    let path = dir.path().join("truth/depth/cam0/7.tiff");
    write_depth_tiff(&path, 4, 3, &depth).expect("write");
    let back = read_depth_tiff(&path).expect("read");
    assert_eq!(back.dimensions(), (4, 3));
    assert!(back.as_raw().iter().zip(&depth).all(|(a, b)| a.to_bits() == b.to_bits()));
    let mask = GrayImage::from_fn(5, 4, |x, y| Luma([(x + 5 * y) as u8]));
    let path = dir.path().join("truth/mask/cam0/7.png");
    write_grey_png(&path, &mask).expect("write");
    assert_eq!(read_mask_png(&path).expect("read"), mask);
}

#[test]
fn the_manifest_knows_every_file_but_itself() {
    let dir = folder();
    put(dir.path(), "cam0/data.csv", "abc");
    put(dir.path(), "scenario.toml", "");
    for _ in 0..2 {
        let manifest = Manifest::new("llvmpipe", 3, &[CameraId::single(0)]);
        write_manifest(dir.path(), manifest, &Checksums::new()).expect("write");
        let manifest = read_manifest(dir.path()).expect("read");
        assert_eq!((manifest.frame_count, manifest.adapter.as_str()), (3, "llvmpipe"));
        assert_eq!(manifest.cameras, ["cam0"]);
        assert_eq!(manifest.sha256.keys().collect::<Vec<_>>(), ["cam0/data.csv", "scenario.toml"]);
        // FIPS 180-2, the first example
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(manifest.sha256["cam0/data.csv"], abc);
    }
}

// ---------------------------------------------------------------------------------------------------- whole or nothing

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_failed_write_leaves_nothing_and_keeps_what_was_there() {
    let dir = folder();
    let path = dir.path().join("result.csv");
    let fail = |w: &mut (dyn std::io::Write + '_)| {
        w.write_all(b"half a fi")?;
        Err(std::io::Error::other("the disk is full"))
    };
    complaint(write_atomically(&path, fail), &path, None, &["the disk is full"]);
    assert_eq!(names(dir.path()), Vec::<String>::new());
    write_text(&path, "first").expect("write");
    complaint(write_atomically(&path, fail), &path, None, &["could not write"]);
    assert_eq!(names(dir.path()), ["result.csv"]);
    assert_eq!(fs::read_to_string(&path).expect("kept"), "first");
    write_text(&path, "second").expect("write");
    assert_eq!(fs::read_to_string(&path).expect("replaced"), "second");
}

#[test]
fn a_destination_that_is_a_folder_is_named_and_nothing_is_left_beside_it() {
    let dir = folder();
    let path = dir.path().join("taken");
    fs::create_dir(&path).expect("a folder");
    put(&path, "inside", "x");
    complaint(write_text(&path, "text"), &path, None, &["could not write"]);
    assert_eq!(names(dir.path()), ["taken"]);
}

#[cfg(unix)]
#[test]
fn finished_files_can_be_read_by_others() {
    use std::os::unix::fs::PermissionsExt;
    let dir = folder();
    let path = dir.path().join("a.txt");
    write_text(&path, "x").expect("write");
    assert_eq!(fs::metadata(&path).expect("it exists").permissions().mode() & 0o777, 0o644);
}

// ---------------------------------------------------------------------------------------------------- bad tables

#[test]
fn bad_tables_are_refused_with_file_and_line() {
    let dir = folder();
    let cases: [(&str, &str, Option<u64>, &str); 10] = [
        ("t_ns,a\n1,2\n2\n", "truncated", Some(3), "1 columns found, 2 expected"),
        ("t_ns,a\n1,2,3\n", "too wide", Some(2), "3 columns found, 2 expected"),
        ("t_ns,a\n1,NaN\n", "not a number", Some(2), "not a finite number"),
        ("t_ns,a\n1,inf\n", "infinite", Some(2), "not a finite number"),
        ("t_ns,a\n1,two\n", "a word", Some(2), "'two' is not a number"),
        ("#t_ns,a\n1,1\n\n1,2\n", "doubled time", Some(4), "time stamp 1 ns does not come after"),
        ("5,1\n4,2\n", "unordered, no header", Some(2), "sort the rows"),
        ("t_ns,a\n1.5,2\n", "fraction of a ns", Some(2), "whole nanoseconds"),
        ("t_ns,a\n", "header alone", None, "no rows"),
        ("", "empty", None, "no rows"),
    ];
    for (text, name, line, word) in cases {
        let path = put(dir.path(), &format!("{name}.csv"), text);
        complaint(read_timed_table(&path, 1), &path, line, &[word]);
    }
    let path = dir.path().join("nowhere.csv");
    complaint(read_timed_table(&path, 1), &path, None, &["missing", "check"]);
    let path = put(dir.path(), "binary.csv", [0xff, 0xfe, 0x00]);
    complaint(read_timed_table(&path, 1), &path, None, &["could not read"]);
}

#[test]
fn tables_with_windows_line_ends_and_spaces_are_read() {
    let dir = folder();
    let path = put(dir.path(), "a.csv", "#timestamp [ns], a\r\n 1 , 2.5 \r\n2,3\r\n");
    let table = read_timed_table(&path, 1).expect("read");
    assert_eq!(table.rows.iter().map(|r| r.values[0]).collect::<Vec<_>>(), [2.5, 3.0]);
}

#[test]
fn bad_trajectories_are_refused_with_file_and_line() {
    let dir = folder();
    let cases = [
        ("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n", Some(2), "7 columns found, 8 expected"),
        ("0 0 0 0 0 0 0 0\n", Some(1), "quaternion is zero"),
        ("0 0 nan 0 0 0 0 1\n", Some(1), "not a finite number"),
        ("noon 0 0 0 0 0 0 1\n", Some(1), "'noon' is not a time"),
        ("1e30 0 0 0 0 0 0 1\n", Some(1), "is not a time"),
        ("# t\n1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", Some(3), "does not come after"),
        ("# nothing\n", None, "no poses"),
    ];
    for (number, (text, line, word)) in cases.into_iter().enumerate() {
        let path = put(dir.path(), &format!("{number}.tum"), text);
        complaint(read_tum(&path), &path, line, &[word]);
    }
}

#[test]
fn bad_truth_is_refused_with_file_and_line() {
    let dir = folder();
    let good = "1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0\n";
    let path = put(dir.path(), "truth/state.csv", format!("#t\n{good}{}", good.replace("1,0,0,0,1", "2,0,0,0,0")));
    complaint(read_lander_states(dir.path()), &path, Some(3), &["quaternion's length is 0"]);
    let path = put(dir.path(), "truth/asteroid.csv", "#t\n1,0.5,0,0,0,1,1,1\n");
    complaint(read_asteroid(dir.path()), &path, Some(2), &["quaternion's length is 0.5"]);
    put(dir.path(), "truth/asteroid.csv", "#t\n1,1,0,0,0,1,1,1\n");
    let path = dir.path().join("truth/asteroid.json");
    complaint(read_asteroid(dir.path()), &path, None, &["missing"]);
    put(dir.path(), "truth/asteroid.json", "{\"inertia\": [[1,0,0],[0,1,0]]}");
    complaint(read_asteroid(dir.path()), &path, None, &["length 2", "line 1"]);
    for bad in ["[[1,0.5,0],[0,1,0],[0,0,1]]", "[[1,0,0],[0,-1,0],[0,0,1]]"] {
        put(dir.path(), "truth/asteroid.json", format!("{{\"inertia\": {bad}}}"));
        complaint(read_asteroid(dir.path()), &path, None, &["symmetric positive definite"]);
    }
}

#[test]
fn bad_points_states_and_imus_are_refused() {
    let dir = folder();
    let path = put(dir.path(), "designated.csv", "0,1,1,1,2,1\n");
    complaint(read_designated(dir.path()), &path, None, &["not positive definite"]);
    let path = put(dir.path(), "initial_state.csv", "#t\n0,0,0,0,1,0,0,0,0,0,0,1,0,1\n");
    complaint(read_initial_state(dir.path()), &path, None, &["sigma"]);
    let path = put(dir.path(), "initial_state.csv", "#t\n0,0,0,0,0,0,0,0,0,0,0,1,1,1\n");
    complaint(read_initial_state(dir.path()), &path, Some(2), &["quaternion"]);
    put(dir.path(), "imu0/data.csv", "0,0,0,0,0,0,0\n");
    let path = dir.path().join("imu0/sensor.yaml");
    complaint(read_imu(dir.path()), &path, None, &["missing"]);
    put(dir.path(), "imu0/sensor.yaml", "rate_hz: 200\ngyroscope_noise_density: -1\naccelerometer_noise_density: 1\n");
    complaint(read_imu(dir.path()), &path, None, &["positive"]);
    put(dir.path(), "imu0/sensor.yaml", "rate_hz: 200\n");
    complaint(read_imu(dir.path()), &path, None, &["gyroscope_noise_density"]);
    let path = put(dir.path(), "manifest.json", "{");
    complaint(read_manifest(dir.path()), &path, None, &["line 1"]);
}

// ---------------------------------------------------------------------------------------------------- cameras

const EUROC_CAMERA: &str = "# General sensor definitions.
sensor_type: camera
comment: VI-Sensor cam0 (MT9M034)

T_BS:
  cols: 4
  rows: 4
  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,
         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,
        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,
         0.0, 0.0, 0.0, 1.0]

rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
";

#[test]
fn the_camera_file_of_euroc_is_read() {
    let dir = folder();
    let sensor =
        read_camera_sensor(&put(dir.path(), "sensor.yaml", format!("%YAML:1.0\n{EUROC_CAMERA}"))).expect("read");
    assert_eq!((sensor.camera.width_px, sensor.camera.height_px, sensor.rate_hz), (752, 480, Some(20.0)));
    assert_eq!(sensor.camera.center_px, Vector2::new(367.215, 248.375));
    assert_eq!(sensor.spacecraft_from_camera.translation.y, -0.064676986768);
    let forward = sensor.spacecraft_from_camera.rotation * Vector3::z();
    assert!((forward - Vector3::new(0.00414, 0.0257, 0.99966)).norm() < 1e-4);
}

#[test]
fn bad_camera_files_are_refused_with_the_key() {
    let dir = folder();
    let cases = [
        ("intrinsics: [458.654, 457.296, 367.215, 248.375]", "intrinsics: [458.654, 457.296]", "intrinsics"),
        ("458.654", ".nan", "fu"),
        ("458.654", "-458.654", "fu"),
        ("248.375", ".inf", "cv"),
        ("resolution: [752, 480]", "", "resolution"),
        ("[752, 480]", "[0, 480]", "width"),
        ("radial-tangential", "swirl", "'swirl' is not one of"),
        (", 1.76187114e-05]", "]", "3 numbers"),
        ("0.07395907", ".nan", "distortion_coefficients"),
        ("-0.28340811", "-1.9", "cannot be inverted"),
        ("0.0148655429818", "0.5", "not a rotation"),
        ("-0.064676986768", ".nan", "T_BS"),
        ("0.0, 0.0, 0.0, 1.0]", "0.0]", "13 numbers"),
        ("rate_hz: 20", "rate_hz: 0", "rate_hz"),
        ("resolution: [752, 480]", "resolution: [752, 480", "line"),
    ];
    for (from, to, word) in cases {
        assert!(EUROC_CAMERA.contains(from), "{from}");
        let path = put(dir.path(), "sensor.yaml", EUROC_CAMERA.replace(from, to));
        complaint(read_camera_sensor(&path), &path, None, &[word]);
    }
}

// ---------------------------------------------------------------------------------------------------- sequences

fn png(picture: &DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).expect("a picture");
    bytes.into_inner()
}

fn grey(width: u32, height: u32) -> Vec<u8> {
    png(&DynamicImage::ImageLuma8(GrayImage::from_fn(width, height, |x, y| Luma([(x * 3 + y) as u8]))))
}

/// A data set of three pictures under `root`.
fn sequence(root: &Path) {
    put(root, "cam0/data.csv", "#timestamp [ns],filename\n100,100.png\n200,200.png\n300,300.png\n");
    for name in ["100", "200", "300"] {
        put(root, &format!("cam0/data/{name}.png"), grey(64, 48));
    }
    write_camera_sensor(&root.join("cam0/sensor.yaml"), &sensor(Distortion::None)).expect("write");
}

#[test]
fn data_sets_and_euroc_folders_open() {
    for below in ["", "mav0"] {
        let dir = folder();
        sequence(&dir.path().join(below));
        let sequence = ImageSequence::open(dir.path(), &CameraSource::Folder).expect("open");
        assert_eq!(sequence.root, dir.path().join(below));
        assert_eq!(sequence.frames.iter().map(|f| f.t_ns).collect::<Vec<_>>(), [100, 200, 300]);
        assert_eq!(sequence.frames.iter().map(|f| f.index).collect::<Vec<_>>(), [0, 1, 2]);
        let picture = sequence.load(&sequence.frames[2]).expect("load");
        assert_eq!((picture.dimensions(), picture[(3, 1)].0[0]), ((64, 48), 10));
    }
}

#[test]
fn sixteen_bit_and_colour_pictures_become_grey() {
    let dir = folder();
    let deep = ImageBuffer::from_pixel(64, 48, Luma([0x8080u16]));
    put(dir.path(), "1.png", png(&DynamicImage::ImageLuma16(deep)));
    put(
        dir.path(),
        "2.png",
        png(&DynamicImage::ImageRgb8(ImageBuffer::from_pixel(64, 48, image::Rgb([128, 128, 128])))),
    );
    let sequence = ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(1.0)).expect("open");
    for frame in &sequence.frames {
        assert_eq!(sequence.load(frame).expect("load")[(5, 5)].0[0], 128);
    }
}

#[test]
fn plain_folders_are_sorted_as_people_count() {
    let dir = folder();
    for name in ["img10.png", "img2.png", "img1.png", "notes.txt"] {
        put(dir.path(), name, grey(64, 48));
    }
    let sequence = ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(60f64.to_radians())).expect("open");
    let order: Vec<_> = sequence.frames.iter().map(|f| f.path.file_name().expect("a name").to_owned()).collect();
    assert_eq!(order, ["img1.png", "img2.png", "img10.png"]);
    assert_eq!(sequence.frames.iter().map(|f| f.t_ns).collect::<Vec<_>>(), [0, 1_000_000_000, 2_000_000_000]);
    let focal = 32.0 / 30f64.to_radians().tan();
    assert!((sequence.sensor.camera.focal_px.x - focal).abs() < 1e-12);
}

#[test]
fn names_that_are_nanoseconds_give_the_times_and_small_numbers_do_not() {
    let dir = folder();
    for name in ["1403636579763555584.png", "1403636579813555456.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let open = || ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(1.0)).expect("open");
    assert_eq!(open().frames[1].t_ns, 1_403_636_579_813_555_456);
    fs::remove_dir_all(dir.path()).expect("removed");
    for name in ["0007.png", "0008.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    assert_eq!(open().frames[1].t_ns, 1_000_000_000);
}

#[test]
fn bad_lists_of_frames_are_refused_with_the_line() {
    let dir = folder();
    sequence(dir.path());
    let list = dir.path().join("cam0/data.csv");
    let cases = [
        ("#t\n100,100.png\n100,200.png\n", Some(3), "100 ns does not come after"),
        ("#t\n200,200.png\n100,100.png\n", Some(3), "does not come after"),
        ("#t\n100\n", Some(2), "timestamp [ns],filename"),
        ("#t\nnoon,100.png\n", Some(2), "'noon' is not a time stamp"),
        ("#t\n100,lost.png\n", None, "none of its 1 pictures exists"),
    ];
    for (text, line, word) in cases {
        fs::write(&list, text).expect("write");
        complaint(ImageSequence::open(dir.path(), &CameraSource::Folder), &list, line, &[word]);
    }
    fs::write(&list, "#t\n").expect("write");
    complaint(ImageSequence::open(dir.path(), &CameraSource::Folder), &list, None, &["it lists no pictures"]);
}

#[test]
fn a_missing_camera_or_folder_comes_with_the_cure() {
    let dir = folder();
    sequence(dir.path());
    let file = dir.path().join("cam0/sensor.yaml");
    fs::remove_file(&file).expect("removed");
    complaint(ImageSequence::open(dir.path(), &CameraSource::Folder), &file, None, &["--camera", "--fov-deg"]);
    let elsewhere = dir.path().join("other.yaml");
    complaint(ImageSequence::open(dir.path(), &CameraSource::File(elsewhere.clone())), &elsewhere, None, &["missing"]);
    let nowhere = dir.path().join("nowhere");
    complaint(ImageSequence::open(&nowhere, &CameraSource::Folder), &nowhere, None, &["missing"]);
    for fov in [0.0, 4.0, f64::NAN] {
        let picture = dir.path().join("cam0/data/100.png");
        complaint(
            ImageSequence::open(dir.path(), &CameraSource::HorizontalFov(fov)),
            &picture,
            None,
            &["field of view"],
        );
    }
}

#[test]
fn pictures_of_the_wrong_size_or_broken_are_named() {
    let dir = folder();
    sequence(dir.path());
    let sequence = ImageSequence::open(dir.path(), &CameraSource::Folder).expect("open");
    let path = put(dir.path(), "cam0/data/200.png", grey(32, 48));
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["32x48", "64x48"]);
    let whole = grey(64, 48);
    put(dir.path(), "cam0/data/200.png", &whole[..whole.len() / 2]);
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["cannot be read"]);
    let mut flipped = whole.clone();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 0xff;
    put(dir.path(), "cam0/data/200.png", &flipped);
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["cannot be read"]);
    put(dir.path(), "cam0/data/200.png", "");
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["cannot be read"]);
    fs::remove_file(&path).expect("removed");
    complaint(sequence.load(&sequence.frames[1]), &path, None, &["could not read"]);
    assert!(sequence.load(&sequence.frames[0]).is_ok(), "the others stay usable");
}

#[test]
fn broken_depth_and_masks_are_named() {
    let dir = folder();
    let path = dir.path().join("1.tiff");
    complaint(read_depth_tiff(&path), &path, None, &["could not read"]);
    write_depth_tiff(&path, 4, 3, &[1.0; 12]).expect("write");
    let whole = fs::read(&path).expect("written");
    fs::write(&path, &whole[..whole.len() / 2]).expect("write");
    complaint(read_depth_tiff(&path), &path, None, &[]);
    let mut bytes = std::io::Cursor::new(Vec::new());
    DynamicImage::ImageLuma8(GrayImage::new(4, 3)).write_to(&mut bytes, image::ImageFormat::Tiff).expect("a picture");
    fs::write(&path, bytes.get_ref()).expect("write");
    complaint(read_depth_tiff(&path), &path, None, &["not a float32 picture"]);
    let path = dir.path().join("1.png");
    fs::write(&path, "not a picture").expect("write");
    complaint(read_mask_png(&path), &path, None, &[]);
    complaint(write_depth_tiff(&dir.path().join("2.tiff"), 4, 3, &[1.0; 11]), &dir.path().join("2.tiff"), None, &[]);
}
