//! How far did the camera turn between two pictures?
//!
//!     cargo run --example 01_rotation_of_a_pair [FIRST.png SECOND.png FOV_DEG]
//!
//! Without arguments, two pictures of an invented surface are made, the second by a camera that has turned by 2°.

use image::{GrayImage, Luma, imageops};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::observations::PairStatus;
use opnav::vision::*;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (first, second, fov_deg) = match &arguments[..] {
        [first, second, fov_deg] => {
            (image::open(first)?.into_luma8(), image::open(second)?.into_luma8(), fov_deg.parse()?)
        }
        _ => made_images(UnitQuaternion::from_scaled_axis(
            Vector3::new(0.01, -0.02, 0.03).normalize() * 2f64.to_radians(),
        )),
    };
    let camera = Camera::from_fov(first.width(), first.height(), f64::to_radians(fov_deg));

    // Corners, each with the 1σ of its pixel, described by what surrounds them and matched by that.
    let (detector, matcher) = (DetectorConfig::default(), MatcherConfig::default());
    let from = detect_features(&first, None, &detector)?;
    let to = detect_features(&second, None, &detector)?;
    let from_words = describe_features(&first, &from, Orientation::Centroid, &matcher)?;
    let to_words = describe_features(&second, &to, Orientation::Centroid, &matcher)?;
    let matches = match_features(
        Described { features: &from, descriptors: &from_words },
        Described { features: &to, descriptors: &to_words },
        &matcher,
    )?;
    println!("{} and {} features, {} matches", from.len(), to.len(), matches.len());

    // The rotation that explains the matches best, whether the scene is flat, has relief, or is too far to tell.
    let pair = MatchedPair {
        from_px: matches.iter().map(|m| from[m.from].pixel_px).collect(),
        to_px: matches.iter().map(|m| to[m.to].pixel_px).collect(),
    };
    let sigma_px: Vec<f64> = matches.iter().map(|m| from[m.from].sigma_px.midpoint(to[m.to].sigma_px)).collect();
    let pixels = PixelMatches { pair: &pair, sigma_px: &sigma_px };
    let found = relative_rotation(pixels, &camera, &PairHints::default(), &RotationConfig::default())?;
    if found.status != PairStatus::Ok {
        return Err(format!("these pictures tell no rotation: {}", found.status.word()).into());
    }
    let turn_deg = found.camera_to_from_camera_from.scaled_axis().map(f64::to_degrees);
    let sigma_deg = found.covariance_rad2.diagonal().map(|variance| variance.sqrt().to_degrees());
    println!("{} matches agree; the camera turned by {:.4}°:", found.inlier_count(), turn_deg.norm());
    for (axis, k) in ["x", "y", "z"].iter().zip(0..) {
        println!("  about {axis}: {:8.4}° ± {:.4}°", turn_deg[k], sigma_deg[k]);
    }
    Ok(())
}

/// Two pictures of a surface at infinity, before and after a turn of the camera.
fn made_images(camera_to_from_camera_from: UnitQuaternion<f64>) -> (GrayImage, GrayImage, f64) {
    let (side_px, fov_deg) = (400, 40.0);
    let camera = Camera::from_fov(side_px, side_px, f64::to_radians(fov_deg));
    let speck =
        |x: u32, y: u32| (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77)).wrapping_mul(0xc2b2_ae3d) >> 24;
    let ground = imageops::blur(&GrayImage::from_fn(500, 500, |x, y| Luma([speck(x / 3, y / 3) as u8])), 1.5);
    let shown = |camera_from_sky: UnitQuaternion<f64>| {
        GrayImage::from_fn(side_px, side_px, |u, v| {
            let pixel = Vector2::new(f64::from(u), f64::from(v));
            let bearing = camera.unproject(&pixel).expect("a pinhole sees along every pixel");
            let at = camera.project(&(camera_from_sky.inverse() * bearing.into_inner())).expect("the turn is small");
            imageops::interpolate_bilinear(&ground, at.x as f32 + 50.0, at.y as f32 + 50.0).unwrap_or(Luma([0]))
        })
    };
    (shown(UnitQuaternion::identity()), shown(camera_to_from_camera_from), fov_deg)
}
