//! What a landing's summary says in words.

use crate::navigation::landing::PointByMap;
use crate::navigation::landing::{LandingConfig, LandingResult};

/// Everything about a navigated descent that its numbers do not say.
pub(super) fn land_notes(result: &LandingResult, config: &LandingConfig) -> Vec<String> {
    let mut notes = coasting_notes(result, config);
    notes.extend(contradiction_notes(result));
    notes.extend(gyro_note(result));
    notes.extend(result.imu_gaps.iter().map(|gap| {
        let (from_s, to_s) = in_seconds(gap.interval_ns);
        format!(
            "the IMU is silent for {:.2} s between {from_s:.2} s and {to_s:.2} s: its motion was held",
            gap.bridged_s
        )
    }));
    notes
}

/// When the designated point was left out, and when the filter was.
fn contradiction_notes(result: &LandingResult) -> Vec<String> {
    let left_out = result.stretches(|e| e.contradiction.point_is_wrong).into_iter().map(|stretch| {
        let (from_s, to_s) = in_seconds(stretch);
        format!(
            "the track of the designated point jumped to something else at {from_s:.2} s and was left out up to {to_s:.2} s"
        )
    });
    let doubted = result.stretches(|e| e.contradiction.filter_is_wrong()).into_iter().map(|stretch| {
        let (from_s, to_s) = in_seconds(stretch);
        format!(
            "filter and designated point contradicted each other up to {from_s:.2} s: the covariance was widened from \
             there to {to_s:.2} s"
        )
    });
    left_out.chain(doubted).collect()
}

/// Images in a row in which map and designated point have to contradict each other before it is said.
const IMAGES: usize = 3;

/// When a map and the designated point contradict each other, if they do.
pub(super) fn map_note(points: &[PointByMap]) -> Option<String> {
    let runs = || points.chunk_by(|a, b| a.contradicts == b.contradicts).filter(|run| run[0].contradicts);
    let run = runs().find(|run| run.len() >= IMAGES)?;
    let contradicting = runs().map(<[_]>::len).sum::<usize>();
    let seen = points.iter().filter(|p| p.normalized_squared.is_finite());
    let clearest = seen.max_by(|a, b| a.normalized_squared.total_cmp(&b.normalized_squared)).unwrap_or(&run[0]);
    let (from_s, to_s) = in_seconds((run[0].t_ns, run[run.len() - 1].t_ns));
    let at_s = clearest.t_ns as f64 * 1e-9;
    Some(format!(
        "the map and the designated point contradict each other from {from_s:.2} s to {to_s:.2} s, in {contradicting} of \
         {} pictures in all: at {at_s:.2} s the tracked point lies {:.1} m off the site's origin by the map (normalised \
         squared {:.0}, 2 degrees of freedom); map and designated pixel may belong to different places",
        points.len(),
        clearest.off_m,
        clearest.normalized_squared
    ))
}

fn in_seconds((from_ns, to_ns): (i64, i64)) -> (f64, f64) {
    (from_ns as f64 * 1e-9, to_ns as f64 * 1e-9)
}

/// When the filter flew on the IMU alone: for want of images, or since images no longer help so low.
fn coasting_notes(result: &LandingResult, config: &LandingConfig) -> Vec<String> {
    let height_at = |t_ns: i64| {
        result.epochs.iter().find(|e| e.t_ns == t_ns).map_or(f64::INFINITY, |e| e.site_from_lander.translation.z)
    };
    let note = |stretch: &(i64, i64)| {
        let (from_s, to_s) = in_seconds(*stretch);
        let lowest_m = config.minimum_image_height_m;
        let why = if height_at(stretch.1) < lowest_m {
            format!(": images are not used below {lowest_m} m, where they no longer help")
        } else {
            String::new()
        };
        format!("coasted on the IMU alone from {from_s:.2} s to {to_s:.2} s{why}")
    };
    result.coasted.iter().map(note).collect()
}

/// How well the gyroscope and the images agree, where there are images to tell.
fn gyro_note(result: &LandingResult) -> Option<String> {
    let checks: Vec<_> = result.epochs.iter().filter_map(|e| e.rotation_check).collect();
    let count = checks.len() as f64;
    let mean = checks.iter().map(|c| c.normalized_squared / 3.0).sum::<f64>() / count;
    let angle_deg = (checks.iter().map(|c| c.angle_rad.powi(2)).sum::<f64>() / count).sqrt().to_degrees();
    (!checks.is_empty()).then(|| {
        format!(
            "gyroscope against images over {} pairs: {angle_deg:.4}° r.m.s., normalised difference squared {mean:.2} a \
             degree of freedom (1 if both are as good as they claim)",
            checks.len()
        )
    })
}
