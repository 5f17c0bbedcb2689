//! Inertial measurements.

use super::{END_NS, STEP_NS, motion};
use nalgebra::{UnitQuaternion, Vector3};
use opnav::dataset::ImuSample;
use opnav::geometry::so3;
use opnav::scene::{ImuConfig, ideal_samples};

/// Strap-down integration; `middle` is the share of an interval's turn at which the specific force is applied.
fn integrated(samples: &[ImuSample], middle: f64) -> (UnitQuaternion<f64>, Vector3<f64>, Vector3<f64>) {
    let start = motion().state(0);
    let (mut attitude, mut velocity) = (start.site_from_lander.rotation, start.lander_velocity_in_site_m_s);
    let mut position = start.site_from_lander.translation.vector;
    let (gravity, dt_s) = (Vector3::new(0.0, 0.0, -3.711), STEP_NS as f64 * 1e-9);
    for sample in samples {
        let turn = sample.rate_in_lander_rad_s * dt_s;
        let acceleration = attitude * so3::exp(&(turn * middle)) * sample.specific_force_in_lander_m_s2 + gravity;
        position += velocity * dt_s + acceleration * (0.5 * dt_s * dt_s);
        velocity += acceleration * dt_s;
        attitude *= so3::exp(&turn);
    }
    (attitude, velocity, position)
}

#[test]
fn noise_free_samples_close_on_the_truth_at_touchdown() {
    let samples = ideal_samples(&motion(), STEP_NS, END_NS);
    assert_eq!((samples.len(), samples[0].t_ns, samples.last().unwrap().t_ns), (19_800, STEP_NS, END_NS));
    let end = motion().state(END_NS);
    let (attitude, velocity, position) = integrated(&samples, 0.5);
    let turn_rad = attitude.angle_to(&end.site_from_lander.rotation);
    let off_m_s = (velocity - end.lander_velocity_in_site_m_s).norm();
    let off_m = (position - end.site_from_lander.translation.vector).norm();
    assert!(turn_rad < 1e-6 && off_m_s < 1e-6 && off_m < 1e-3, "{turn_rad} rad, {off_m_s} m/s, {off_m} m");
    // Applied in the attitude of the beginning of each interval they do not: an integrating unit turns as it sums.
    let (_, _, position) = integrated(&samples, 0.0);
    assert!((position - end.site_from_lander.translation.vector).norm() > 1e-2);
}

#[test]
fn imu_noise_has_its_densities_and_is_seeded() {
    let (config, motion) = (ImuConfig::default(), motion());
    let ideal = ideal_samples(&motion, STEP_NS, END_NS);
    let noisy = config.samples(&motion, END_NS, 5);
    assert_eq!(noisy, config.samples(&motion, END_NS, 5));
    assert_ne!(noisy, config.samples(&motion, END_NS, 6));
    let quiet = ImuConfig { noise: false, ..config };
    assert_eq!(quiet.samples(&motion, END_NS, 5), ideal);
    // Means over 1 s have 1σ of 5e-4 m/s² and 2.78e-5 °/s.
    let seconds = noisy.chunks_exact(100).zip(ideal.chunks_exact(100));
    let (mut rate, mut force) = (0.0, 0.0);
    for (n, i) in seconds {
        let mean = |f: &dyn Fn(usize) -> Vector3<f64>| (0..100).map(f).sum::<Vector3<f64>>() / 100.0;
        rate += mean(&|k| n[k].rate_in_lander_rad_s - i[k].rate_in_lander_rad_s).norm_squared();
        force += mean(&|k| n[k].specific_force_in_lander_m_s2 - i[k].specific_force_in_lander_m_s2).norm_squared();
    }
    let rms = |sum: f64| (sum / (3.0 * 198.0)).sqrt();
    assert!((rms(rate).to_degrees() / 2.78e-5 - 1.0).abs() < 0.1, "{}", rms(rate).to_degrees());
    assert!((rms(force) / 5e-4 - 1.0).abs() < 0.1, "{}", rms(force));
    assert!((config.gyroscope_noise_density / 4.852e-7 - 1.0).abs() < 1e-3);
}
