//! Both missions from pixels over several seeds, against their bounds.

use super::end_to_end::{dataset, estimate_tumbling, navigate_descent, value};
use crate::accuracy_bar::{Bar, check_table};
use opnav::pipeline::evaluate_result;
use std::cell::RefCell;
use tempfile::TempDir;

/// The descent of one seed. Sources of the bounds: those that the rendered reference descents keep too, horizontally 0.5 m,
/// z 6 m, 0.15 m/s, 0.05° (`accuracy_of_rendered_landings`); the designated pixel's own 0.1 px, which are 3.7 m an axis at
/// 9.4 km, and of which 4.3σ in two axes is 16 m at a chance of one in ten thousand; a tenth of a pixel of a track; and of a
/// pair as much as 0.22 px turn a camera of 256 px of focal length by, 0.05°.
fn descent_bars(seed: u64) -> (Vec<Bar>, f64) {
    let folder = TempDir::new().expect("a temporary folder");
    let images = dataset("mars_descent_small.toml", seed, folder.path());
    let result = folder.path().join("landing");
    navigate_descent(&images, &result);
    let metrics = evaluate_result(&result, &images).expect("the result is evaluated");
    let bar = |figure: &str, most: f64, unit: &'static str| {
        Bar::at_most(format!("descent {seed}: {figure}"), value(&metrics, figure).abs(), most, unit)
    };
    let bars = vec![
        bar("last_picture_from_tracked_point_horizontal_error", 0.5, "m"),
        bar("last_picture_from_tracked_point_z_error", 6.0, "m"),
        bar("last_picture_speed_error", 0.15, "m/s"),
        bar("last_picture_roll_error", 0.05, "°"),
        bar("last_picture_pitch_error", 0.05, "°"),
        bar("last_picture_horizontal_error", 16.0, "m"),
        bar("track_error_median", 0.1, "px"),
        bar("pair_rotation_error_median", 0.05, "°"),
        Bar::stated(
            format!("descent {seed}: pair_rotation_error_p95"),
            value(&metrics, "pair_rotation_error_p95"),
            "°",
        ),
    ];
    (bars, value(&metrics, "nees_per_dof_mean"))
}

/// The tumbling body of one seed. Sources of the bounds: a published simulation of pairs about a fixed centre and shooting,
/// 0.3 px and 30° of view, has pairs of 0.066° in the worst of its steps and comes to a rate of 0.10 °/s and an inertia
/// ratio of 0.016; a chain of 59 such pairs drifts by 0.066° √59 = 0.5°, which shooting has to be better than; a tenth of a
/// pixel of a track.
fn tumbling_bars(seed: u64) -> Vec<Bar> {
    let folder = TempDir::new().expect("a temporary folder");
    let images = dataset("tumbling_small.toml", seed, folder.path());
    let result = folder.path().join("tumbling");
    estimate_tumbling(&images, &result);
    let metrics = evaluate_result(&result, &images).expect("the result is evaluated");
    let bar = |figure: &str, most: f64, unit: &'static str| {
        Bar::at_most(format!("tumbling {seed}: {figure}"), value(&metrics, figure).abs(), most, unit)
    };
    let stated = |figure: &str, unit: &'static str| {
        Bar::stated(format!("tumbling {seed}: {figure}"), value(&metrics, figure), unit)
    };
    vec![
        bar("attitude_error_rms", 0.5, "°"),
        bar("rate_error_rms", 0.10, "°/s"),
        bar("worst_inertia_error", 0.016, ""),
        bar("track_error_median", 0.1, "px"),
        bar("pair_rotation_error_median", 0.066, "°"),
        stated("pair_rotation_error_p95", "°"),
        stated("nees_per_dof_mean", ""),
    ]
}

/// Consistency of the descents together, with the bounds that rendered reference descents keep.
fn descents_nees_bars(nees: &[f64]) -> Vec<Bar> {
    let mean = nees.iter().sum::<f64>() / nees.len() as f64;
    vec![
        Bar::at_least("descents: NEES/9, mean over the seeds", mean, 0.6, ""),
        Bar::at_most("descents: NEES/9, mean over the seeds", mean, 1.6, ""),
    ]
}

/// Errors of both missions from pixels over five seeds.
#[test]
#[ignore = "minutes: renders and navigates ten sequences"]
fn accuracy_from_pixels() {
    let nees = RefCell::new(Vec::new());
    let of_seeds = (1..=5).flat_map(|seed| {
        let (bars, nees_of_seed) = descent_bars(seed);
        nees.borrow_mut().push(nees_of_seed);
        [bars, tumbling_bars(seed)]
    });
    let of_all = std::iter::once_with(|| descents_nees_bars(&nees.borrow()));
    check_table("From pixels: the small descent's last picture, the small tumbling body's arc", of_seeds.chain(of_all));
}
