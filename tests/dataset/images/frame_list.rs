//! Any folder of pictures: which are taken, in which order, at which times.

use super::image_file::{FOV, open};
use crate::dataset::{complaint, folder, grey, put};
use opnav::dataset::{CameraSource, DatasetError, FrameTimes, ImageSequence};
use std::path::Path;

fn timed(folder: &Path, times: FrameTimes) -> Result<Vec<i64>, DatasetError> {
    let sequence = ImageSequence::open_timed(folder, &FOV, &times)?;
    Ok(sequence.frames.iter().map(|f| f.t_ns).collect())
}

#[test]
fn the_size_of_most_images_is_the_cameras() {
    let dir = folder();
    for (name, width) in [("a1.png", 32), ("a2.png", 64), ("a3.png", 64)] {
        put(dir.path(), name, grey(width, 48));
    }
    let sequence = open(dir.path());
    assert_eq!(sequence.sensor.camera.size_px(), (64, 48));
    complaint(sequence.load(&sequence.frames[0]), &dir.path().join("a1.png"), None, &["is 32x48 px", "is 64x48 px"]);
    put(dir.path(), "a4.png", grey(32, 48));
    assert_eq!(open(dir.path()).sensor.camera.size_px(), (32, 48), "of two sizes as frequent, the first");
}

fn names(sequence: &ImageSequence) -> Vec<String> {
    sequence.frames.iter().map(|f| f.path.file_name().expect("a name").to_string_lossy().into_owned()).collect()
}

#[test]
fn hidden_files_and_other_files_are_passed_over() {
    let dir = folder();
    for name in ["frame10.png", "frame9.PNG", "._frame1.png", "notes.txt", "frame2.png.bak"] {
        put(dir.path(), name, grey(64, 48));
    }
    std::fs::create_dir(dir.path().join("frame3.png")).expect("a folder with a picture's name");
    assert_eq!(names(&open(dir.path())), ["frame9.PNG", "frame10.png"]);
}

#[test]
fn names_that_are_seconds_give_the_times() {
    let dir = folder();
    for name in ["1305031102.25.png", "1305031102.175304.png", "1305031103.0.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let sequence = open(dir.path());
    let times: Vec<i64> = sequence.frames.iter().map(|f| f.t_ns).collect();
    assert_eq!(times, [1_305_031_102_175_304_000, 1_305_031_102_250_000_000, 1_305_031_103_000_000_000]);
    assert!(sequence.notes.is_empty(), "{:?}", sequence.notes);
}

#[test]
fn names_that_are_no_increasing_times_are_refused() {
    let dir = folder();
    put(dir.path(), "1403636579763555584.png", grey(64, 48));
    let cover = put(dir.path(), "cover.png", grey(64, 48));
    let words = ["its name is no time stamp", "--rate-hz or --times"];
    complaint(timed(dir.path(), FrameTimes::Folder), &cover, None, &words);
    std::fs::remove_file(&cover).expect("removed");
    let doubled = put(dir.path(), "1403636579763555584.pgm", grey(64, 48));
    let words = ["has the same time stamp, 1403636579763555584 ns: remove one of them", ".png", ".pgm"];
    let first = complaint(timed(dir.path(), FrameTimes::Folder), &doubled, None, &words[..1]);
    assert!(words.iter().all(|word| first.contains(word)), "{first}");
}

#[test]
fn a_rate_spaces_the_images() {
    let dir = folder();
    for name in ["a1.png", "a2.png", "a10.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    assert_eq!(timed(dir.path(), FrameTimes::RateHz(30.0)).expect("times"), [0, 33_333_333, 66_666_667]);
    let camera = "resolution: [64, 48]\nintrinsics: [60.0, 60.0, 31.5, 23.5]\nrate_hz: 20\n";
    let file = put(dir.path(), "sensor.yaml", camera);
    let sequence = ImageSequence::open(dir.path(), &CameraSource::File(file)).expect("a sequence");
    assert_eq!(sequence.frames[2].t_ns, 100_000_000);
    assert_eq!(sequence.notes, ["no time stamps found: 20 pictures a second, as the camera file says"]);
    assert!(open(dir.path()).notes[0].contains("1 s apart"));
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        complaint(timed(dir.path(), FrameTimes::RateHz(rate)), dir.path(), None, &["is not a positive number"]);
    }
}

#[test]
fn a_list_gives_order_and_times() {
    let dir = folder();
    for name in ["x.png", "y.png", "z.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let lists = [
        "#timestamp [ns],filename\n5,z.png\n7,x.png\n",
        "timestamp,filename\r\n5,z.png\r\n7,x.png\r\n",
        "# seconds, as in other data sets\n0.000000005 z.png\n0.000000007 x.png",
        "5\tz.png\n\n7\tx.png",
    ];
    for text in lists {
        let list = put(dir.path(), "list.csv", text);
        let sequence = ImageSequence::open_timed(dir.path(), &FOV, &FrameTimes::List(list)).expect("a sequence");
        assert_eq!(names(&sequence), ["z.png", "x.png"]);
        assert_eq!(sequence.frames.iter().map(|f| f.t_ns).collect::<Vec<_>>(), [5, 7], "{text}");
    }
}

#[test]
fn bad_lists_are_refused_with_the_line_and_a_lost_image_is_not() {
    let dir = folder();
    for name in ["x.png", "z.png"] {
        put(dir.path(), name, grey(64, 48));
    }
    let cases = [
        (
            "5,x.png\n5,z.png\n",
            Some(2),
            "time stamp 5 ns does not come after the one before it: sort the rows and remove",
        ),
        ("#t\n5,x.png\n4,z.png\n", Some(3), "does not come after"),
        (
            "5,x.png\nnoon,z.png\n",
            Some(2),
            "'noon' is not a time stamp: write whole nanoseconds, or seconds with a point",
        ),
        ("5,x.png\n99999999999999999999,z.png\n", Some(2), "is not a time stamp"),
        ("-9223372036854775808,x.png\n9,z.png\n", Some(1), "is not a time stamp"),
        ("5,x.png\n4611686018427387905,z.png\n", Some(2), "is not a time stamp"),
        ("5,x.png\n6,\n", Some(2), "'timestamp [ns],filename' expected"),
        ("5,u.png\n6,v.png\n", None, "none of its 2 pictures exists, such as"),
    ];
    for (text, line, word) in cases {
        let list = put(dir.path(), "list.csv", text);
        complaint(timed(dir.path(), FrameTimes::List(list.clone())), &list, line, &[word]);
    }
    let nowhere = dir.path().join("nowhere.csv");
    complaint(timed(dir.path(), FrameTimes::List(nowhere.clone())), &nowhere, None, &["is missing"]);
    let list = put(dir.path(), "list.csv", "1,x.png\n2,lost.png\n3,z.png\n");
    let sequence = ImageSequence::open_timed(dir.path(), &FOV, &FrameTimes::List(list)).expect("a sequence");
    complaint(sequence.load(&sequence.frames[1]), &sequence.frames[1].path, None, &["could not read"]);
}
