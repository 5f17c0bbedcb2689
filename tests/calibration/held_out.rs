//! How consistent the noise model is on scenes that had no part in it.

use super::components::{MEDIAN_2, Sample, median};
use super::rotations::MEDIAN_3;
use super::scenes::{HELD_OUT, Scene, Scenes};
use super::stages::of_all;
use super::truth::Sequence;
use super::{designated, map, points};
use nalgebra::Matrix2;
use opnav::geometry::so3;
use opnav::observations::PairStatus;
use opnav::vision::*;

/// Prints, of the library's model and of another one, the medians and means of normalised squared errors over what they
/// should be: 1 is right, more is overconfident.
pub fn judge() {
    let scenes = HELD_OUT.rendered();
    let mut models = vec![("the library's".to_string(), NoiseModel::default())];
    if let Ok(path) = std::env::var("OPNAV_NOISE_MODEL") {
        let text = std::fs::read_to_string(&path).expect("the other noise model");
        models.push((path, NoiseModelFile::parse(&text).expect("a usable noise model").constants()));
    }
    for (name, model) in &models {
        println!(
            "\n{name}\n{:<44} {:>8} {:>8} {:>8}",
            "normalised squared errors over expected", "median", "mean", "count"
        );
        points_and_map(&scenes, model);
        for (kind, mode, scenes) in [
            ("rotations over ground", FrontEndMode::Auto, &scenes.stretches),
            ("rotations over descents", FrontEndMode::Auto, &scenes.flights),
            ("rotations of bodies", FrontEndMode::FixedCenter, &scenes.bodies),
        ] {
            let all = of_all(scenes, |s, _| rotation_errors(s, mode, model));
            row(kind, &all, (MEDIAN_3, 3.0));
        }
    }
}

fn row(what: &str, values: &[f64], (median_of, mean_of): (f64, f64)) {
    let fine: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let mean = fine.iter().sum::<f64>() / fine.len() as f64 / mean_of;
    println!("{what:<44} {:>8.2} {mean:>8.2} {:>8}", median(&fine) / median_of, fine.len());
}

fn normalized<const K: usize>(samples: &[Sample<K>], theta: [f64; K]) -> Vec<f64> {
    samples.iter().map(|s| s.normalized(&theta)).collect()
}

fn points_and_map(scenes: &Scenes, model: &NoiseModel) {
    let square = |x: f64| x * x;
    let corners = of_all(&scenes.stretches, |s, g| points::corner_errors(s, g, 1, model));
    let theta = [square(model.corner.change_per_px), square(model.corner.noise_factor)];
    row("corners", &normalized(&corners, theta), (MEDIAN_2, 2.0));
    let near = of_all(&scenes.stretches, |s, g| points::patch_errors(s, g, (1, &[1, 2]), model));
    let far = of_all(&scenes.flights, |s, g| points::patch_errors(s, g, (6, &[1, 2, 3]), model));
    let theta =
        [model.patch.shared_pixels, square(model.patch.floor_sigma_px), square(model.designated.scale_sigma_px)];
    row("patches, 1 s apart", &normalized(&near, theta), (MEDIAN_2, 2.0));
    row("patches, scale changed by 10 to 30 %", &normalized(&far, theta), (MEDIAN_2, 2.0));
    let drifts = of_all(&scenes.flights, |s, g| designated::drifts(s, g, model));
    row("designated point, drift", &normalized(&drifts, [square(model.designated.looks_sigma_px)]), (MEDIAN_2, 2.0));
    let of = |scene: &&Scene| {
        let map = scene.map.as_ref().expect("grounds have maps");
        map::map_errors(&Sequence::read(&scene.images), map, 0, model)
    };
    let (own, commons): (Vec<_>, Vec<_>) =
        scenes.stretches.iter().chain(&scenes.flights).collect::<Vec<_>>().iter().map(of).unzip();
    let own: Vec<Sample<1>> = own.into_iter().flatten().collect();
    row("map, points' own errors", &normalized(&own, [square(model.map.looks_sigma_px)]), (MEDIAN_2, 2.0));
    let commons: Vec<map::Common> = commons.into_iter().flatten().collect();
    let shift = |c: &map::Common| {
        let covariance =
            Matrix2::identity() * square(model.map.common_sigma_px) + Matrix2::from_diagonal(&c.variance.xy());
        c.value.xy().dot(&(covariance.try_inverse().expect("positive") * c.value.xy()))
    };
    row("map, common shift", &commons.iter().map(shift).collect::<Vec<_>>(), (MEDIAN_2, 2.0));
    let stands = |c: &map::Common| {
        square(c.value.z - model.map.standing_out) / (square(model.map.standing_out_sigma) + c.variance.z)
    };
    // Median of χ² with one degree of freedom.
    row("map, standing out", &commons.iter().map(stands).collect::<Vec<_>>(), (0.454_937, 1.0));
}

/// Normalised squared errors of all rotations that the whole front end gives.
fn rotation_errors(sequence: &Sequence, mode: FrontEndMode, model: &NoiseModel) -> Vec<f64> {
    let config = FrontEndConfig { mode, ..FrontEndConfig::default() }.with_noise_model(model);
    let found = track_sequence(&sequence.images, &config, &TrackInputs::default(), &|_| ()).expect("tracked");
    let one = |r: &opnav::observations::RelativeRotation| {
        let [from, to] = [r.t_ns_from, r.t_ns_to].map(|t| sequence.at(t).map(|p| p.reference_from_camera.rotation));
        let truth = to?.inverse() * from?;
        let error = so3::log(&(truth * r.camera_to_from_camera_from.inverse()));
        let inverse = r.covariance_rad2.try_inverse().filter(|_| r.status == PairStatus::Ok)?;
        Some(error.dot(&(inverse * error)))
    };
    found.rotations.iter().filter_map(one).collect()
}
