//! Shadows on ground: hills, craters and boulders under the Sun at three elevations, and mountains out of the picture.

use super::{GRAZING_COSINE, Light, bars_of, direction, edges};
use crate::render::accuracy::{Bar, Extent, Tamper, awkward_camera};
use crate::render::{gpu, look_at};
use nalgebra::{Unit, Vector2, Vector3};
use opnav::geometry::Camera;
use opnav::render::{RenderConfig, Renderer, World};
use opnav::scene::{ElevationModel, Georeference, GroundBase, Raster, Terrain, TerrainConfig, View};

/// Ground, a camera above it, and the Sun.
pub struct Scene {
    pub name: &'static str,
    pub terrain: Terrain,
    /// Place of the camera in the site frame, and its height above the ground, m.
    pub above_m: [f64; 3],
    pub sun_elevation_deg: f64,
}

/// Ground of heights in m by x and y in m, without detail; the posts of its model lie `post_m` apart.
fn model(post_m: f64, height_m: impl Fn(f64, f64) -> f64) -> Terrain {
    const POSTS: usize = 241;
    let first_m = 0.5 * (POSTS - 1) as f64 * post_m;
    let place = |i: usize| ((i % POSTS) as f64 * post_m - first_m, first_m - (i / POSTS) as f64 * post_m);
    let values = (0..POSTS * POSTS).map(|i| height_m(place(i).0, place(i).1) as f32).collect();
    let georeference = Georeference::Metres { first_m: [-first_m, first_m], step_m: [post_m; 2] };
    let raster = Raster { columns: POSTS, values, georeference };
    let elevation = Some(ElevationModel::new(raster, None).expect("a model"));
    let base = GroundBase { elevation, ..GroundBase::default() };
    Terrain::on_base(&TerrainConfig::level(), base, 1)
}

/// Round hills so steep that the Sun at `sun_elevation_deg` leaves dark valleys behind them.
pub fn hills(sun_elevation_deg: f64) -> Scene {
    let (wave_m, steepest) = (300.0, 2.2 * sun_elevation_deg.to_radians().tan());
    let k = std::f64::consts::TAU / wave_m;
    let height_m =
        move |x: f64, y: f64| steepest / k * ((k * x + 0.4 * (0.31 * k * y).sin()).sin() * (0.83 * k * y + 0.3).sin());
    Scene { name: "hills", terrain: model(20.0, height_m), above_m: [310.0, 150.0, 1100.0], sun_elevation_deg }
}

/// Fractal relief and craters with sharp rims, without detail near a pixel.
pub fn craters(sun_elevation_deg: f64) -> Scene {
    let config = TerrainConfig {
        largest_wavelength_m: 1600.0,
        smallest_wavelength_m: 100.0,
        rms_slope: 0.25,
        slope_scale_m: 100.0,
        crater_density: 0.5,
        smallest_crater_m: 100.0,
        largest_crater_m: 400.0,
        crater_depth_ratio: 0.3,
        site_slope: 1.0,
        ..TerrainConfig::default().without_features()
    };
    let terrain = Terrain::new(&config, 3);
    Scene { name: "craters", terrain, above_m: [2000.0, 1500.0, 1100.0], sun_elevation_deg }
}

/// Boulders on a plain.
pub fn boulders(sun_elevation_deg: f64) -> Scene {
    let config = TerrainConfig {
        rock_abundance: 0.35,
        smallest_rock_m: 1.0,
        largest_rock_m: 4.0,
        site_slope: 1.0,
        ..TerrainConfig::level()
    };
    let terrain = Terrain::new(&config, 3);
    Scene { name: "boulders", terrain, above_m: [200.0, 150.0, 24.0], sun_elevation_deg }
}

/// A plain on which mountains beyond the picture throw their shadows.
pub fn mountains(sun_elevation_deg: f64) -> Scene {
    let reach_m = 900.0 / sun_elevation_deg.to_radians().tan();
    let height_m = move |x: f64, y: f64| {
        // Across and along the light.
        let (across, along) = (0.8 * y - 0.6 * x, 0.8 * x + 0.6 * y - 0.75 * reach_m);
        900.0 * (0.7 + 0.3 * (across / 90.0).sin()) * (-(along / 300.0).powi(2)).exp()
    };
    let terrain = model(40.0, height_m);
    Scene { name: "mountains out of the picture", terrain, above_m: [0.0, 0.0, 500.0], sun_elevation_deg }
}

impl Scene {
    fn view(&self) -> View {
        let (sin, cos) = self.sun_elevation_deg.to_radians().sin_cos();
        let [x, y, above_m] = self.above_m;
        let eye = Vector3::new(x, y, self.terrain.height_m(x, y) + above_m);
        look_at(eye, eye + Vector3::new(0.15, -0.2, -1.0), Vector3::y(), Vector3::new(cos * 0.8, cos * 0.6, sin))
    }

    fn light(&self, camera: &Camera, view: &View, pixel: &Vector2<f64>) -> Light {
        let eye = view.reference_from_camera.translation.vector;
        let direction = Unit::new_normalize(direction(camera, view, pixel));
        let Some(range_m) = self.terrain.ray_cast(&eye, &direction) else { return Light::Unknown };
        let place = eye + direction.as_ref() * range_m;
        let gradient = self.terrain.gradient(place.x, place.y);
        let normal = Vector3::new(-gradient.x, -gradient.y, 1.0).normalize();
        if normal.dot(&view.sun_in_reference) < GRAZING_COSINE {
            return Light::Unknown;
        }
        let lifted = place + normal * (1e-5 * range_m);
        if self.terrain.ray_cast(&lifted, &view.sun_in_reference).is_some() { Light::Shadowed } else { Light::Lit }
    }

    pub fn bars(&self, (size_px, config): (u32, &RenderConfig), tamper: Tamper) -> Vec<Bar> {
        let camera = awkward_camera(size_px, size_px * 5 / 6, 1.0);
        let view = self.view();
        let frame = Renderer::new(&gpu(), World::Terrain(&self.terrain), &camera, config)
            .and_then(|mut renderer| renderer.render(&view))
            .expect("a picture");
        let probe = |pixel: &Vector2<f64>| self.light(&camera, &view, pixel);
        let what = format!("{}, Sun at {}°", self.name, self.sun_elevation_deg);
        bars_of(&what, edges(&frame, &probe, tamper))
    }
}

pub fn bars(extent: Extent) -> Vec<Bar> {
    let config = RenderConfig::default();
    if extent == Extent::Small {
        let scenes = [hills(35.0), mountains(35.0)];
        return scenes.iter().flat_map(|scene| scene.bars((160, &config), Tamper::Honest)).collect();
    }
    let scenes = [15.0, 35.0, 60.0].map(hills).into_iter().chain([15.0, 35.0].map(boulders));
    let scenes = scenes.chain([craters(15.0), mountains(15.0), mountains(35.0)]);
    scenes.flat_map(|scene| scene.bars((300, &config), Tamper::Honest)).collect()
}

pub fn tampered(tamper: Tamper) -> Vec<Bar> {
    hills(35.0).bars((160, &RenderConfig::default()), tamper)
}
