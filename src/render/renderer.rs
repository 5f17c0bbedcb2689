//! One picture: shadow map, truth at pixel centres, supersampled picture, shading.

use super::geometry_pass::Role;
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
    truth: SampleTarget,
    picture: SampleTarget,
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
        let fits = |size_px: u32| size_px.checked_mul(config.supersampling).is_some_and(|s| s <= limit_px);
        if !fits(width_px) || !fits(height_px) {
            let supersampling = config.supersampling;
            return Err(RenderError::PictureTooLarge { width_px, height_px, supersampling, limit_px });
        }
        let shadow_map = ShadowMap::new(gpu, config.shadow_map_px.min(limit_px));
        let truth = SampleTarget::new(gpu, width_px, height_px);
        let picture = SampleTarget::new(gpu, width_px * config.supersampling, height_px * config.supersampling);
        let surface = Surface::new(gpu, world)?;
        let inputs = (&picture, &truth, &shadow_map);
        let shading = ShadingPass::new(gpu, (width_px, height_px), surface.shading_entry(), inputs);
        Ok(Renderer {
            gpu: gpu.clone(),
            camera: *camera,
            config: *config,
            surface,
            shadow_map,
            truth,
            picture,
            shading,
        })
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
        let shading = self.surface.prepare(&self.gpu, view, (&self.camera, &self.config), &self.shadow_map)?;
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.surface.draw(&mut self.shadow_map.begin(&mut encoder), Role::Shadow);
        self.surface.draw(&mut self.truth.begin(&mut encoder), Role::Picture);
        self.surface.draw(&mut self.picture.begin(&mut encoder), Role::Picture);
        self.shading.record(&self.gpu, &mut encoder, &shading);
        self.gpu.queue.submit([encoder.finish()]);
        self.shading.fetch(&self.gpu)
    }
}
