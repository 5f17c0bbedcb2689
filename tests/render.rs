//! Tests of the room `render`. They need a graphics adapter; Mesa's lavapipe will do.

use image::GrayImage;
use nalgebra::{Isometry3, Matrix3, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::{Camera, Distortion};
use opnav::render::{Gpu, RenderConfig, RenderError, RenderedFrame, Renderer, World, expose, list_adapters};
use opnav::scene::{
    BodySurface, Exposure, GroundDetail, LunarWeight, Mesh, Photometry, SensorConfig, SmallBody, Terrain,
    TerrainConfig, View,
};
use opnav::stats::random_stream;
use rand::RngExt;

fn gpu() -> Gpu {
    Gpu::new(None).expect("a graphics adapter")
}

/// A camera at `eye` that looks at `target`, with `up` upwards in the picture.
fn look_at(eye: Vector3<f64>, target: Vector3<f64>, up: Vector3<f64>, sun: Vector3<f64>) -> View {
    let forward = (target - eye).normalize();
    let right = forward.cross(&up).normalize();
    let rotation = Matrix3::from_columns(&[right, forward.cross(&right), forward]);
    View {
        t_ns: 7,
        reference_from_camera: Isometry3::from_parts(eye.into(), UnitQuaternion::from_matrix(&rotation)),
        sun_in_reference: Unit::new_normalize(sun),
        sun_angular_radius_rad: 0.0,
    }
}

/// Straight down from above (x, y), x to the right in the picture.
fn look_down(terrain: &Terrain, [x, y]: [f64; 2], height_m: f64) -> View {
    let eye = Vector3::new(x, y, terrain.height_m(x, y) + height_m);
    look_at(eye, eye - Vector3::z(), Vector3::y(), Vector3::new(1.0, 0.5, 0.8))
}

/// A sphere whose radius is changed direction by direction.
fn sphere(rings: u32, radius_m: impl Fn(&Vector3<f64>) -> f64) -> Mesh {
    let around = 2 * rings;
    let mut mesh = Mesh::default();
    let angle = |k: u32| std::f64::consts::PI * f64::from(k) / f64::from(rings);
    for j in 0..=rings {
        for i in 0..around {
            let (colatitude, longitude) = (angle(j), angle(i));
            let direction =
                Vector3::new(colatitude.sin() * longitude.cos(), colatitude.sin() * longitude.sin(), colatitude.cos());
            mesh.vertices_m.push(direction * radius_m(&direction));
        }
    }
    // One vertex a pole, so that its normal counts all faces around it.
    let vertex = |i: u32, j: u32| j * around + if j == 0 || j == rings { 0 } else { i % around };
    for j in 0..rings {
        for i in 0..around {
            mesh.faces.push([vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)]);
            mesh.faces.push([vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)]);
        }
    }
    mesh
}

/// Two lobes with a neck, so that one shadows the other.
fn lobed(rings: u32) -> Mesh {
    sphere(rings, |d| 80.0 + 250.0 * d.x * d.x + 15.0 * (5.0 * d.y).sin() * (4.0 * d.z).cos())
}

fn plain() -> BodySurface {
    let photometry = Photometry::Lambert;
    BodySurface { albedo: 0.5, photometry, albedo_contrast: 0.0, detail_slope: 0.0, ..BodySurface::default() }
}

fn render(world: World, camera: &Camera, config: &RenderConfig, view: &View) -> RenderedFrame {
    Renderer::new(&gpu(), world, camera, config).expect("a renderer").render(view).expect("a picture")
}

/// Bearing of a pixel with z = 1, in the reference frame.
fn ray(camera: &Camera, view: &View, u_px: u32, v_px: u32) -> Vector3<f64> {
    let ideal = camera.normalize(&Vector2::new(f64::from(u_px), f64::from(v_px))).expect("a pinhole");
    view.reference_from_camera.rotation * Vector3::new(ideal.x, ideal.y, 1.0)
}

/// Nearest hit of a ray with a mesh in units of the direction's length, and the face (Möller and Trumbore 1997).
fn nearest_hit(mesh: &Mesh, origin: &Vector3<f64>, direction: &Vector3<f64>) -> Option<(f64, usize)> {
    let mut nearest = None;
    for (index, face) in mesh.faces.iter().enumerate() {
        let [a, b, c] = face.map(|i| mesh.vertices_m[i as usize]);
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(&ac);
        let determinant = ab.dot(&p);
        if determinant.abs() < 1e-14 {
            continue;
        }
        let from_a = origin - a;
        let u = from_a.dot(&p) / determinant;
        let q = from_a.cross(&ab);
        let v = direction.dot(&q) / determinant;
        let t = ac.dot(&q) / determinant;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-6 && nearest.is_none_or(|(n, _)| t < n) {
            nearest = Some((t, index));
        }
    }
    nearest
}

/// Pixels whose whole neighbourhood of `margin` px satisfies a condition.
fn inner(frame: &RenderedFrame, margin: u32, holds: impl Fn(usize) -> bool) -> Vec<(u32, u32)> {
    let (width, height) = (frame.width_px, frame.height_px);
    let all = (margin..height - margin).flat_map(|v| (margin..width - margin).map(move |u| (u, v)));
    all.filter(|(u, v)| {
        let near = (v - margin..=v + margin).flat_map(|b| (u - margin..=u + margin).map(move |a| (a, b)));
        near.into_iter().all(|(a, b)| holds(frame.index(a, b)))
    })
    .collect()
}

#[test]
fn adapters_are_listed_and_chosen_by_name() {
    let found = list_adapters();
    assert!(!found.is_empty(), "install mesa-vulkan-drivers");
    let part = found[0].name[..4].to_uppercase();
    assert_eq!(Gpu::new(Some(&part)).expect("the first adapter").adapter_name(), found[0].name);
    let message = Gpu::new(Some("no such adapter")).expect_err("refused").to_string();
    assert!(message.contains("no such adapter") && message.contains(&found[0].name), "{message}");
}

/// An eight-sided disc at `center`, facing the camera's way.
fn add_disc(mesh: &mut Mesh, center: &Vector3<f64>, radius_m: f64) {
    let first = mesh.vertices_m.len() as u32;
    mesh.vertices_m.push(*center);
    for k in 0..8 {
        // Seen from +z, that is, by a camera that looks along -z, this runs counter-clockwise.
        let angle = f64::from(k) * std::f64::consts::FRAC_PI_4;
        mesh.vertices_m.push(center + Vector3::new(angle.cos(), angle.sin(), 0.0) * radius_m);
        mesh.faces.push([first, first + 1 + k, first + 1 + (k + 1) % 8]);
    }
}

#[test]
fn known_points_land_on_their_pixels() {
    let camera = Camera {
        focal_px: Vector2::new(310.0, 290.0),
        center_px: Vector2::new(120.3, 97.8),
        ..Camera::from_fov(256, 200, 1.0)
    };
    let eye = Vector3::new(0.3, -0.2, 100.0);
    let view = look_at(eye, eye - Vector3::z(), Vector3::new(0.1, 1.0, 0.0), Vector3::z());
    let mut random = random_stream(4, "disc", 0);
    let mut mesh = Mesh::default();
    let mut pixels = Vec::new();
    for k in 0..48 {
        let cell = Vector2::new(f64::from(k % 8) * 30.0 + 22.0, f64::from(k / 8) * 30.0 + 22.0);
        let pixel = cell + Vector2::from_fn(|_, _| random.random_range(-3.0..3.0));
        let along = camera.unproject(&pixel).expect("a pinhole");
        let depth_m = random.random_range(95.0..105.0);
        let center = view.reference_from_camera * nalgebra::Point3::from(along.as_ref() * (depth_m / along.z));
        add_disc(&mut mesh, &center.coords, 2.2 * depth_m / 300.0);
        let in_camera = view.reference_from_camera.inverse() * center;
        pixels.push(camera.project(&in_camera.coords).expect("in front"));
    }
    let body = SmallBody { mesh, surface: plain() };
    let frame =
        render(World::Body(&body), &camera, &RenderConfig { supersampling: 8, ..RenderConfig::default() }, &view);
    let offsets: Vec<Vector2<f64>> = pixels.iter().map(|p| centroid(&frame, p) - p).collect();
    let bias = offsets.iter().sum::<Vector2<f64>>() / offsets.len() as f64;
    assert!(bias.norm() < 0.02, "bias {bias}");
    assert!(offsets.iter().all(|o| o.norm() < 0.1), "each disc: {offsets:?}");
    // The test can tell half a pixel, and an upside-down picture.
    let shifted: Vec<f64> = pixels.iter().map(|p| (centroid(&frame, p) - p.add_scalar(0.5)).norm()).collect();
    assert!(shifted.iter().all(|o| *o > 0.4));
    let flipped = pixels.iter().filter(|p| {
        let mirrored = Vector2::new(p.x, 199.0 - p.y);
        (centroid(&frame, &mirrored) - mirrored).norm() < 0.1
    });
    assert!(flipped.count() < 5, "the picture is not symmetric");
}

fn centroid(frame: &RenderedFrame, near_px: &Vector2<f64>) -> Vector2<f64> {
    let (mut total, mut weight) = (Vector2::zeros(), 0.0);
    for (v, u) in (0..frame.height_px).flat_map(|v| (0..frame.width_px).map(move |u| (v, u))) {
        let pixel = Vector2::new(f64::from(u), f64::from(v));
        if (pixel - near_px).amax() < 8.0 {
            let radiance = f64::from(frame.radiance[frame.index(u, v)]);
            total += pixel * radiance;
            weight += radiance;
        }
    }
    total / weight
}

#[test]
fn up_in_the_world_is_up_in_the_picture() {
    let mut mesh = Mesh::default();
    add_disc(&mut mesh, &Vector3::new(0.0, 10.0, 0.0), 4.0);
    let body = SmallBody { mesh, surface: plain() };
    let eye = Vector3::new(0.0, 0.0, 50.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::y(), Vector3::z());
    let frame = render(World::Body(&body), &Camera::from_fov(64, 64, 1.0), &RenderConfig::default(), &view);
    let brightest = |rows: std::ops::Range<u32>| {
        rows.flat_map(|v| (0..64).map(move |u| (u, v)))
            .map(|(u, v)| frame.radiance[frame.index(u, v)])
            .fold(0.0, f32::max)
    };
    assert!(brightest(0..32) > 0.4 && brightest(32..64) == 0.0);
}

#[test]
fn depth_of_a_body_is_that_of_its_triangles() {
    let body = SmallBody { mesh: lobed(24), surface: BodySurface::default() };
    let camera = Camera { center_px: Vector2::new(140.2, 101.7), ..Camera::from_fov(256, 192, 0.45) };
    for eye in [Vector3::new(900.0, 1100.0, 500.0), Vector3::new(20.0, 260.0, 120.0), Vector3::new(6e4, -8e4, 3e4)] {
        let closer = f64::max(eye.norm() / 1500.0, 0.4);
        let camera = Camera { focal_px: camera.focal_px * closer, ..camera };
        let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 1.0, 0.4));
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let hits = inner(&frame, 1, |i| frame.mask[i] & RenderedFrame::BODY != 0);
        assert!(hits.len() > 2000, "{} px are hit", hits.len());
        let mut worst: f64 = 0.0;
        for (u, v) in hits.iter().step_by(17) {
            let (depth_m, _) = nearest_hit(&body.mesh, &eye, &ray(&camera, &view, *u, *v)).expect("the ray hits");
            worst = worst.max((f64::from(frame.depth_m[frame.index(*u, *v)]) / depth_m - 1.0).abs());
        }
        println!("worst relative depth error {worst:.2e} from {:.0} m", eye.norm());
        assert!(worst < 1e-4, "relative depth error {worst:.2e} from {eye}");
        let empty = inner(&frame, 1, |i| frame.mask[i] == 0);
        for (u, v) in empty.iter().step_by(53) {
            assert!(frame.depth_m[frame.index(*u, *v)].is_nan());
            assert_eq!(nearest_hit(&body.mesh, &eye, &ray(&camera, &view, *u, *v)), None);
        }
    }
}

#[test]
fn lit_pixels_are_those_that_see_the_sun() {
    let body = SmallBody { mesh: lobed(40), surface: plain() };
    let camera = Camera::from_fov(256, 256, 0.4);
    let eye = Vector3::new(300.0, 1700.0, 500.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.35, 0.1));
    let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
    let sun = view.sun_in_reference.into_inner();
    let (mut shadowed, mut agree, mut total) = (0, 0, 0);
    for state in [RenderedFrame::BODY, RenderedFrame::BODY | RenderedFrame::LIT] {
        let same = inner(&frame, 2, |i| frame.mask[i] & !RenderedFrame::TERMINATOR == state);
        for (u, v) in same.iter().step_by(11) {
            let direction = ray(&camera, &view, *u, *v);
            let (t, face) = nearest_hit(&body.mesh, &eye, &direction).expect("the body is hit");
            let place = eye + direction * t;
            let [a, b, c] = body.mesh.faces[face].map(|i| body.mesh.vertices_m[i as usize]);
            let normal = (b - a).cross(&(c - a)).normalize();
            let faces_sun = normal.dot(&sun) > 0.0;
            let blocked = nearest_hit(&body.mesh, &(place + normal * 0.5), &sun).is_some();
            shadowed += u32::from(faces_sun && blocked);
            total += 1;
            agree += u32::from((faces_sun && !blocked) == (state & RenderedFrame::LIT != 0));
        }
    }
    println!("{agree} of {total} agree, {shadowed} in cast shadow");
    assert!(total > 1000 && shadowed > 40, "the scene casts shadows: {shadowed} of {total}");
    assert!(f64::from(agree) > 0.97 * f64::from(total), "{agree} of {total} agree");
}

#[test]
fn a_sphere_shines_as_its_formula_says() {
    let camera = Camera::from_fov(256, 256, 0.3);
    let eye = Vector3::new(1000.0, 0.0, 0.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 1.2, 0.3));
    for weight in [0.0, 0.6, 1.0] {
        let photometry = Photometry::LunarLambert { weight: LunarWeight::Constant(weight) };
        let body = SmallBody { mesh: sphere(160, |_| 100.0), surface: BodySurface { photometry, ..plain() } };
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let mut checked = 0;
        for (u, v) in inner(&frame, 2, |i| frame.mask[i] & RenderedFrame::LIT != 0) {
            let direction = ray(&camera, &view, u, v).normalize();
            let along = -eye.dot(&direction);
            let normal = (eye + direction * (along - (along * along - 99e4).max(0.0).sqrt())).normalize();
            let (sun_cosine, view_cosine) = (normal.dot(&view.sun_in_reference), -normal.dot(&direction));
            if sun_cosine < 0.1 || view_cosine < 0.2 {
                continue;
            }
            let lunar = 2.0 * weight / (sun_cosine + view_cosine) + 1.0 - weight;
            let expected = 0.5 * sun_cosine * lunar;
            let found = f64::from(frame.radiance[frame.index(u, v)]);
            assert!((found / expected - 1.0).abs() < 0.01, "{found} for {expected} at {u}, {v}, weight {weight}");
            checked += 1;
        }
        assert!(checked > 3000);
    }
}

#[test]
fn the_terminator_band_lies_between_80_and_100_degrees() {
    let body = SmallBody { mesh: sphere(120, |_| 100.0), surface: BodySurface::default() };
    let camera = Camera::from_fov(128, 128, 0.3);
    let eye = Vector3::new(1000.0, 0.0, 0.0);
    let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::y());
    let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
    for (u, v) in inner(&frame, 1, |i| frame.mask[i] & RenderedFrame::BODY != 0) {
        let direction = ray(&camera, &view, u, v).normalize();
        let along = -eye.dot(&direction);
        let normal = (eye + direction * (along - (along * along - 99e4).max(0.0).sqrt())).normalize();
        let incidence = normal.y.acos().to_degrees();
        let marked = frame.mask[frame.index(u, v)] & RenderedFrame::TERMINATOR != 0;
        if (incidence - 90.0).abs() < 9.0 {
            assert!(marked, "incidence {incidence} at {u}, {v}");
        } else if (incidence - 90.0).abs() > 11.0 {
            assert!(!marked, "incidence {incidence} at {u}, {v}");
        }
    }
}

/// Lambertian ground without relief, under a black sky.
fn flat() -> TerrainConfig {
    TerrainConfig {
        photometry: Photometry::Lambert,
        sky_light: 0.0,
        rms_slope: 0.0,
        crater_density: 0.0,
        rock_density: 0.0,
        ..TerrainConfig::default()
    }
}

#[test]
fn depth_of_level_ground_is_exact() {
    let terrain = Terrain::new(&flat(), 1);
    let camera = Camera { center_px: Vector2::new(100.0, 140.0), ..Camera::from_fov(256, 256, 1.4) };
    for height_m in [9000.0, 300.0, 2.0] {
        let eye = Vector3::new(-1234.567, 4321.123, height_m);
        let target = eye + Vector3::new(0.4, 0.2, -1.0);
        let view = look_at(eye, target, Vector3::y(), Vector3::new(1.0, 0.0, 1.0));
        let frame = render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &view);
        let mut worst: f64 = 0.0;
        for (u, v) in (0..256).flat_map(|v| (0..256).map(move |u| (u, v))).step_by(37) {
            let depth_m = -height_m / ray(&camera, &view, u, v).z;
            worst = worst.max((f64::from(frame.depth_m[frame.index(u, v)]) / depth_m - 1.0).abs());
        }
        println!("worst relative depth error {worst:.2e} from {height_m} m");
        assert!(worst < 1e-5, "relative depth error {worst:.2e} from {height_m} m");
    }
}

#[test]
fn depth_of_rough_ground_is_that_of_the_analytic_terrain() {
    let terrain = Terrain::new(&TerrainConfig::default(), 7);
    let camera = Camera::from_fov(512, 512, 1.2);
    for (place, height_m) in
        [([3300.0, 5870.0], 6570.0), ([150.0, 500.0], 1250.0), ([1.0, 2.0], 30.0), ([0.3, 0.2], 3.0)]
    {
        let view = look_down(&terrain, place, height_m);
        let frame = render(World::Terrain(&terrain), &camera, &RenderConfig::default(), &view);
        let eye = view.reference_from_camera.translation.vector;
        let mut off = Vec::new();
        for (u, v) in (0..512).flat_map(|v| (0..512).map(move |u| (u, v))).step_by(509) {
            let direction = ray(&camera, &view, u, v);
            let range_m = terrain.ray_cast(&eye, &Unit::new_normalize(direction)).expect("the ray meets the ground");
            let depth_m = range_m / direction.norm();
            // In footprints of a pixel: the mesh leaves out what is finer than its vertices' spacing.
            let footprint_m = depth_m / camera.mean_focal_px();
            off.push((f64::from(frame.depth_m[frame.index(u, v)]) - depth_m).abs() / footprint_m);
        }
        off.sort_by(f64::total_cmp);
        let (median, most) = (off[off.len() / 2], off[off.len() * 98 / 100]);
        println!("{height_m} m: median {median:.3} footprints, 98 % below {most:.3}");
        assert!(median < 0.1 && most < 1.0, "from {height_m} m: median {median:.3}, 98 % below {most:.3} footprints");
    }
}

#[test]
fn albedo_in_the_picture_is_that_of_the_terrain() {
    let terrain = Terrain::new(&flat(), 4);
    let stranger = Terrain::new(&flat(), 5);
    let camera = Camera::from_fov(256, 256, 1.2);
    for (place, height_m) in [([3300.0, 5870.0], 6570.0), ([20_000.0, -15_000.0], 40.0), ([0.3, 0.2], 3.0)] {
        let view = look_down(&terrain, place, height_m);
        let config = RenderConfig { supersampling: 1, ..RenderConfig::default() };
        let frame = render(World::Terrain(&terrain), &camera, &config, &view);
        let eye = view.reference_from_camera.translation.vector;
        let (mut off, mut off_stranger): (f64, f64) = (0.0, 0.0);
        for (u, v) in (0..256).flat_map(|v| (0..256).map(move |u| (u, v))).step_by(29) {
            let direction = ray(&camera, &view, u, v);
            let at = eye + direction * (-eye.z / direction.z);
            let cosine = -direction.normalize().z;
            let footprint_m = eye.z / camera.mean_focal_px() / cosine.sqrt();
            let detail = GroundDetail { footprint_m, ..GroundDetail::default() };
            let albedo = |t: &Terrain| t.albedo_from_change(t.sample(at.x, at.y, &detail).albedo_change);
            let found = f64::from(frame.radiance[frame.index(u, v)]) / view.sun_in_reference.z;
            off = off.max((found - albedo(&terrain)).abs());
            off_stranger = off_stranger.max((found - albedo(&stranger)).abs());
        }
        println!("{height_m} m: albedo off by {off:.1e}, another terrain's by {off_stranger:.1e}");
        assert!(off < 1e-3, "albedo off by {off} from {height_m} m");
        assert!(off_stranger > 0.02, "the test can tell one terrain from another");
    }
}

#[test]
fn terrain_has_no_cracks() {
    let terrain = Terrain::new(&TerrainConfig::default(), 5);
    let camera = Camera::from_fov(384, 384, 1.5);
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    let mut random = random_stream(5, "crack", 0);
    for _ in 0..12 {
        let height_m = 10.0_f64.powf(random.random_range(0.2..4.0));
        let place = [random.random_range(-5e3..5e3), random.random_range(-5e3..5e3)];
        let frame = renderer.render(&look_down(&terrain, place, height_m)).expect("a picture");
        assert!(frame.depth_m.iter().all(|d| d.is_finite()), "a crack in the truth from {height_m} m at {place:?}");
        let least = frame.radiance.iter().copied().fold(f32::INFINITY, f32::min);
        let sky = 0.02 * 0.15 * 0.5;
        assert!(least > sky, "a crack in the picture from {height_m} m at {place:?}: {least}");
    }
}

#[test]
fn pictures_are_reproducible_whatever_came_before() {
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let camera = Camera::from_fov(192, 160, 1.5);
    let view = look_down(&terrain, [40.0, -20.0], 300.0);
    let new = || Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    let bytes = |frame: RenderedFrame| {
        let bits = |v: &[f32]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        (bits(&frame.radiance), bits(&frame.depth_m), frame.mask)
    };
    let first = bytes(new().render(&view).expect("a picture"));
    let mut used = new();
    for height_m in [3000.0, 900.0, 20.0] {
        used.render(&look_down(&terrain, [100.0, 50.0], height_m)).expect("a picture");
    }
    assert!(first == bytes(used.render(&view).expect("a picture")), "the pool's history shows");
    assert!(first == bytes(used.render(&view).expect("a picture")), "a second time");

    let body = SmallBody { mesh: lobed(40), surface: BodySurface::default() };
    let view = look_at(Vector3::new(900.0, 900.0, 0.0), Vector3::zeros(), Vector3::z(), Vector3::x());
    let once = || bytes(render(World::Body(&body), &camera, &RenderConfig::default(), &view));
    assert!(once() == once());
}

#[test]
fn views_that_cannot_be_pictures_are_refused() {
    let camera = Camera::from_fov(64, 64, 1.5);
    let terrain = Terrain::new(&TerrainConfig::default(), 3);
    let config = RenderConfig::default();
    let gpu = gpu();
    let mut ground = Renderer::new(&gpu, World::Terrain(&terrain), &camera, &config).expect("ready");
    let view = look_down(&terrain, [5.0, 5.0], 10.0);
    ground.render(&view).expect("this one is a picture");
    let below = look_down(&terrain, [5.0, 5.0], -1.0);
    assert!(matches!(ground.render(&below), Err(RenderError::CameraBelowGround { t_ns: 7, .. })));
    let night = View { sun_in_reference: -Vector3::z_axis(), ..view };
    assert!(matches!(ground.render(&night), Err(RenderError::SunBelowHorizon { .. })));
    let nowhere = View { reference_from_camera: Isometry3::translation(f64::NAN, 0.0, 0.0), ..view };
    assert!(matches!(ground.render(&nowhere), Err(RenderError::ViewNotFinite { .. })));

    let body = SmallBody { mesh: lobed(20), surface: plain() };
    let mut around = Renderer::new(&gpu, World::Body(&body), &camera, &config).expect("ready");
    let at = |eye| look_at(eye, Vector3::new(1.0, 2.0, 500.0), Vector3::y(), Vector3::x());
    assert!(matches!(around.render(&at(Vector3::new(200.0, 5.0, 0.0))), Err(RenderError::CameraInsideBody { .. })));
    around.render(&at(Vector3::new(0.0, 0.0, 260.0))).expect("inside the bounding sphere, outside the body");

    let bent = Camera { distortion: Distortion::RadialTangential([0.1, 0.0, 0.0, 0.0]), ..camera };
    assert!(matches!(Renderer::new(&gpu, World::Body(&body), &bent, &config), Err(RenderError::DistortedCamera)));
    let huge = Camera::from_fov(200_000, 64, 1.0);
    assert!(matches!(
        Renderer::new(&gpu, World::Body(&body), &huge, &config),
        Err(RenderError::PictureTooLarge { .. })
    ));
    let wrong = RenderConfig { supersampling: 0, ..config };
    let message = Renderer::new(&gpu, World::Body(&body), &camera, &wrong).expect_err("refused").to_string();
    assert!(message.contains("render.supersampling"), "{message}");
    let torn = SmallBody { mesh: Mesh { faces: vec![[0, 1, 9]], ..body.mesh.clone() }, ..body };
    assert!(Renderer::new(&gpu, World::Body(&torn), &camera, &config).is_ok());
    let torn = SmallBody { mesh: Mesh { faces: vec![[0, 1, 9_999_999]], ..torn.mesh }, ..torn };
    assert!(matches!(Renderer::new(&gpu, World::Body(&torn), &camera, &config), Err(RenderError::UnusableMesh { .. })));
}

/// A picture minus its own wide mean.
fn high_passed(values: &[f64], width: usize) -> Vec<f64> {
    let height = values.len() / width;
    let reach = 5;
    let mean = |u: usize, v: usize| {
        let (rows, columns) =
            (v.saturating_sub(reach)..(v + reach + 1).min(height), u.saturating_sub(reach)..(u + reach + 1).min(width));
        let count = (rows.len() * columns.len()) as f64;
        rows.flat_map(|b| columns.clone().map(move |a| values[b * width + a])).sum::<f64>() / count
    };
    (0..values.len()).map(|i| values[i] - mean(i % width, i / width)).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(p, q)| p * q).sum::<f64>();
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

#[test]
fn texture_persists_over_a_tenth_of_scale() {
    let terrain = Terrain::new(&TerrainConfig::default(), 12);
    let camera = Camera::from_fov(320, 320, 1.2);
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    let place = [25.0, 31.0];
    for height_m in [7000.0, 2900.0, 1000.0, 333.0, 80.0, 23.0, 6.0] {
        // Sideways too, so that texture which hangs on the camera is found out.
        let aside = [place[0] + 0.037 * height_m, place[1] - 0.021 * height_m];
        let (near, far) = (look_down(&terrain, place, height_m), look_down(&terrain, aside, 1.1 * height_m));
        let (near_frame, far_frame) = (renderer.render(&near).expect("near"), renderer.render(&far).expect("far"));
        // Where each pixel of the near picture lies in the far one, by the near one's depth.
        let far_from_near = far.reference_from_camera.inverse() * near.reference_from_camera;
        let (mut seen_near, mut seen_far) = (Vec::new(), Vec::new());
        for (u, v) in (40..280).flat_map(|v| (40..280).map(move |u| (u, v))) {
            let index = near_frame.index(u, v);
            let ideal = camera.normalize(&Vector2::new(f64::from(u), f64::from(v))).expect("a pinhole");
            let place = Vector3::new(ideal.x, ideal.y, 1.0) * f64::from(near_frame.depth_m[index]);
            let pixel = camera.project(&(far_from_near * nalgebra::Point3::from(place)).coords).expect("in front");
            seen_near.push(f64::from(near_frame.radiance[index]));
            seen_far.push(interpolated(&far_frame, &pixel));
        }
        let same = correlation(&high_passed(&seen_near, 240), &high_passed(&seen_far, 240));
        println!("{height_m} m: correlation {same:.3}");
        assert!(same > 0.9, "correlation {same:.3} between {height_m} m and a tenth more");
    }
}

fn interpolated(frame: &RenderedFrame, pixel: &Vector2<f64>) -> f64 {
    let (u, v) = (pixel.x.floor(), pixel.y.floor());
    let (a, b) = (pixel.x - u, pixel.y - v);
    let at = |du: u32, dv: u32| f64::from(frame.radiance[frame.index(u as u32 + du, v as u32 + dv)]);
    (at(0, 0) * (1.0 - a) + at(1, 0) * a) * (1.0 - b) + (at(0, 1) * (1.0 - a) + at(1, 1) * a) * b
}

/// Harris corners above a hundredth of the best, the best of each 8×8 px block, with their blocks.
fn harris_blocks(picture: &GrayImage) -> std::collections::BTreeSet<(u32, u32)> {
    let (width, height) = picture.dimensions();
    let at = |u: u32, v: u32| f64::from(picture.get_pixel(u, v)[0]);
    let gradient = |u: u32, v: u32| Vector2::new(at(u + 1, v) - at(u - 1, v), at(u, v + 1) - at(u, v - 1)) * 0.5;
    let response = |u: u32, v: u32| {
        let mut moments = nalgebra::Matrix2::zeros();
        for (a, b) in (u - 2..=u + 2).flat_map(|a| (v - 2..=v + 2).map(move |b| (a, b))) {
            let g = gradient(a, b);
            moments += g * g.transpose();
        }
        moments.determinant() - 0.04 * moments.trace().powi(2)
    };
    let mut best = std::collections::BTreeMap::new();
    for (u, v) in (3..height - 3).flat_map(|v| (3..width - 3).map(move |u| (u, v))) {
        let value = response(u, v);
        let entry = best.entry((u / 8, v / 8)).or_insert(value);
        *entry = value.max(*entry);
    }
    let most = best.values().copied().fold(0.0, f64::max);
    best.into_iter().filter(|(_, value)| *value > 0.01 * most).map(|(block, _)| block).collect()
}

#[test]
fn every_height_has_hundreds_of_spread_corners() {
    let terrain = Terrain::new(&TerrainConfig::default(), 1);
    let camera = Camera::from_fov(512, 512, std::f64::consts::FRAC_PI_2);
    let mut renderer =
        Renderer::new(&gpu(), World::Terrain(&terrain), &camera, &RenderConfig::default()).expect("ready");
    for (place, height_m) in [
        ([3300.0, 5870.0], 6570.0),
        ([995.0, 2453.0], 3030.0),
        ([158.0, 527.0], 1254.0),
        ([6.0, 28.0], 225.0),
        ([0.0, 0.5], 21.0),
        ([0.0, 0.0], 5.0),
    ] {
        let frame = renderer.render(&look_down(&terrain, place, height_m)).expect("a picture");
        let corners = harris_blocks(&expose(&frame, &SensorConfig::default(), 1, 0));
        let spread: std::collections::BTreeSet<_> = corners.iter().map(|(u, v)| (u / 8, v / 8)).collect();
        println!("{height_m} m: {} corners in {} of 64 parts", corners.len(), spread.len());
        assert!(corners.len() > 400 && spread.len() > 55, "{height_m} m: {} in {} of 64", corners.len(), spread.len());
    }
}

#[test]
fn a_body_has_hundreds_of_corners() {
    let body = SmallBody { mesh: sphere(60, |d| 200.0 + 30.0 * d.x), surface: BodySurface::default() };
    for size_px in [512, 1024] {
        let camera = Camera::from_fov(size_px, size_px, 0.5);
        let eye = Vector3::new(1100.0, 300.0, 200.0);
        let view = look_at(eye, Vector3::zeros(), Vector3::z(), Vector3::new(1.0, 0.6, 0.5));
        let frame = render(World::Body(&body), &camera, &RenderConfig::default(), &view);
        let corners = harris_blocks(&expose(&frame, &SensorConfig::default(), 1, 0)).len();
        println!("{size_px} px: {corners} corners");
        assert!(corners > 300, "{corners} corners at {size_px} px");
    }
}

fn grey(side_px: u32, radiance: f32) -> RenderedFrame {
    let count = (side_px * side_px) as usize;
    RenderedFrame {
        width_px: side_px,
        height_px: side_px,
        radiance: vec![radiance; count],
        depth_m: vec![1.0; count],
        mask: vec![RenderedFrame::BODY | RenderedFrame::LIT; count],
    }
}

#[test]
fn the_detector_is_reproducible_and_noisy_as_stated() {
    let sensor = SensorConfig {
        exposure: Exposure::Fixed { electrons_per_radiance: 20_000.0 },
        full_well_electrons: 5_000.0,
        read_noise_electrons: 30.0,
        ..SensorConfig::default()
    };
    let frame = grey(256, 0.1);
    let picture = expose(&frame, &sensor, 9, 33);
    assert_eq!(picture, expose(&frame, &sensor, 9, 33));
    assert_ne!(picture, expose(&frame, &sensor, 10, 33));
    assert_ne!(picture, expose(&frame, &sensor, 9, 34));
    let values: Vec<f64> = picture.pixels().map(|p| f64::from(p[0])).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
    // 2000 electrons: shot noise √2000, read noise 30, rounding 1/√12 of a level.
    let per_electron = 255.0 / 5_000.0;
    let expected = (2_000.0 + 900.0) * per_electron * per_electron + 1.0 / 12.0;
    assert!((mean - 102.0).abs() < 0.05, "mean {mean}");
    assert!((variance / expected - 1.0).abs() < 0.03, "variance {variance} for {expected}");
}

#[test]
fn automatic_exposure_uses_the_range() {
    let mut frame = grey(100, 0.0);
    (0..10_000).for_each(|i| frame.radiance[i] = 0.2 * i as f32 / 9_999.0);
    let sensor = SensorConfig { noise: false, psf_sigma_px: 0.0, ..SensorConfig::default() };
    let picture = expose(&frame, &sensor, 1, 1);
    let bright = f64::from(picture.as_raw()[9_900]) / 255.0;
    assert!((bright - 0.8).abs() < 0.005, "the 99th percentile is at {bright}");
    // Nothing lit: black, not divided by zero.
    assert!(expose(&RenderedFrame { mask: vec![1; 10_000], ..frame }, &sensor, 1, 1).pixels().all(|p| p[0] == 0));
}
