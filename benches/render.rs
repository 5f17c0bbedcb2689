//! Time of one picture of terrain on the way down, at 512² and 1024².

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Isometry3, Matrix3, Unit, UnitQuaternion, Vector3};
use opnav::geometry::Camera;
use opnav::render::{Gpu, RenderConfig, Renderer, World};
use opnav::scene::{Terrain, TerrainConfig, View};

fn look_down(height_m: f64) -> View {
    let rotation = Matrix3::from_columns(&[Vector3::x(), -Vector3::y(), -Vector3::z()]);
    let eye = Vector3::new(0.1 * height_m, 0.2 * height_m, height_m);
    View {
        t_ns: 0,
        reference_from_camera: Isometry3::from_parts(eye.into(), UnitQuaternion::from_matrix(&rotation)),
        sun_in_reference: Unit::new_normalize(Vector3::new(1.0, 0.5, 0.8)),
        sun_angular_radius_rad: 0.0,
    }
}

fn terrain(criterion: &mut Criterion) {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let gpu = Gpu::new(None).expect("a graphics adapter");
    let mut group = criterion.benchmark_group("terrain");
    group.sample_size(10);
    for size_px in [512, 1024] {
        let camera = Camera::from_fov(size_px, size_px, std::f64::consts::FRAC_PI_2);
        for height_m in [6000.0, 200.0, 20.0] {
            let mut renderer =
                Renderer::new(&gpu, World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("a renderer");
            let mut descending_m = height_m;
            // Two per cent lower each time: tiles are partly those of the picture before.
            group.bench_function(format!("{size_px} px, {height_m} m"), |bencher| {
                bencher.iter(|| {
                    descending_m = if descending_m < 0.6 * height_m { height_m } else { 0.98 * descending_m };
                    renderer.render(&look_down(descending_m)).expect("a picture")
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, terrain);
criterion_main!(benches);
