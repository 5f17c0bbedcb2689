//! The surface being rendered, terrain or body, and the numbers of one view that its shaders read.

use super::body_geometry::BodyGeometry;
use super::geometry_pass::Role;
use super::gpu_data::{Geometry, Shading, columns, dropped, four};
use super::noise::octave_table;
use super::projection::{clip_from_camera, side_planes_in_camera};
use super::shadow::{ShadowBox, ShadowMap, shadow_axes, texture_from_clip};
use super::terrain_geometry::TerrainGeometry;
use super::terrain_levels::{LevelRange, ViewVolume};
use super::{Gpu, RenderConfig, RenderError, World};
use crate::geometry::Camera;
use crate::scene::{BodySurface, NoiseOctave, OctaveStrength, View};
use nalgebra::{Matrix4, Vector3};

/// A surface on the adapter.
#[derive(Debug)]
pub(super) struct Surface {
    kind: Kind,
    octaves: Vec<NoiseOctave>,
    mean_albedo: f64,
    /// R.m.s. slope of the detail that only shading knows.
    detail_slope: f64,
}

#[derive(Debug)]
enum Kind {
    Terrain(Box<TerrainGeometry>),
    Body(Box<BodyGeometry>),
}

/// Finest detail of a small body in m.
const FINEST_BODY_DETAIL_M: f64 = 0.005;
/// A body's r.m.s. slope is that of its detail down to this share of the largest wavelength.
const BODY_SLOPE_SHARE: f64 = 1.0 / 32.0;
/// Hurst exponent of a body's detail.
const BODY_HURST: f64 = 0.9;
/// R.m.s. slope that the ground has below its mesh.
const GROUND_DETAIL_SLOPE: f64 = 0.1;

impl Surface {
    pub(super) fn new(gpu: &Gpu, world: World) -> Result<Self, RenderError> {
        Ok(match world {
            World::Terrain(terrain) => Surface {
                kind: Kind::Terrain(Box::new(TerrainGeometry::new(gpu, terrain))),
                octaves: terrain.octaves().to_vec(),
                mean_albedo: terrain.mean_albedo(),
                detail_slope: GROUND_DETAIL_SLOPE,
            },
            World::Body(body) => Surface {
                kind: Kind::Body(Box::new(BodyGeometry::new(gpu, &body.mesh)?)),
                octaves: body_octaves(&body.surface),
                mean_albedo: body.surface.albedo,
                detail_slope: body.surface.detail_slope,
            },
        })
    }

    pub(super) fn shading_entry(&self) -> &'static str {
        match self.kind {
            Kind::Terrain(_) => "terrain",
            Kind::Body(_) => "body",
        }
    }

    /// Checks the view, uploads its geometry, and returns what shading needs.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        view: &View,
        (camera, config): (&Camera, &RenderConfig),
        shadow_map: &ShadowMap,
    ) -> Result<Shading, RenderError> {
        let eye = view.reference_from_camera.translation.vector;
        let (covered, levels, anchor, distance_m) = match &mut self.kind {
            Kind::Body(body) => {
                body.check_view(view)?;
                let (center_m, radius_m) = body.bounding_sphere();
                let margin_m = 1.02 * radius_m;
                let covered =
                    ShadowBox { center_m: center_m - eye, half_side_m: margin_m, half_depth_m: 1.1 * radius_m };
                (covered, None, Vector3::zeros(), (center_m - eye).norm() - radius_m)
            }
            Kind::Terrain(terrain) => {
                let height_m = terrain.check_view(view)?;
                let levels = LevelRange::new(height_m, camera.mean_focal_px(), config.vertex_spacing_px);
                let covered = ground_box(camera, view, height_m);
                terrain.prepare(gpu, &view_volume(camera, view, &covered), &levels)?;
                let anchor = TerrainGeometry::anchor_m(&eye);
                (covered, Some(levels), Vector3::new(anchor.x, anchor.y, 0.0), height_m)
            }
        };
        let rotation = view.reference_from_camera.rotation.to_homogeneous();
        let shadow_clip = covered.clip_from_relative(&shadow_axes(&view.sun_in_reference));
        let level = levels.map_or([0.0; 4], |l| {
            [l.height_m as f32, l.range_over_spacing as f32, l.morph_start as f32, l.morph_end as f32]
        });
        let from_anchor = eye - anchor;
        let geometry = |clip: &Matrix4<f64>| Geometry {
            clip_from_relative: columns(clip),
            forward: four(&(view.reference_from_camera.rotation * Vector3::z()), 0.0),
            camera_high: four(&from_anchor, 0.0),
            camera_low: four(&dropped(&from_anchor), 0.0),
            level,
        };
        self.set_geometry(gpu, Role::Picture, &geometry(&(clip_from_camera(camera) * rotation.transpose())));
        self.set_geometry(gpu, Role::Shadow, &geometry(&shadow_clip));

        let finest_m = 0.5 * distance_m.max(0.0) / camera.mean_focal_px();
        let (octaves, count) = octave_table(&self.octaves, &eye, finest_m);
        let sky = if levels.is_some() { config.sky_light } else { 0.0 };
        let weight = config.photometry.lunar_weight();
        Ok(Shading {
            reference_from_camera: columns(&rotation),
            shadow_from_relative: columns(&(texture_from_clip() * shadow_clip)),
            sun: four(&view.sun_in_reference, sky),
            intrinsics: [camera.focal_px.x, camera.focal_px.y, camera.center_px.x, camera.center_px.y]
                .map(|v| v as f32),
            surface: [self.mean_albedo, weight, self.detail_slope, shadow_map.texel_m(&covered)].map(|v| v as f32),
            level,
            counts: [config.supersampling, count, 0, 0],
            octaves,
        })
    }

    fn set_geometry(&self, gpu: &Gpu, role: Role, geometry: &Geometry) {
        match &self.kind {
            Kind::Terrain(terrain) => terrain.set_geometry(gpu, role, geometry),
            Kind::Body(body) => body.set_geometry(gpu, role, geometry),
        }
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass, role: Role) {
        match &self.kind {
            Kind::Terrain(terrain) => terrain.draw(pass, role),
            Kind::Body(body) => body.draw(pass, role),
        }
    }
}

/// Octaves of a small body's detail.
fn body_octaves(surface: &BodySurface) -> Vec<NoiseOctave> {
    let largest_m = surface.detail_wavelength_m;
    if largest_m <= 0.0 {
        return Vec::new();
    }
    let mut strength = OctaveStrength {
        largest_m,
        smallest_m: FINEST_BODY_DETAIL_M.min(largest_m),
        slope_at_1_m: 0.0,
        hurst: BODY_HURST,
        albedo_contrast: surface.albedo_contrast,
    };
    let share_m = (BODY_SLOPE_SHARE * largest_m).max(strength.smallest_m);
    strength.slope_at_1_m = strength.slope_at_1_m_from_rms(surface.detail_slope, share_m);
    NoiseOctave::solid(&strength, surface.seed, "body-detail")
}

fn view_volume(camera: &Camera, view: &View, covered: &ShadowBox) -> ViewVolume {
    let rotation = view.reference_from_camera.rotation;
    // Gentle terrain: what stands a few per cent of the picture's width higher throws its shadow this far.
    let reach_m = 2.0 + 0.06 * covered.half_side_m / view.sun_in_reference.z.max(0.05);
    ViewVolume {
        camera_in_site_m: view.reference_from_camera.translation.vector,
        sides_in_site: side_planes_in_camera(camera).map(|n| rotation * n),
        shadow_in_site_m: -view.sun_in_reference.into_inner() * reach_m,
    }
}

/// Box around the ground in view; beyond `FARTHEST_HEIGHTS` heights of the camera there are no cast shadows.
fn ground_box(camera: &Camera, view: &View, height_m: f64) -> ShadowBox {
    const FARTHEST_HEIGHTS: f64 = 12.0;
    const RAYS: u32 = 16;
    let axes = shadow_axes(&view.sun_in_reference);
    let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    for k in 0..(RAYS + 1) * (RAYS + 1) {
        let share = |i: u32, size: u32| f64::from(i) / f64::from(RAYS) * f64::from(size) - 0.5;
        let u = share(k % (RAYS + 1), camera.width_px);
        let v = share(k / (RAYS + 1), camera.height_px);
        let ideal = Vector3::new(
            (u - camera.center_px.x) / camera.focal_px.x,
            (v - camera.center_px.y) / camera.focal_px.y,
            1.0,
        );
        let ray = view.reference_from_camera.rotation * ideal;
        let steep = (-ray.z).max(ray.xy().norm() / FARTHEST_HEIGHTS).max(1e-9);
        let place = Vector3::new(ray.x, ray.y, 0.0) * (height_m / steep) - Vector3::z() * height_m;
        let seen = axes * place;
        (low, high) = (low.inf(&seen), high.sup(&seen));
    }
    let half = 0.5 * (high - low);
    let half_side_m = 1.05 * half.x.max(half.y) + 0.05 * height_m;
    let half_depth_m = half.z + (2.0 * half_side_m).max(500.0);
    ShadowBox { center_m: axes.tr_mul(&(0.5 * (low + high))), half_side_m, half_depth_m }
}
