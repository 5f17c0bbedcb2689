//! The light of a point, wherever it lies between pixels, after optics that are out of focus.

use super::{Bar, Extent, check};
use nalgebra::{UnitQuaternion, Vector2};
use opnav::geometry::Camera;
use opnav::render::{Detector, RenderedFrame, add_stars};
use opnav::scene::{Exposure, SensorConfig, Sky, Star};
use opnav::stats::random_stream;
use rand::RngExt;

const SIDE_PX: u32 = 72;
const RADII_PX: [f64; 6] = [0.3, 1.0, 2.5, 6.0, 11.0, 20.0];
/// Number of the brightest pixel.
const BRIGHT: f64 = 4e4;
/// Pictures with black levels that differ by this part of a number, so that their mean is that much finer than one.
const FINER: u32 = 8;

/// Where a point may lie, and how much of its image is counted.
#[derive(Debug, Clone, Copy)]
enum Count {
    /// In the middle of the picture; all of it.
    Whole,
    /// In the middle; what lies within this share of the disc's radius, as of a kernel that is cut off.
    Within(f64),
    /// Nearer to the picture's edge than the radius; all of it.
    AtTheEdge,
}

/// Sum of the numbers that a point of the light 1 makes without black level.
fn all_numbers(radius_px: f64) -> f64 {
    BRIGHT * (std::f64::consts::PI * radius_px * radius_px).max(1.0)
}

/// No noise, 16 bits, one number an electron.
fn sensor(radius_px: f64, psf_sigma_px: f64) -> SensorConfig {
    SensorConfig {
        noise: false,
        bits: 16,
        electrons_per_dn: Some(1.0),
        full_well_electrons: 65_535.0,
        exposure: Exposure::Fixed { electrons_per_radiance: all_numbers(radius_px) },
        defocus_radius_px: radius_px,
        psf_sigma_px,
        ..SensorConfig::default()
    }
}

/// A black picture with one point of the light 1.
fn point(camera: &Camera, pixel: &Vector2<f64>) -> RenderedFrame {
    let count = (SIDE_PX * SIDE_PX) as usize;
    let mut frame = RenderedFrame {
        width_px: SIDE_PX,
        height_px: SIDE_PX,
        radiance: vec![0.0; count],
        depth_m: vec![f32::INFINITY; count],
        mask: vec![0; count],
        surface: None,
    };
    let star = Star { direction: camera.unproject(pixel).expect("a pinhole"), magnitude: 0.0 };
    let sky = Sky { stars: vec![star], zero_point_if_px: Some(1.0), sun_distance_au: 1.0 };
    add_stars(&mut frame, camera, &sky, &UnitQuaternion::identity());
    frame
}

/// Largest change of a point's light, over places in a pixel and with and without blur beside the defocus.
fn lost(radius_px: f64, places: u64, count: Count) -> f64 {
    let camera = Camera::from_fov(SIDE_PX, SIDE_PX, 0.5);
    let middle = f64::from(SIDE_PX) / 2.0;
    let loss = |index: u64| {
        let mut random = random_stream(61, "defocus", index);
        let v = if matches!(count, Count::AtTheEdge) { 0.5 * radius_px } else { middle };
        let pixel = Vector2::new(middle + random.random_range(0.0..1.0), v + random.random_range(0.0..1.0));
        let config = sensor(radius_px, if index.is_multiple_of(2) { 0.0 } else { 0.7 });
        let is_counted = |i: usize| match count {
            Count::Within(share) => {
                let at = Vector2::new(f64::from(i as u32 % SIDE_PX), f64::from(i as u32 / SIDE_PX));
                (at - pixel).norm() <= share * radius_px
            }
            _ => true,
        };
        let frame = point(&camera, &pixel);
        let numbers = |k: u32| -> f64 {
            let black_level_dn = 0.5 + (f64::from(k) + 0.5) / f64::from(FINER);
            let picture = Detector::new(&camera, &SensorConfig { black_level_dn, ..config }, 1, 0).expose(&frame, 0);
            let counted = (0..picture.numbers.len()).filter(|i| is_counted(*i));
            counted.map(|i| f64::from(picture.numbers[i]) - 1.0).sum()
        };
        let found = (0..FINER).map(numbers).sum::<f64>() / f64::from(FINER);
        (found / all_numbers(radius_px) - 1.0).abs()
    };
    (0..places).map(loss).fold(0.0, f64::max)
}

fn measure(radius_px: f64, places: u64, count: Count) -> Bar {
    let what = format!("light of a point out of focus by {radius_px} px, changed by at most");
    Bar::at_most(what, lost(radius_px, places, count), 1e-4, "")
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    let places = if extent == Extent::Small { 4 } else { 40 };
    RADII_PX.iter().map(|radius_px| measure(*radius_px, places, Count::Whole)).collect()
}

#[test]
fn a_point_out_of_focus_keeps_its_light() {
    check(&bars(Extent::Small));
}

#[test]
fn light_that_is_cut_off_is_noticed() {
    for count in [Count::Within(0.97), Count::AtTheEdge] {
        let bar = measure(6.0, 2, count);
        assert!(!bar.holds(), "{count:?} passes unnoticed: {bar:?}");
    }
}

#[test]
#[ignore = "in full"]
fn in_full() {
    check(&bars(Extent::Full));
}
