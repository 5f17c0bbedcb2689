//! The fits, one after the other.

use super::components::{Sample, fit_with_intervals, intervals, median, robust_sigma};
use super::matches::{Pairing, TruePair, true_pairs};
use super::rotations::{self, Constants, Measured, Solved};
use super::scenes::{FIT, Scene, Scenes};
use super::sheet::Found;
use super::truth::Sequence;
use super::{designated, map, points};
use nalgebra::{Unit, Vector2, Vector3};
use opnav::vision::*;
use rayon::prelude::*;
use std::time::Instant;

const GROUNDS: &str =
    "four grounds, Sun 27 to 58° high, stretches at six heights from 5.5 km to 50 m and descents of 60 images";
const VALID: &str =
    "768² and 1024² px, well of 1500 to 20000 electrons (noise 1 to 7 DN), blur 0.5 to 0.8 px, 50 m to 5.5 km";
const BODIES: &str = "four procedural bodies, phase 15 to 55°, turning by 3 to 7° an image";

/// Where the fits start, whatever the file says: so the same seed gives the same bytes again.
const START: NoiseModel = NoiseModel {
    corner: CornerNoise { change_per_px: 0.015, noise_factor: 0.9 },
    patch: PatchNoise { shared_pixels: 2.7, floor_sigma_px: 0.02 },
    pair: PairNoise { correlated_error_share: 7e-4, growth_by_view: 360.0, far_view: 0.03, over_likeliest: 3.3 },
    body: BodyNoise { correlated_error_share: 1.8e-3, over_likeliest: 2.0 },
    designated: DesignatedNoise { looks_sigma_px: 0.1, scale_sigma_px: 0.3, common_share: 0.3 },
    map: MapNoise {
        looks_sigma_px: 0.1,
        common_sigma_px: 0.05,
        standing_out: 0.1,
        standing_out_sigma: 0.1,
        shared_ln_scale: 0.14,
    },
};

/// A stage: fits constants on scenes, by those that are fitted already, and tells them.
type Stage = fn(&Scenes, &mut NoiseModel, &mut Vec<Found>);

/// Runs every stage.
pub fn run() -> Vec<Found> {
    let scenes = FIT.rendered();
    let (mut model, mut found) = (START, Vec::new());
    let stages: [(&str, Stage); 6] = [
        ("corners", corners),
        ("patches", patches),
        ("pairs over ground", pairs),
        ("pairs of bodies", bodies),
        ("designated point", designated_point),
        ("map", maps),
    ];
    for (index, (name, stage)) in stages.into_iter().enumerate() {
        let start = Instant::now();
        println!("[{} of {}] {name}", index + 1, 6);
        stage(&scenes, &mut model, &mut found);
        println!("    {:.0} s", start.elapsed().as_secs_f64());
    }
    found
}

/// What a function makes of every scene, by its place.
pub fn of_all<T: Send>(scenes: &[Scene], of: impl Fn(&Sequence, usize) -> Vec<T> + Sync) -> Vec<T> {
    let one = |(group, scene): (usize, &Scene)| of(&Sequence::read(&scene.images), group);
    scenes.par_iter().enumerate().map(one).collect::<Vec<_>>().into_iter().flatten().collect()
}

fn say(found: &Found) {
    let [low, high] = found.interval_95;
    println!("    {:<28} {:.4} ({low:.4} to {high:.4}, {} samples)", found.key, found.value, found.samples);
}

fn add(all: &mut Vec<Found>, new: impl IntoIterator<Item = Found>) {
    for one in new {
        say(&one);
        all.push(one);
    }
}

fn corners(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let mut samples = of_all(&scenes.stretches, |s, g| points::corner_errors(s, g, 1, model));
    let count = scenes.stretches.len();
    samples.extend(of_all(&scenes.bodies, |s, g| points::corner_errors(s, count + g, 3, model)));
    let fit = fit_with_intervals(&samples, [model.corner.change_per_px, model.corner.noise_factor], "corners");
    [model.corner.change_per_px, model.corner.noise_factor] = fit.sigma;
    let source = format!(
        "weighted medians of the errors of Harris corners found again in the next image against true depth and pose; {GROUNDS}; {BODIES}"
    );
    let both = ["corner.change_per_px", "corner.noise_factor"].into_iter().enumerate();
    add(
        found,
        both.map(|(k, key)| Found {
            key,
            value: fit.sigma[k],
            interval_95: fit.intervals[k],
            samples: fit.samples,
            source: source.clone(),
            validity: format!("{VALID}; changes of view of 0.5 to 8 % an image"),
        }),
    );
}

fn patches(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let mut samples: Vec<Sample<3>> = of_all(&scenes.stretches, |s, g| points::patch_errors(s, g, (1, &[1, 4]), model));
    let count = scenes.stretches.len();
    samples.extend(of_all(&scenes.flights, |s, g| points::patch_errors(s, count + g, (6, &[1, 2, 3]), model)));
    let start = [model.patch.shared_pixels.sqrt(), model.patch.floor_sigma_px, model.designated.scale_sigma_px];
    let fit = fit_with_intervals(&samples, start, "patches");
    let value = [fit.sigma[0].powi(2), fit.sigma[1], fit.sigma[2]];
    [model.patch.shared_pixels, model.patch.floor_sigma_px, model.designated.scale_sigma_px] = value;
    let square = |[low, high]: [f64; 2]| [low.powi(2), high.powi(2)];
    let interval = [square(fit.intervals[0]), fit.intervals[1], fit.intervals[2]];
    let source = format!(
        "weighted medians of the errors of patches followed over 1 to 4 images against true depth and pose; {GROUNDS}"
    );
    let keys = ["patch.shared_pixels", "patch.floor_sigma_px", "designated.scale_sigma_px"].into_iter().enumerate();
    add(
        found,
        keys.map(|(k, key)| Found {
            key,
            value: value[k],
            interval_95: interval[k],
            samples: fit.samples,
            source: source.clone(),
            validity: format!("{VALID}; patches of 21 px; changes of scale up to 1.4"),
        }),
    );
    common_share(scenes, model, found);
}

/// `ρ σ_older σ_newer / σ_newer²` of the errors of two ties to an image, the newer one having the least variance; from
/// images of nearly the same scale, since what the looks of the ground have in common is another constant.
fn common_share(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let by_group: Vec<Vec<(f64, f64, f64)>> = scenes
        .stretches
        .par_iter()
        .map(|scene| points::shared_errors(&Sequence::read(&scene.images), 3, model))
        .collect();
    let share = |drawn: &[usize]| {
        let all: Vec<&(f64, f64, f64)> = drawn.iter().flat_map(|g| &by_group[*g]).collect();
        let [older, newer]: [Vec<f64>; 2] = [all.iter().map(|b| b.0).collect(), all.iter().map(|b| b.1).collect()];
        let [a, b] = [median(&older), median(&newer)];
        let sign = all.iter().map(|s| ((s.0 - a) * (s.1 - b)).signum()).sum::<f64>() / all.len().max(1) as f64;
        let correlation = (std::f64::consts::FRAC_PI_2 * sign).sin();
        let ratio = median(&all.iter().map(|s| s.2.sqrt()).collect::<Vec<f64>>());
        [(correlation * ratio * robust_sigma(&older) / robust_sigma(&newer)).clamp(0.0, 1.0)]
    };
    let groups: Vec<usize> = (0..by_group.len()).collect();
    let [value] = share(&groups);
    model.designated.common_share = value;
    let [interval_95] = intervals(&groups, (100, "common share"), share);
    add(
        found,
        [Found {
            key: "designated.common_share",
            value,
            interval_95,
            samples: by_group.iter().map(Vec::len).sum::<usize>() / 2,
            source: format!(
                "correlation, by signs, of the errors of a point followed into an image from the two before it; {GROUNDS}"
            ),
            validity: format!("{VALID}; patches of 21 px"),
        }],
    );
}

fn pairs(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let count = scenes.stretches.len();
    let near = Pairing { mode: FrontEndMode::Auto, spans: &[1, 3], every: 1, frames: 0..usize::MAX };
    let far = Pairing { spans: &[1, 2, 3], every: 4, frames: 16..36, ..near.clone() };
    let of = |sequence: &Sequence, group: usize, pairing: &Pairing| {
        vec![(sequence.camera, true_pairs(sequence, group, pairing, model))]
    };
    let mut all = of_all(&scenes.stretches, |s, g| of(s, g, &near));
    all.extend(of_all(&scenes.flights, |s, g| of(s, count + g, &far)));
    let measured: Vec<Measured> = all.iter().flat_map(|(_, pairs)| rotations::measured(pairs)).collect();
    let start =
        [model.pair.correlated_error_share * model.pair.over_likeliest, model.pair.growth_by_view, model.pair.far_view];
    let share = rotations::fit_share(&measured.iter().collect::<Vec<_>>(), start, true);
    println!("    true share {share:.4?} of {} pairs", measured.len());
    let solved: Vec<Solved> =
        all.par_iter().flat_map(|(camera, pairs)| rotations::over_ground(pairs, camera, share)).collect();
    let fit = rotations::constants((&measured, &solved), share, true, "pairs");
    let p = &mut model.pair;
    [p.correlated_error_share, p.growth_by_view, p.far_view, p.over_likeliest] = fit.value;
    let keys = ["pair.smooth_error_share", "pair.growth_by_view", "pair.far_view", "pair.over_likeliest"];
    add_constants(found, &fit, &keys, GROUNDS, &format!("{VALID}; translation over distance 0.015 to 0.5"));
}

fn bodies(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let all: Vec<(Sequence, Vec<TruePair>)> = scenes
        .bodies
        .par_iter()
        .enumerate()
        .map(|(group, scene)| {
            let sequence = Sequence::read(&scene.images);
            let mode = FrontEndMode::FixedCenter;
            let pairing = Pairing { mode, spans: &[1, 2, 3], every: 1, frames: 0..usize::MAX };
            let pairs = true_pairs(&sequence, group, &pairing, model);
            (sequence, pairs)
        })
        .collect();
    let measured: Vec<Measured> = all.iter().flat_map(|(_, pairs)| rotations::measured(pairs)).collect();
    let start = [model.body.correlated_error_share * model.body.over_likeliest, 1e-6, 1.0];
    let share = rotations::fit_share(&measured.iter().collect::<Vec<_>>(), start, false);
    println!("    true share {:.5} of {} pairs", share[0], measured.len());
    let solve = |(sequence, pairs): &(Sequence, Vec<TruePair>)| {
        rotations::about_center(pairs, &sequence.camera, center_guess(sequence), share[0])
    };
    let solved: Vec<Solved> = all.par_iter().flat_map(solve).collect();
    let fit = rotations::constants((&measured, &solved), share, false, "bodies");
    (model.body.correlated_error_share, model.body.over_likeliest) = (fit.value[0], fit.value[3]);
    let keys = ["body.smooth_error_share", "", "", "body.over_likeliest"];
    add_constants(
        found,
        &fit,
        &keys,
        BODIES,
        "1024² px, noise 1 to 3 DN, phase 15 to 55°, turns of 3 to 21° between images",
    );
}

/// Direction of the mean centroid of what is bright, as the front end guesses it.
fn center_guess(sequence: &Sequence) -> Unit<Vector3<f64>> {
    let centroids: Vec<Vector2<f64>> =
        sequence.pictures.iter().filter_map(|p| bright_centroid_px(&p.image).expect("OpenCV works")).collect();
    let mean = centroids.iter().sum::<Vector2<f64>>() / centroids.len() as f64;
    sequence.camera.unproject(&mean).expect("a pixel of the camera")
}

fn add_constants(found: &mut Vec<Found>, fit: &Constants, keys: &[&'static str; 4], scenes: &str, validity: &str) {
    let source = format!(
        "growth by median regression of the true smooth errors, share by the rotations' least errors, and truth over what residuals show by the median of their normalised squared errors; {scenes}"
    );
    let named = keys.iter().enumerate().filter(|(_, key)| !key.is_empty());
    add(
        found,
        named.map(|(k, key)| Found {
            key,
            value: fit.value[k],
            interval_95: fit.intervals[k],
            samples: fit.pairs,
            source: source.clone(),
            validity: validity.into(),
        }),
    );
}

fn designated_point(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let samples = of_all(&scenes.flights, |s, g| designated::drifts(s, g, model));
    let fit = fit_with_intervals(&samples, [model.designated.looks_sigma_px], "designated");
    model.designated.looks_sigma_px = fit.sigma[0];
    add(found, [Found {
        key: "designated.looks_sigma_px",
        value: fit.sigma[0],
        interval_95: fit.intervals[0],
        samples: fit.samples,
        source: "weighted medians of the drifts of eight carried points over the ground against true depth and pose, at every quarter of an e-fold of scale, what the ties' errors predict taken off; four descents of 60 images".into(),
        validity: "768² px, noise 1 to 7 DN, changes of scale of 1.11 an image, 15 m to 7 km".into(),
    }]);
}

fn maps(scenes: &Scenes, model: &mut NoiseModel, found: &mut Vec<Found>) {
    let all: Vec<&Scene> = scenes.stretches.iter().chain(&scenes.flights).collect();
    let one = |(group, scene): (usize, &&Scene)| {
        let map = scene.map.as_ref().expect("grounds have maps");
        map::map_errors(&Sequence::read(&scene.images), map, group, model)
    };
    let (own, commons): (Vec<Vec<Sample<1>>>, Vec<Vec<map::Common>>) = all.par_iter().enumerate().map(one).unzip();
    let own: Vec<Sample<1>> = own.into_iter().flatten().collect();
    let looks = fit_with_intervals(&own, [model.map.looks_sigma_px], "map looks");
    let groups: Vec<usize> = (0..commons.len()).collect();
    let of = |drawn: &[usize]| map::constants(&drawn.iter().flat_map(|g| &commons[*g]).collect::<Vec<_>>());
    let value = of(&groups);
    let interval = intervals(&groups, (100, "map common"), of);
    model.map.looks_sigma_px = looks.sigma[0];
    let m = &mut model.map;
    [m.common_sigma_px, m.standing_out, m.standing_out_sigma, m.shared_ln_scale] = value;
    let validity = format!("{VALID}; maps of 0.5 to 16 m a pixel under the images' own Sun");
    add(
        found,
        [Found {
            key: "map.looks_sigma_px",
            value: looks.sigma[0],
            interval_95: looks.intervals[0],
            samples: looks.samples,
            source: format!(
                "weighted medians of the errors of a map's points against true poses, what an image's points have in common taken off; {GROUNDS}"
            ),
            validity: validity.clone(),
        }],
    );
    let pictures = commons.iter().map(Vec::len).sum();
    let keys = ["map.common_sigma_px", "map.standing_out", "map.standing_out_sigma", "map.shared_ln_scale"];
    add(found, keys.into_iter().enumerate().map(|(k, key)| Found {
        key,
        value: value[k],
        interval_95: interval[k],
        samples: pictures,
        source: format!("medians over images of what their points have in common against true poses; the last one by the correlation of images over their change of scale, by signs; {GROUNDS}"),
        validity: validity.clone(),
    }));
}
