//! One picture: shadow map, samples, shading.

use super::geometry_pass::Role;
use super::sample_grid::SampleGrid;
use super::shading::ShadingPass;
use super::shadow::ShadowMap;
use super::surface::Surface;
use super::targets::SampleTarget;
use super::{Gpu, RenderConfig, RenderError, RenderedFrame};
use crate::geometry::{Camera, Distortion};
use crate::scene::{SmallBody, Terrain, View};

/// What pictures are taken of.
#[derive(Debug, Clone, Copy)]
pub enum World<'a> {
    /// Terrain; the views' reference frame is the site.
    Terrain(&'a Terrain),
    /// A small body; the views' reference frame is the asteroid.
    Body(&'a SmallBody),
}

/// Renders pictures of one world by one camera.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    camera: Camera,
    config: RenderConfig,
    surface: Surface,
    shadow_map: ShadowMap,
    grid: SampleGrid,
    samples: SampleTarget,
    shading: ShadingPass,
}

impl Renderer {
    /// Prepares to render.
    ///
    /// # Errors
    /// [`RenderError`] if the camera, the mesh or the configuration cannot be rendered.
    pub fn new(gpu: &Gpu, world: World, camera: &Camera, config: &RenderConfig) -> Result<Self, RenderError> {
        config.validate()?;
        camera.validate()?;
        if camera.distortion != Distortion::None {
            return Err(RenderError::DistortedCamera);
        }
        let (width_px, height_px) = (camera.width_px, camera.height_px);
        let limit_px = gpu.device.limits().max_texture_dimension_2d;
        let grid = SampleGrid { stride: config.supersampling, size_px: (width_px, height_px) };
        let Some(size) = grid.size().filter(|(width, height)| *width.max(height) <= limit_px) else {
            let supersampling = config.supersampling;
            return Err(RenderError::PictureTooLarge { width_px, height_px, supersampling, limit_px });
        };
        let shadow_map = ShadowMap::new(gpu, config.shadow_map_px.min(limit_px));
        let samples = SampleTarget::new(gpu, size);
        let surface = Surface::new(gpu, world)?;
        let shading = ShadingPass::new(gpu, grid.size_px, surface.shading_entry(), (&samples, &shadow_map));
        Ok(Renderer { gpu: gpu.clone(), camera: *camera, config: *config, surface, shadow_map, grid, samples, shading })
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Renders one view. The same view gives the same bytes on the same adapter, whatever was rendered before.
    ///
    /// # Errors
    /// [`RenderError`] if the view cannot be a picture (camera inside the body or below the ground, Sun below the
    /// horizon), or if the adapter fails.
    pub fn render(&mut self, view: &View) -> Result<RenderedFrame, RenderError> {
        let pose = &view.reference_from_camera;
        let numbers =
            pose.translation.vector.iter().chain(pose.rotation.coords.iter()).chain(view.sun_in_reference.iter());
        if !numbers.copied().all(f64::is_finite) {
            return Err(RenderError::ViewNotFinite { t_ns: view.t_ns });
        }
        let shading =
            self.surface.prepare(&self.gpu, view, (&self.camera, &self.config), (&self.grid, &self.shadow_map))?;
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.surface.draw(&mut self.shadow_map.begin(&mut encoder), Role::Shadow);
        self.surface.draw(&mut self.samples.begin(&mut encoder), Role::Picture);
        self.shading.record(&self.gpu, &mut encoder, &shading);
        self.gpu.queue.submit([encoder.finish()]);
        self.shading.fetch(&self.gpu)
    }
}
