//! Points whose corners are not found again go on by their patches, as long as there is the same ground.

use super::sequences::{camera, config, frame, gyro, on_ground, pixel_at, t_ns, write};
use crate::vision::pair::bearings::median;
use crate::vision::texture::picture;
use image::GrayImage;
use nalgebra::Vector2;
use opnav::observations::*;
use opnav::vision::*;
use std::collections::HashMap;

const IMAGES: usize = 8;

fn tracked(pictures: impl Iterator<Item = GrayImage>, follow_lost: bool) -> FrontEnd {
    let folder = tempfile::tempdir().expect("a folder");
    let sequence = write(folder.path(), pictures);
    let klt = KltConfig { follow_lost, ..KltConfig::default() };
    let inputs = TrackInputs { rotation_prior: Some(&gyro), ..TrackInputs::default() };
    track_sequence(&sequence, &FrontEndConfig { klt, ..config() }, &inputs, &|_| ()).expect("tracked")
}

fn tracks(found: &FrontEnd) -> HashMap<u64, Vec<&TrackObservation>> {
    let mut tracks: HashMap<u64, Vec<&TrackObservation>> = HashMap::new();
    found.observations.iter().for_each(|o| tracks.entry(o.track_id).or_default().push(o));
    tracks
}

fn mean_length(found: &FrontEnd) -> f64 {
    found.observations.len() as f64 / tracks(found).len() as f64
}

/// Distances in px of the observations from where the ground point of each track's first one is, and their 1σ.
fn errors_px(found: &FrontEnd) -> (Vec<f64>, Vec<f64>) {
    let mut all = (Vec::new(), Vec::new());
    for track in tracks(found).values() {
        let place = on_ground(track[0].t_ns, track[0].pixel_px);
        for o in &track[1..] {
            all.0.push((pixel_at(o.t_ns, place) - o.pixel_px).norm());
            all.1.push(o.sigma_px);
        }
    }
    all
}

#[test]
fn tracks_are_longer_and_no_less_exact() {
    let [matched, followed] = [false, true].map(|follow| tracked((0..IMAGES).map(frame), follow));
    let (short, long) = (mean_length(&matched), mean_length(&followed));
    assert!(long > 1.3 * short, "{long} pictures a track, {short} by corners alone");
    let [(by_corners, _), (errors, sigma)] = [&matched, &followed].map(errors_px);
    let (by_corners, errors, sigma) = (median(by_corners), median(errors), median(sigma));
    assert!(errors < 1.5 * by_corners + 0.02, "{errors} px, {by_corners} px by corners alone");
    assert!(errors < 3.0 * 1.177 * sigma, "{errors} px at sigma {sigma} px");
    let adjacent = |found: &FrontEnd| found.rotations[..IMAGES - 1].to_vec();
    assert_eq!(adjacent(&matched), adjacent(&followed), "adjacent pairs are solved before");
    let in_order = |w: &[TrackObservation]| (w[0].t_ns, w[0].track_id) < (w[1].t_ns, w[1].track_id);
    assert!(followed.observations.windows(2).all(in_order), "each track once a picture, in order");
}

#[test]
fn no_track_goes_on_over_other_ground() {
    let (width, height) = camera().size_px();
    let other = |k: usize| picture(width, height, 1.0, k as u64, |p| p + Vector2::repeat(5000.0));
    let found = tracked((0..IMAGES).map(|k| if k < 4 { frame(k) } else { other(k) }), true);
    let over = |track: &&Vec<&TrackObservation>| track[0].t_ns <= t_ns(3) && track[track.len() - 1].t_ns >= t_ns(4);
    assert_eq!(tracks(&found).values().filter(over).count(), 0);
    assert!(tracks(&found).values().any(|t| t.len() == 4), "tracks reach as far as the ground does");
}
