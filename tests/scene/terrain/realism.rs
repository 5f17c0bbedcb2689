//! Rendered ground beside photographed ground: the statistics of pictures from the same heights.

use image::{GrayImage, imageops};
use nalgebra::{Isometry3, Matrix3, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::evaluation::ImageStatistics;
use opnav::geometry::{Camera, Distortion};
use opnav::render::{Detector, Gpu, RenderConfig, Renderer, World};
use opnav::scene::{SensorConfig, Terrain, TerrainConfig, View, sun_angular_radius_rad};
use opnav::vision::{DetectorConfig, detect_features};
use std::path::{Path, PathBuf};

/// Edge of the middle of the pictures that is compared, px.
const EDGE_PX: u32 = 400;
/// Its first column and row in the photographs.
const CORNER_PX: [u32; 2] = [201, 210];

/// The middle of the landing camera of Mars 2020 at 800 px: a fisheye fitted to its published model.
fn camera() -> Camera {
    Camera {
        focal_px: Vector2::new(469.147537, 469.129819),
        center_px: Vector2::new(401.003638, 410.699309) - Vector2::from(CORNER_PX.map(f64::from)),
        distortion: Distortion::Equidistant([0.120292, 0.033713, -0.000063, 0.000032]),
        ..Camera::from_fov(EDGE_PX, EDGE_PX, 1.0)
    }
}

/// Time since the first frame in s and height above ground in m at the ends of both phases of the landing.
fn height_m(number: usize, t_s: f64) -> f64 {
    if number <= 47 { 11_230.0 - 88.0 * t_s } else { 1_990.0 - 51.3 * (t_s - 104.807) }
}

struct Photograph {
    number: usize,
    height_m: f64,
    picture: GrayImage,
}

/// Frames 19 to 70 of the folder in `OPNAV_LCAM`; `None` without it.
fn photographs() -> Option<Vec<Photograph>> {
    let folder = PathBuf::from(std::env::var_os("OPNAV_LCAM")?).join("cam0");
    let list = std::fs::read_to_string(folder.join("data.csv")).ok()?;
    let read = |(index, line): (usize, &str)| {
        let (t_ns, name) = line.split_once(',')?;
        let picture = image::open(folder.join("data").join(name)).ok()?.to_luma8();
        let [left, top] = CORNER_PX;
        let picture = imageops::crop_imm(&picture, left, top, EDGE_PX, EDGE_PX).to_image();
        let number = index + 1;
        Some(Photograph { number, height_m: height_m(number, t_ns.parse::<f64>().ok()? * 1e-9), picture })
    };
    list.lines().skip(1).enumerate().skip(18).take(52).map(read).collect()
}

/// The ground from a height, with the camera, the Sun and the noise of the landing.
fn rendered(renderer: &mut Renderer, terrain: &Terrain, number: usize, height_m: f64) -> GrayImage {
    let rotation = Matrix3::from_columns(&[Vector3::x(), -Vector3::y(), -Vector3::z()]);
    let along_m = 0.35 * height_m;
    let eye = Vector3::new(600.0 + along_m, -900.0 - 0.4 * along_m, 0.0);
    let eye = eye + Vector3::z() * (height_m + terrain.height_m(eye.x, eye.y));
    // Mid-afternoon, as on 18 February 2021.
    let (azimuth_rad, elevation_rad) = (150.0_f64.to_radians(), 31.0_f64.to_radians());
    let across = elevation_rad.cos();
    let sun = Vector3::new(across * azimuth_rad.cos(), across * azimuth_rad.sin(), elevation_rad.sin());
    let view = View {
        t_ns: number as i64,
        reference_from_camera: Isometry3::from_parts(eye.into(), UnitQuaternion::from_matrix(&rotation)),
        sun_in_reference: Unit::new_normalize(sun),
        sun_angular_radius_rad: sun_angular_radius_rad(1.59),
    };
    // A signal-to-noise ratio of 80 at half full well.
    let config = SensorConfig { full_well_electrons: 12_800.0, ..SensorConfig::default() };
    let frame = renderer.render(&view).expect("a picture");
    let picture = Detector::new(&camera(), &config, 1, 0).expose(&frame, view.t_ns);
    picture.to_image().expect("a picture").to_luma8()
}

/// Slope of the spectrum, kurtosis of gradients, spread of grey levels, number of Harris features.
fn row(picture: &GrayImage) -> [f64; 4] {
    let statistics = ImageStatistics::of(picture).expect("a picture with texture");
    let detector = DetectorConfig { max_features: 100_000, max_peak_width_px: 1e9, ..DetectorConfig::default() };
    let features = detect_features(picture, None, &detector).expect("features").len();
    let ImageStatistics { spectrum_slope, gradient_kurtosis, grey_spread_dn } = statistics;
    [spectrum_slope, gradient_kurtosis, grey_spread_dn, features as f64]
}

fn contact_sheet(pairs: &[(GrayImage, GrayImage)], path: &Path) {
    let (columns, rows) = (2 * 4, pairs.len().div_ceil(4) as u32);
    let mut sheet = GrayImage::new(columns * EDGE_PX, rows * EDGE_PX);
    for (index, (left, right)) in (0..).zip(pairs) {
        let (x, y) = (i64::from(2 * (index % 4) * EDGE_PX), i64::from(index / 4 * EDGE_PX));
        imageops::replace(&mut sheet, left, x, y);
        imageops::replace(&mut sheet, right, x + i64::from(EDGE_PX), y);
    }
    sheet.save(path).expect("the sheet is written");
}

#[test]
#[ignore = "a minute, and needs photographs that have no licence"]
fn accuracy_realism() {
    let Some(photographs) = photographs() else {
        println!("skipped: set OPNAV_LCAM to a folder with the frames of the landing camera of Mars 2020");
        return;
    };
    let terrain = Terrain::new(&TerrainConfig::default(), 1);
    let camera = camera();
    let gpu = Gpu::new(None).expect("a graphics adapter");
    let mut renderer =
        Renderer::new(&gpu, World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("a renderer");
    println!("frame height m |  slope of spectrum | gradient kurtosis |  grey spread dn   | Harris features");
    println!("               | photo     rendered | photo    rendered | photo    rendered | photo   rendered");
    let (mut real, mut made, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
    for photo in &photographs {
        let picture = rendered(&mut renderer, &terrain, photo.number, photo.height_m);
        let (a, b) = (row(&photo.picture), row(&picture));
        println!(
            "{:5} {:8.0} | {:8.3} {:9.3} | {:8.2} {:8.2} | {:8.1} {:8.1} | {:8.0} {:8.0}",
            photo.number, photo.height_m, a[0], b[0], a[1], b[1], a[2], b[2], a[3], b[3]
        );
        real.push(a);
        made.push(b);
        if pairs.len() < 12 && (photo.number - 19) % 4 == 0 {
            pairs.push((photo.picture.clone(), picture));
        }
    }
    if let Some(path) = std::env::var_os("OPNAV_LCAM_SHEET") {
        contact_sheet(&pairs, Path::new(&path));
    }
    let names = ["slope of the spectrum", "kurtosis of gradients", "spread of grey levels", "Harris features"];
    let mut inside_all = true;
    for (column, name) in names.iter().enumerate() {
        let low = real.iter().map(|r| r[column]).fold(f64::INFINITY, f64::min);
        let high = real.iter().map(|r| r[column]).fold(f64::NEG_INFINITY, f64::max);
        let values = made.iter().map(|r| r[column]);
        let (least, most) =
            (values.clone().fold(f64::INFINITY, f64::min), values.clone().fold(f64::NEG_INFINITY, f64::max));
        let inside = values.filter(|v| (low..=high).contains(v)).count();
        println!(
            "{name}: photographs {low:.2} to {high:.2}, rendered {least:.2} to {most:.2}, {inside} of {} inside",
            made.len()
        );
        inside_all &= inside == made.len();
    }
    assert!(inside_all, "rendered pictures leave the range of the photographs");
}
