//! Boulders of procedural bodies, and landmarks that they do not bury.

use nalgebra::Vector3;
use opnav::scene::{Mesh, ProceduralBody, SurfaceConfig};

fn smooth() -> ProceduralBody {
    ProceduralBody { semi_axes_m: [100.0; 3], relief: 0.0, craters: 0, subdivisions: 4, ..ProceduralBody::default() }
}

fn strewn() -> ProceduralBody {
    ProceduralBody { boulders: 120, smallest_boulder: 0.04, largest_boulder: 0.3, ..smooth() }
}

#[test]
fn boulders_are_closed_parts_that_stand_on_the_ground() {
    let mesh = strewn().mesh(5);
    assert_eq!(mesh, strewn().mesh(5));
    assert_eq!(mesh.part_count(), 121);
    mesh.check_closed().unwrap();
    let (with, without) = (mesh.mass_properties().unwrap(), smooth().mesh(5).mass_properties().unwrap());
    assert!(with.volume_m3 > 1.001 * without.volume_m3 && with.volume_m3 < 1.2 * without.volume_m3);
    let ground_vertices = smooth().mesh(5).vertices_m.len();
    let highest_m = mesh.radius_m() - 100.0;
    assert!((5.0..45.0).contains(&highest_m), "{highest_m}");
    let above = mesh.vertices_m[ground_vertices..].iter().filter(|v| v.norm() > 100.0).count();
    let share = above as f64 / (mesh.vertices_m.len() - ground_vertices) as f64;
    assert!((0.5..0.9).contains(&share), "{share}");
}

/// Longest semi-axis of each boulder in m, from the vertices of its part, which follow the ground's.
fn boulder_radii_m(body: &ProceduralBody, seed: u64) -> Vec<f64> {
    let mesh = body.mesh(seed);
    let ground_faces = 20 * 4_usize.pow(body.subdivisions);
    let mut spans: Vec<(u32, u32)> = Vec::new(); // first and last vertex of each part
    for face in &mesh.faces[ground_faces..] {
        let (low, high) = (*face.iter().min().unwrap(), *face.iter().max().unwrap());
        match spans.last_mut() {
            Some((_, last)) if low <= *last => *last = high.max(*last),
            _ => spans.push((low, high)),
        }
    }
    let radius_m = |(low, high): &(u32, u32)| {
        let vertices = &mesh.vertices_m[*low as usize..=*high as usize];
        let center = vertices.iter().sum::<Vector3<f64>>() / vertices.len() as f64;
        vertices.iter().map(|v| (v - center).norm()).fold(0.0, f64::max)
    };
    spans.iter().map(radius_m).collect()
}

#[test]
fn boulder_sizes_follow_the_power_law() {
    let body = ProceduralBody { boulders: 2000, smallest_boulder: 0.01, largest_boulder: 0.2, ..smooth() };
    for exponent in [2.0, 3.0] {
        let radii_m = boulder_radii_m(&ProceduralBody { boulder_exponent: exponent, ..body }, 9);
        assert_eq!(radii_m.len(), 2000);
        let beyond = |m: f64| radii_m.iter().filter(|r| **r > m).count() as f64;
        // Slope of the cumulative numbers between 2 and 6 m; boulders are rough by 7 % of their size.
        let slope = -(beyond(6.0) / beyond(2.0)).ln() / 3.0_f64.ln();
        assert!((slope - exponent).abs() < 0.3, "{exponent}: {slope}");
    }
}

#[test]
fn no_landmark_is_buried() {
    let mesh = strewn().mesh(2);
    let landmarks = mesh.spread_landmarks(300, 1);
    assert!(landmarks.len() > 290, "{}", landmarks.len());
    let buried = |mesh: &Mesh, p: &Vector3<f64>| {
        let around = [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().flat_map(|axis| [axis, -axis]);
        around.into_iter().all(|step| mesh.surrounds(&(p + step * 1e-4)) > 0)
    };
    assert!(landmarks.iter().all(|l| !buried(&mesh, &l.position_m)));
    // Points that pay no heed to the other parts are buried now and then.
    let heedless = |face: &[u32; 3]| mesh.corners_m(face).iter().sum::<Vector3<f64>>() / 3.0;
    assert!(mesh.faces.iter().step_by(20).filter(|face| buried(&mesh, &heedless(face))).count() > 20);
}

#[test]
fn surrounds_counts_the_parts_around_a_point() {
    let mut mesh = Mesh::icosphere(3);
    let inner = Mesh { vertices_m: mesh.vertices_m.iter().map(|v| v * 0.5).collect(), ..mesh.clone() };
    mesh.append(&inner);
    for (x, count) in [(0.1, 2), (0.7, 1), (1.1, 0)] {
        for direction in [Vector3::x(), Vector3::new(1.0, 2.0, -3.0).normalize(), -Vector3::z()] {
            assert_eq!(mesh.surrounds(&(direction * x)), count, "{direction} {x}");
        }
    }
}

#[test]
fn detail_below_the_mesh_can_be_switched_off() {
    let mesh = smooth().mesh(1);
    let on = SurfaceConfig::default().on(&mesh, 1);
    assert!(on.detail_slope > 0.0 && on.albedo_contrast > 0.0 && on.detail_wavelength_m > 0.0);
    let off = SurfaceConfig { detail: false, ..SurfaceConfig::default() }.on(&mesh, 1);
    assert_eq!((off.detail_slope, off.albedo_contrast, off.detail_wavelength_m), (0.0, 0.0, 0.0));
    assert_eq!(off.albedo, on.albedo);
}
