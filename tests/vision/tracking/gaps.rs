//! Pictures that cannot be used: they are named, and tracking goes on around them.

use super::sequences::*;
use crate::vision::pair::bearings::angle_deg;
use image::{GrayImage, Luma};
use opnav::dataset::ImageSequence;
use opnav::observations::*;
use opnav::vision::*;
use std::path::Path;

fn run(sequence: &ImageSequence) -> FrontEnd {
    let inputs = TrackInputs { rotation_prior: Some(&gyro), ..TrackInputs::default() };
    track_sequence(sequence, &config(), &inputs, &|_| ()).unwrap()
}

fn replace(folder: &Path, k: usize, picture: &GrayImage) {
    picture.save(folder.join(format!("cam0/data/{}.png", t_ns(k)))).unwrap();
}

/// Seven pictures of which numbers 2 and 4 cannot be used.
fn with_gaps(folder: &Path, spoil: impl Fn(&ImageSequence)) -> FrontEnd {
    let sequence = write(folder, (0..7).map(frame));
    spoil(&sequence);
    run(&sequence)
}

/// Every pair of adjacent pictures has a row, and the pairs over the gaps have the right rotation.
fn assert_goes_on_around(result: &FrontEnd, status: FrameStatus) {
    let statuses: Vec<FrameStatus> = result.frames.iter().map(|f| f.status).collect();
    let expected = [0, 1, 2, 3, 4, 5, 6].map(|k| if k == 2 || k == 4 { status } else { FrameStatus::Ok });
    assert_eq!(statuses, expected);
    for (k, pair) in result.rotations[..6].iter().enumerate() {
        assert_eq!((pair.t_ns_from, pair.t_ns_to), (t_ns(k), t_ns(k + 1)));
        let usable = expected[k] == FrameStatus::Ok && expected[k + 1] == FrameStatus::Ok;
        assert_eq!(pair.status, if usable { PairStatus::Ok } else { PairStatus::NoFeatures }, "pair {k}");
        assert!(usable || (pair.model == RotationModel::None && pair.matches == 0), "pair {k}");
    }
    for (from, to) in [(1, 3), (3, 5)] {
        let pair = result.rotations[6..].iter().find(|r| (r.t_ns_from, r.t_ns_to) == (t_ns(from), t_ns(to)));
        let pair = pair.expect("a pair over the gap");
        assert_eq!(pair.status, PairStatus::Ok);
        assert!(angle_deg(&true_rotation(from, to), &pair.camera_to_from_camera_from) < 0.15);
    }
    let others = &result.rotations[6..];
    assert!(others.windows(2).all(|w| (w[0].t_ns_from, w[0].t_ns_to) < (w[1].t_ns_from, w[1].t_ns_to)));
    let seen = |k: usize| result.observations.iter().filter(|o| o.t_ns == t_ns(k)).map(|o| o.track_id).collect();
    let (before, after): (Vec<u64>, Vec<u64>) = (seen(1), seen(5));
    assert!(before.iter().filter(|id| after.contains(id)).count() > 50, "tracks go on over both gaps");
    assert!(seen(2).is_empty() && seen(4).is_empty());
}

#[test]
fn images_that_cannot_be_read_are_outcomes() {
    let folder = tempfile::tempdir().unwrap();
    let result = with_gaps(folder.path(), |s| {
        std::fs::write(&s.frames[2].path, b"not a picture").unwrap();
        std::fs::remove_file(&s.frames[4].path).unwrap();
    });
    assert_goes_on_around(&result, FrameStatus::Unreadable);
    for (k, words) in [(2, "the picture cannot be read"), (4, "could not read")] {
        let problem = result.frames[k].problem.as_ref().expect("a problem");
        assert!(problem.contains(&format!("{}.png", t_ns(k))) && problem.contains(words), "{problem}");
    }
}

#[test]
fn images_of_another_size_are_outcomes() {
    let folder = tempfile::tempdir().unwrap();
    let small = image::imageops::thumbnail(&frame(2), 160, 160);
    let result = with_gaps(folder.path(), |_| {
        replace(folder.path(), 2, &small);
        replace(folder.path(), 4, &GrayImage::new(1, 1));
    });
    assert_goes_on_around(&result, FrameStatus::WrongSize);
    let problem = result.frames[2].problem.as_ref().expect("a problem");
    assert!(problem.contains("is 160x160 px, but its camera is 320x320 px"), "{problem}");
}

#[test]
fn black_and_white_images_are_outcomes() {
    let folder = tempfile::tempdir().unwrap();
    let result = with_gaps(folder.path(), |_| {
        replace(folder.path(), 2, &GrayImage::new(SIDE, SIDE));
        replace(folder.path(), 4, &GrayImage::from_pixel(SIDE, SIDE, Luma([255])));
    });
    assert_goes_on_around(&result, FrameStatus::NoFeatures);
    assert!(result.frames.iter().all(|f| f.problem.is_none()));
}

#[test]
fn a_sequence_without_any_feature_is_an_outcome() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = write(folder.path(), (0..3).map(|_| GrayImage::new(SIDE, SIDE)));
    for mode in [FrontEndMode::Auto, FrontEndMode::FixedCenter] {
        let config = FrontEndConfig { mode, ..config() };
        let result = track_sequence(&sequence, &config, &TrackInputs::default(), &|_| ()).unwrap();
        assert!(result.rotations.iter().all(|r| r.status == PairStatus::NoFeatures) && result.rotations.len() == 2);
        assert!(result.observations.is_empty());
    }
}

#[test]
fn a_sequence_of_which_one_image_is_left_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = write(folder.path(), (0..3).map(frame));
    for k in [0, 2] {
        std::fs::write(&sequence.frames[k].path, b"not a picture").unwrap();
    }
    let error = track_sequence(&sequence, &config(), &TrackInputs::default(), &|_| ()).unwrap_err().to_string();
    assert!(error.starts_with("at least two pictures are needed, and 1 of the 3 selected can be used"), "{error}");
    assert!(error.contains(&format!("{}.png: the picture cannot be read", t_ns(0))), "{error}");
}
