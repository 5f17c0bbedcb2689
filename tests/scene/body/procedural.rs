//! Procedural bodies and landmarks on bodies.

use nalgebra::Vector3;
use opnav::scene::{Mesh, ProceduralBody};

fn small() -> ProceduralBody {
    ProceduralBody { subdivisions: 5, ..ProceduralBody::default() }
}

#[test]
fn procedural_body_is_watertight_seeded_and_near_its_ellipsoid() {
    let mesh = small().mesh(7);
    assert_eq!(mesh.faces.len(), 20_480);
    let found = mesh.mass_properties().unwrap();
    assert!(mesh.zero_area_faces().is_empty());
    let ellipsoid = 4.0 / 3.0 * std::f64::consts::PI * 300.0 * 250.0 * 220.0;
    assert!((0.8..1.2).contains(&(found.volume_m3 / ellipsoid)), "{}", found.volume_m3 / ellipsoid);
    assert_eq!(mesh, small().mesh(7));
    assert_ne!(mesh, small().mesh(8));
}

#[test]
fn every_face_of_a_procedural_body_looks_away_from_its_centre() {
    for seed in 0..5 {
        let mesh = small().mesh(seed);
        for face in &mesh.faces {
            let [a, b, c] = mesh.corners_m(face);
            assert!(a.dot(&(b - a).cross(&(c - a))) > 0.0);
        }
    }
}

#[test]
fn relief_has_the_stated_size() {
    let smooth = ProceduralBody { relief: 0.0, craters: 0, semi_axes_m: [100.0; 3], ..small() };
    assert!(smooth.mesh(1).vertices_m.iter().all(|v| (v.norm() - 100.0).abs() < 1e-9));
    let seeds = 30;
    let mut sum = 0.0;
    for seed in 0..seeds {
        let vertices = ProceduralBody { relief: 0.05, subdivisions: 3, ..smooth }.mesh(seed).vertices_m;
        sum += vertices.iter().map(|v| (v.norm() - 100.0).powi(2)).sum::<f64>() / vertices.len() as f64;
    }
    let rms_m = (sum / f64::from(seeds as u32)).sqrt();
    assert!((4.3..5.7).contains(&rms_m), "{rms_m}");
}

#[test]
fn craters_dig_bowls_with_rims() {
    let smooth = ProceduralBody { relief: 0.0, craters: 0, semi_axes_m: [100.0; 3], ..small() };
    let cratered = ProceduralBody { craters: 1, smallest_crater: 0.3, largest_crater: 0.3, ..smooth };
    let heights: Vec<f64> = cratered.mesh(3).vertices_m.iter().map(|v| v.norm() - 100.0).collect();
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Radius 30 m, freshness 0.4 to 1: 7.2 m deep at most below the ground, a rim of 1.8 m at most.
    assert!((-7.2..-2.8).contains(&lowest) && (0.6..1.81).contains(&highest), "{lowest} {highest}");
}

#[test]
fn landmarks_lie_on_the_surface_and_all_around() {
    let mesh = small().mesh(1);
    let landmarks = mesh.spread_landmarks(200, 1);
    assert_eq!(landmarks.len(), 200);
    assert!(landmarks.iter().enumerate().all(|(index, l)| l.id == index as u32));
    for landmark in &landmarks {
        let on_a_face = mesh.faces.iter().any(|face| {
            let [a, b, c] = mesh.corners_m(face);
            let normal = (b - a).cross(&(c - a)).normalize();
            let inside =
                |p: &Vector3<f64>, q: &Vector3<f64>| (q - p).cross(&(landmark.position_m - p)).dot(&normal) > -1e-6;
            (landmark.position_m - a).dot(&normal).abs() < 1e-9 && inside(&a, &b) && inside(&b, &c) && inside(&c, &a)
        });
        assert!(on_a_face, "{landmark:?}");
    }
    for octant in 0..8 {
        let sign = |bit: usize| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let inside = |p: &Vector3<f64>| (0..3).all(|axis| p[axis] * sign(axis) > 0.0);
        let count = landmarks.iter().filter(|l| inside(&l.position_m)).count();
        assert!((10..45).contains(&count), "octant {octant}: {count}");
    }
    assert_eq!(Mesh::icosphere(0).spread_landmarks(7, 1).len(), 7);
}
