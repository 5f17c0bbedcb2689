//! Parts of the spacecraft in the picture: a mask keeps features, patches and the rotation off them.

use super::pair::bearings::angle_deg;
use super::texture::picture;
use super::tracking::sequences::{SIDE, config, frame, gyro, t_ns, true_rotation, write};
use image::{GrayImage, Luma};
use nalgebra::{Matrix2, Vector2};
use opnav::dataset::DesignatedPoint;
use opnav::observations::*;
use opnav::vision::*;

/// Where the leg of the lander is in every picture.
fn is_leg(u: u32, v: u32) -> bool {
    u < SIDE * 3 / 5 && v + 40 > SIDE / 2
}

/// Ground that moves, behind a leg that does not.
fn with_leg(k: usize) -> GrayImage {
    let leg = picture(SIDE, SIDE, 1.0, 77 + k as u64, |p| p * 1.3 + Vector2::repeat(900.0));
    let mut seen = frame(k);
    seen.enumerate_pixels_mut().filter(|(u, v, _)| is_leg(*u, *v)).for_each(|(u, v, p)| *p = *leg.get_pixel(u, v));
    seen
}

fn mask() -> GrayImage {
    GrayImage::from_fn(SIDE, SIDE, |u, v| Luma([if is_leg(u, v) { 0 } else { 255 }]))
}

/// What is found, and the worst error of the rotation of an adjacent pair, degrees.
fn tracked(mask: Option<&GrayImage>, rotation_prior: Option<RotationPrediction>) -> (FrontEnd, f64) {
    let folder = tempfile::tempdir().expect("a folder");
    let sequence = write(folder.path(), (0..5).map(with_leg));
    let designated = DesignatedPoint {
        t_ns: t_ns(0),
        pixel_px: Vector2::new(250.0, 230.0),
        covariance_px2: Matrix2::identity() * 0.01,
    };
    let inputs = TrackInputs { mask, rotation_prior, designated: Some(designated), ..TrackInputs::default() };
    let found = track_sequence(&sequence, &config(), &inputs, &|_| ()).expect("tracked");
    let index = |t: i64| (t / 1_000_000_000 - 1) as usize;
    let error = |r: &RelativeRotation| {
        angle_deg(&true_rotation(index(r.t_ns_from), index(r.t_ns_to)), &r.camera_to_from_camera_from)
    };
    let worst_deg = found.rotations[..4].iter().map(error).fold(0.0, f64::max);
    (found, worst_deg)
}

/// Whether an observation is nearer to the leg than that, along both axes.
fn is_near_leg(o: &TrackObservation, margin_px: f64) -> bool {
    let to_leg = Vector2::new(
        (o.pixel_px.x - (f64::from(SIDE) * 0.6 - 1.0)).max(0.0),
        (f64::from(SIDE) / 2.0 - 39.0 - o.pixel_px.y).max(0.0),
    );
    to_leg.amax() < margin_px
}

#[test]
fn nothing_is_tracked_on_a_masked_leg() {
    let mask = mask();
    let (masked, worst_deg) = tracked(Some(&mask), Some(&gyro));
    // The patch about a feature, 10 px to each side, must stay clear too; a track may part from its corner by 3 px.
    let near = |found: &FrontEnd, margin_px| found.observations.iter().filter(|o| is_near_leg(o, margin_px)).count();
    assert_eq!(near(&masked, 9.5), 0);
    assert!(near(&masked, 40.0) > 10, "the ground beside the leg is used");
    assert!(masked.rotations[..4].iter().all(|r| r.status == PairStatus::Ok) && worst_deg < 0.2, "{worst_deg} degrees");
    assert_eq!(masked.designated.len(), 5);

    assert_eq!(near(&tracked(Some(&mask), None).0, 9.5), 0, "not without a prediction either");
    let open = tracked(None, None).0;
    assert!(near(&open, 0.5) > 100, "without the mask, the leg is tracked: {}", near(&open, 0.5));
}

#[test]
fn a_mask_that_leaves_everything_changes_nothing() {
    let all = GrayImage::from_pixel(SIDE, SIDE, Luma([1]));
    let (open, masked) = (tracked(None, None).0, tracked(Some(&all), None).0);
    assert_eq!(open.observations, masked.observations);
    assert_eq!(open.rotations, masked.rotations);
}

#[test]
fn a_mask_of_another_size_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let sequence = write(folder.path(), (0..2).map(frame));
    let refused = |mask: &GrayImage| {
        let inputs = TrackInputs { mask: Some(mask), ..TrackInputs::default() };
        track_sequence(&sequence, &config(), &inputs, &|_| ()).expect_err("refused").to_string()
    };
    let error = refused(&GrayImage::from_pixel(SIDE, SIDE - 1, Luma([1])));
    assert!(error.contains("320x319") && error.contains("320x320"), "{error}");
    assert!(refused(&GrayImage::new(SIDE, SIDE)).contains("nothing to look at"));
}
