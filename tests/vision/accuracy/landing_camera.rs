//! A real descent: the landing camera of Mars 2020, 87 photographs from 11 km to the ground, without truth.
//!
//! What is judged is what can be judged without truth: how many pairs are accepted, whether the rotations of three
//! pictures close, and that nothing is claimed of pictures that show no ground.

use crate::accuracy_bar::{Bar, check_table};
use nalgebra::UnitQuaternion;
use opnav::dataset::{CameraSource, ImageSequence};
use opnav::evaluation::percentile;
use opnav::observations::*;
use opnav::vision::*;
use std::ops::RangeInclusive;
use std::path::Path;

/// Pairs (by the number of the first picture, from 1) that show no ground: vignetting alone, then the heat shield.
const BEFORE_THE_GROUND: RangeInclusive<usize> = 1..=4;
/// Pairs in which the engines' dust covers the ground.
const IN_THE_DUST: RangeInclusive<usize> = 75..=81;
/// Pictures with ground throughout, close enough in time for loops.
const LOOPS: RangeInclusive<usize> = 26..=70;

struct Descent {
    times_ns: Vec<i64>,
    rotations: Vec<RelativeRotation>,
}

impl Descent {
    /// The pair of pictures `from` and `to`, numbered from 1.
    fn pair(&self, from: usize, to: usize) -> Option<&RelativeRotation> {
        let times = (self.times_ns[from - 1], self.times_ns[to - 1]);
        self.rotations.iter().find(|r| (r.t_ns_from, r.t_ns_to) == times)
    }

    fn accepted(&self, from: usize, to: usize) -> Option<UnitQuaternion<f64>> {
        self.pair(from, to).filter(|r| r.status == PairStatus::Ok).map(|r| r.camera_to_from_camera_from)
    }

    fn accepted_among(&self, firsts: RangeInclusive<usize>) -> f64 {
        firsts.filter(|k| self.accepted(*k, k + 1).is_some()).count() as f64
    }

    /// By how much the rotations of three pictures in a row do not close, degrees; and by how much if the second were the
    /// wrong way round.
    fn loop_deg(&self, first: usize) -> Option<[f64; 2]> {
        let [a, b, c] =
            [(first, first + 1), (first + 1, first + 2), (first, first + 2)].map(|(i, j)| self.accepted(i, j));
        let (a, b, c) = (a?, b?, c?);
        Some([b, b.inverse()].map(|b| (b * a).angle_to(&c).to_degrees()))
    }
}

fn descent(folder: &Path, descriptor: DescriptorKind) -> Descent {
    let sequence = ImageSequence::open(folder, &CameraSource::Folder).expect("the folder named by OPNAV_LCAM");
    let mut config = FrontEndConfig::default();
    config.matcher.descriptor = descriptor;
    let result = track_sequence(&sequence, &config, &TrackInputs::default(), &|_| ()).expect("tracks");
    Descent { times_ns: result.frames.iter().map(|f| f.t_ns).collect(), rotations: result.rotations }
}

fn bars(descent: &Descent) -> Vec<Bar> {
    let (loops, reversed): (Vec<f64>, Vec<f64>) = (*LOOPS.start()..=LOOPS.end() - 2)
        .filter_map(|k| descent.loop_deg(k))
        .map(|[right, wrong]| (right, wrong))
        .unzip();
    let share = |share: f64| percentile(&loops, share).unwrap_or(f64::NAN);
    let wrong = percentile(&reversed, 0.5).unwrap_or(f64::NAN);
    let worst = loops.iter().copied().fold(0.0, f64::max);
    vec![
        Bar::at_least("consecutive pairs accepted, of 86", descent.accepted_among(1..=86), 60.0, "pairs"),
        Bar::at_most("accepted before the ground shows, of 4", descent.accepted_among(BEFORE_THE_GROUND), 0.0, "pairs"),
        Bar::at_most("accepted in the engines' dust, of 7", descent.accepted_among(IN_THE_DUST), 0.0, "pairs"),
        Bar::at_least("loops of three, of 43, whose pairs are accepted", loops.len() as f64, 30.0, "loops"),
        Bar::at_most("loops of three, pictures 26 to 70: median", share(0.5), 0.04, "degrees"),
        Bar::at_most("loops of three, pictures 26 to 70: 90th percentile", share(0.9), 0.5, "degrees"),
        Bar::stated("loops of three, pictures 26 to 70: worst", worst, "degrees"),
        Bar::at_least("the same loops with a pair the wrong way round: median", wrong, 1.0, "degrees"),
    ]
}

#[test]
#[ignore = "needs photographs that have no licence"]
fn accuracy_on_a_real_descent() {
    let Some(folder) = std::env::var_os("OPNAV_LCAM") else {
        println!("skipped: set OPNAV_LCAM to a folder with the frames of the landing camera of Mars 2020");
        return;
    };
    let table = |descriptor| {
        let descent = descent(Path::new(&folder), descriptor);
        assert_eq!(descent.times_ns.len(), 87, "these are not the 87 frames of the descent");
        bars(&descent)
    };
    check_table("Landing camera of Mars 2020", std::iter::once_with(|| table(DescriptorKind::Orb)));
    // What SIFT reaches is told and not promised.
    let sift = || table(DescriptorKind::Sift).into_iter().map(Bar::without_bound).collect();
    check_table("The same by SIFT", std::iter::once_with(sift));
}
