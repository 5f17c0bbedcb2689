//! One image: shadow map, samples, shading.

use super::RenderConfig;
use super::error::RenderError;
use super::frame::RenderedFrame;
use super::gpu::{Gpu, Role, SampleTarget, StageTime, submit_timed};
use super::optics::Lens;
use super::shading::{ShadingJob, ShadingPass, ShadowMap};
use super::surface::Surface;
use super::world::World;
use crate::geometry::Camera;
use crate::scene::View;

/// Renders images of one world by one camera.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    camera: Camera,
    config: RenderConfig,
    surface: Surface,
    shadow_map: ShadowMap,
    lens: Lens,
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
        let lens = Lens::new(gpu, camera, config.supersampling)?;
        let shadow_map = ShadowMap::new(gpu, config.shadow_map_px.min(gpu.device.limits().max_texture_dimension_2d));
        let samples = SampleTarget::new(gpu, lens.raster_grid.size().expect("the lens has checked its size"));
        let surface = Surface::new(gpu, world)?;
        let shading =
            ShadingPass::new(gpu, &surface.shading_kind(config.surface_truth), &lens, (&samples, &shadow_map));
        Ok(Renderer { gpu: gpu.clone(), camera: *camera, config: *config, surface, shadow_map, lens, samples, shading })
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Renders one view. The same view gives the same bytes on the same adapter, whatever was rendered before.
    ///
    /// # Errors
    /// [`RenderError`] if the view cannot be an image (camera inside the body or below the ground, Sun below the
    /// horizon), or if the adapter fails.
    pub fn render(&mut self, view: &View) -> Result<RenderedFrame, RenderError> {
        let job = self.prepare(view)?;
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Stage::ALL.iter().for_each(|stage| self.record(*stage, &job, &mut encoder));
        self.gpu.queue.submit([encoder.finish()]);
        self.shading.fetch(&self.gpu)
    }

    /// Renders one view stage by stage, waiting for each, and says how long each took.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_timed(&mut self, view: &View) -> Result<(RenderedFrame, Vec<StageTime>), RenderError> {
        let (job, prepared) = StageTime::measure("prepare", || self.prepare(view));
        let (job, mut times) = (job?, vec![prepared]);
        for stage in Stage::ALL {
            times.push(submit_timed(&self.gpu, stage.name(), |encoder| self.record(stage, &job, encoder))?);
        }
        let (frame, fetched) = StageTime::measure("read back", || self.shading.fetch(&self.gpu));
        times.push(fetched);
        Ok((frame?, times))
    }

    fn prepare(&mut self, view: &View) -> Result<ShadingJob, RenderError> {
        let pose = &view.reference_from_camera;
        let numbers =
            pose.translation.vector.iter().chain(pose.rotation.coords.iter()).chain(view.sun_in_reference.iter());
        if !numbers.copied().all(f64::is_finite) {
            return Err(RenderError::ViewNotFinite { t_ns: view.t_ns });
        }
        let inputs = (&self.lens, &self.shadow_map);
        self.surface.prepare(&self.gpu, view, (&self.camera, &self.config), inputs)
    }

    fn record(&self, stage: Stage, job: &ShadingJob, encoder: &mut wgpu::CommandEncoder) {
        match stage {
            Stage::Shadows => self.surface.draw(&mut self.shadow_map.begin(encoder), Role::Shadow),
            Stage::Samples => self.surface.draw(&mut self.samples.begin(encoder), Role::PageImage),
            Stage::Shading => self.shading.record(&self.gpu, encoder, job),
        }
    }
}

/// What the adapter does for an image, in this order.
#[derive(Debug, Clone, Copy)]
enum Stage {
    Shadows,
    Samples,
    Shading,
}

impl Stage {
    const ALL: [Stage; 3] = [Stage::Shadows, Stage::Samples, Stage::Shading];

    fn name(self) -> &'static str {
        match self {
            Stage::Shadows => "shadow map",
            Stage::Samples => "surface samples",
            Stage::Shading => "shading",
        }
    }
}
