//! The surface being rendered, terrain or body, and the numbers of one view that its shaders read.

use super::RenderConfig;
use super::body::BodyGeometry;
use super::error::RenderError;
use super::gpu::{Geometry, Gpu, Role, Shading, columns, dropped, four};
use super::optics::Lens;
use super::shading::{
    ShadingJob, ShadingKind, ShadowBox, ShadowMap, octave_table, photometry_data, photometry_model, shadow_axes,
    texture_from_clip,
};
use super::terrain::{LevelRange, SeenGround, ShadedWavelengths, TerrainGeometry};
use super::world::World;
use crate::geometry::Camera;
use crate::scene::{BodySurface, NoiseOctave, OctaveStrength, Photometry, View};
use nalgebra::{Matrix4, Vector3};

/// A surface on the adapter.
#[derive(Debug)]
pub(super) struct Surface {
    kind: Kind,
    octaves: Vec<NoiseOctave>,
    mean_albedo: f64,
    photometry: Photometry,
    /// Radiance of the sky over that of a sunlit white surface; 0 for a body.
    sky_light: f64,
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
                photometry: *terrain.photometry(),
                sky_light: terrain.sky_light(),
                detail_slope: GROUND_DETAIL_SLOPE,
            },
            World::Body(body) => Surface {
                kind: Kind::Body(Box::new(BodyGeometry::new(gpu, &body.mesh)?)),
                octaves: body_octaves(&body.surface),
                mean_albedo: body.surface.albedo,
                photometry: body.surface.photometry,
                sky_light: 0.0,
                detail_slope: body.surface.detail_slope,
            },
        })
    }

    /// The variant of the shader that shades it.
    pub(super) fn shading_kind(&self, surface_truth: bool) -> ShadingKind {
        let is_terrain = matches!(self.kind, Kind::Terrain(_));
        ShadingKind { is_terrain, photometry_model: photometry_model(&self.photometry), surface_truth }
    }

    /// Checks the view, uploads its geometry, and returns what there is to shade.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        view: &View,
        (camera, config): (&Camera, &RenderConfig),
        (lens, shadow_map): (&Lens, &ShadowMap),
    ) -> Result<ShadingJob, RenderError> {
        let placement = match &mut self.kind {
            Kind::Body(body) => place_body(body, view, camera)?,
            Kind::Terrain(terrain) => place_terrain(terrain, gpu, (camera, view), (lens, config))?,
        };
        let rotation = view.reference_from_camera.rotation.to_homogeneous();
        let shadow_clip = placement.covered.clip_from_relative();
        let image_clip = lens.raster_grid.clip_from_camera(&lens.raster) * rotation.transpose();
        self.set_geometry(gpu, Role::PageImage, &placement.geometry(view, &image_clip));
        self.set_geometry(gpu, Role::Shadow, &placement.geometry(view, &shadow_clip));

        let eye_m = view.reference_from_camera.translation.vector;
        let ShadedWavelengths { carried_m, finest_m } = placement.shaded;
        let carried = self.octaves.partition_point(|octave| octave.wavelength_m >= carried_m);
        let octaves = octave_table(&self.octaves[carried..], &eye_m, finest_m);
        let texel_m = shadow_map.texel_m(&placement.covered);
        let sun_tangent = view.sun_angular_radius_rad.tan();
        let numbers = Shading {
            reference_from_camera: columns(&rotation),
            shadow_from_relative: columns(&(texture_from_clip() * shadow_clip)),
            sun: four(&view.sun_in_reference, self.sky_light),
            focal: [camera.focal_px.x, camera.focal_px.y, 0.0, 0.0].map(|v| v as f32),
            raster: lens.raster_intrinsics().map(|v| v as f32).into(),
            surface: [self.mean_albedo, self.detail_slope, placement.highest_m - eye_m.z, 0.0].map(|v| v as f32),
            shadow: four(&texel_m, sun_tangent),
            level: placement.level(),
            photometry: photometry_data(&self.photometry),
            octaves,
        };
        let widest_penumbra_texels = sun_tangent * placement.farthest_shadow_m / texel_m.xy().min();
        let octave_count = octaves.iter().filter(|octave| octave.row_x[3] > 0.0).count();
        Ok(ShadingJob { numbers, octave_count, widest_penumbra_texels, rectangle_px: self.rectangle_px(view, lens) })
    }

    /// The rectangle [left, top, width, height] in px outside of which there is no surface.
    fn rectangle_px(&self, view: &View, lens: &Lens) -> [u32; 4] {
        match &self.kind {
            Kind::Terrain(_) => [0, 0, lens.grid.size_px.0, lens.grid.size_px.1],
            Kind::Body(body) => lens.rectangle_px(view, &body.box_corners_m()),
        }
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

/// Where a surface lies in one view.
struct Placement {
    /// What the shadow map covers.
    covered: ShadowBox,
    /// Levels of terrain.
    levels: Option<LevelRange>,
    /// Origin of the vertices in the reference frame, m.
    anchor_m: Vector3<f64>,
    /// Octaves that are left to shading.
    shaded: ShadedWavelengths,
    /// Height of the highest terrain in the shadow map, in m.
    highest_m: f64,
    /// No surface throws a shadow farther, in m along the light.
    farthest_shadow_m: f64,
}

impl Placement {
    fn level(&self) -> [f32; 4] {
        self.levels
            .map_or([0.0; 4], |l| [l.height_m, l.range_over_spacing, l.morph_start, l.morph_end].map(|v| v as f32))
    }

    fn geometry(&self, view: &View, clip_from_relative: &Matrix4<f64>) -> Geometry {
        let from_anchor_m = view.reference_from_camera.translation.vector - self.anchor_m;
        Geometry {
            clip_from_relative: columns(clip_from_relative),
            forward: four(&(view.reference_from_camera.rotation * Vector3::z()), 0.0),
            camera_high: four(&from_anchor_m, 0.0),
            camera_low: four(&dropped(&from_anchor_m), 0.0),
            level: self.level(),
        }
    }
}

fn place_body(body: &BodyGeometry, view: &View, camera: &Camera) -> Result<Placement, RenderError> {
    body.check_view(view)?;
    let (center_m, radius_m) = body.bounding_sphere();
    let center_m = center_m - view.reference_from_camera.translation.vector;
    let axes = shadow_axes(&view.sun_in_reference);
    let covered = ShadowBox { axes, center_m, half_m: Vector3::new(1.02, 1.02, 1.1) * radius_m };
    Ok(Placement {
        covered,
        levels: None,
        anchor_m: Vector3::zeros(),
        shaded: ShadedWavelengths {
            carried_m: f64::INFINITY,
            finest_m: 0.5 * (center_m.norm() - radius_m).max(0.0) / camera.mean_focal_px(),
        },
        highest_m: 0.0,
        farthest_shadow_m: 2.0 * covered.half_m.z,
    })
}

fn place_terrain(
    terrain: &mut TerrainGeometry,
    gpu: &Gpu,
    (camera, view): (&Camera, &View),
    (lens, config): (&Lens, &RenderConfig),
) -> Result<Placement, RenderError> {
    let height_m = terrain.check_view(view)?;
    let levels = LevelRange::new(height_m, lens.finest_focal_px, config.vertex_spacing_px);
    let ground = SeenGround::new(terrain.terrain(), (&lens.raster, view), height_m);
    let tiles = terrain.prepare(gpu, &ground.volume(&lens.raster, view), &levels)?;
    let anchor_m = TerrainGeometry::anchor_m(&view.reference_from_camera.translation.vector).push(0.0);
    let [lowest_m, highest_m] = tiles.height_range_m;
    let focal_px = (camera.focal_px.x * camera.focal_px.y).sqrt();
    Ok(Placement {
        covered: ground.covered,
        levels: Some(levels),
        anchor_m,
        shaded: ShadedWavelengths::new((&lens.raster, view), &levels, tiles.seen_range_m, focal_px),
        highest_m,
        farthest_shadow_m: (highest_m - lowest_m) / view.sun_in_reference.z,
    })
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
