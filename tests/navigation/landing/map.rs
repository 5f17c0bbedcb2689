//! Points of a map make yaw observable.

use super::descent::normal3;
use super::flight::{FLIGHT, camera, fly, truth_at_ns};
use super::flown::{error, land, last_of, mean};
use nalgebra::{Vector2, Vector3};
use opnav::navigation::landing::{KnownSighting, LandingConfig, LandingInput};
use opnav::stats::random_stream;

/// Sightings of points of a map make yaw observable and tie the height; points that are off by more than they claim are
/// gated, not believed.
#[test]
fn a_map_makes_yaw_observable() {
    let with_map = |run: u64, off_m: f64| {
        let mut input = fly(&FLIGHT, run);
        let mut random = random_stream(17, "map", run);
        let (camera, lander_from_camera) = camera();
        let sigma_point_m = 1.0;
        let points: Vec<Vector3<f64>> = (0..60)
            .map(|k| {
                let spread = 2500.0 * (f64::from(k + 1) / 60.0).powi(2);
                let angle = f64::from(k) * 2.4;
                Vector3::new(spread * angle.cos(), spread * angle.sin(), 0.0)
            })
            .collect();
        let charted: Vec<Vector3<f64>> =
            points.iter().map(|p| p + normal3(&mut random, sigma_point_m) + Vector3::x() * off_m).collect();
        for t_ns in input.frame_times_ns.clone() {
            let now = truth_at_ns(t_ns);
            let mut seen = 0;
            // The outermost first: they tell yaw best.
            for (point_m, charted_m) in points.iter().zip(&charted).rev() {
                let in_lander = now.lander_from_site * (point_m - now.position_m);
                let Some(pixel) = camera.project(&lander_from_camera.inverse_transform_point(&in_lander.into()).coords)
                else {
                    continue;
                };
                if seen < 8 && camera.contains(&pixel, 5.0) {
                    seen += 1;
                    let noise = normal3(&mut random, 0.2);
                    input.known.push(KnownSighting {
                        t_ns,
                        pixel_px: pixel + Vector2::new(noise.x, noise.y),
                        sigma_px: 0.2,
                        point_in_site_m: *charted_m,
                        sigma_point_m,
                    });
                }
            }
        }
        input
    };
    let inputs: Vec<_> = (0..8).map(|run| with_map(run, 0.0)).collect();
    let last = last_of(&inputs, &LandingConfig::default());
    let rms = |k: usize| mean(&last, |e| error(e)[k].powi(2)).sqrt();
    assert!(rms(8) < 5e-3 && rms(2) < 1.5, "yaw {} rad, z {} m", rms(8), rms(2));
    assert!(last.iter().any(|e| e.known_points > 0) || inputs[0].known.last().is_some_and(|k| k.t_ns > 0));
    let without: Vec<_> = (0..8).map(|run| fly(&FLIGHT, run)).collect();
    assert!(mean(&last_of(&without, &LandingConfig::default()), |e| error(e)[8].powi(2)).sqrt() > 5e-3);
    // Negative control: a map that is 300 m off is contradicted by the designated point.
    let gated = |input: &LandingInput| land(input, &LandingConfig::default()).gated;
    let (right, wrong) = (gated(&inputs[0]), gated(&with_map(0, 300.0)));
    assert!(wrong > 30 && right < 10, "{wrong} gated of a wrong map, {right} of a right one");
}
