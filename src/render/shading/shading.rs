//! The last pass: from surface samples to radiance, depth and mask (`shaders/shading.wgsl`).

use super::job::{ShadingJob, ShadingKind};
use super::shading_pipelines::ShadingPipelines;
use super::shadow::ShadowMap;
use crate::render::error::RenderError;
use crate::render::frame::RenderedFrame;
use crate::render::gpu::{Gpu, ReadBack, SampleTarget, Shading, buffer, cleared, texture, uniform_entry};
use crate::render::optics::Lens;

#[derive(Debug)]
pub struct ShadingPass {
    pipelines: ShadingPipelines,
    uniform: wgpu::Buffer,
    group: wgpu::BindGroup,
    outputs: Vec<(wgpu::Texture, ReadBack)>,
    size_px: (u32, u32),
}

impl ShadingPass {
    pub fn new(gpu: &Gpu, kind: &ShadingKind, lens: &Lens, inputs: (&SampleTarget, &ShadowMap)) -> Self {
        let layout = group_layout(gpu);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = buffer(gpu, size_of::<Shading>() as u64, usage);
        let (samples, shadow) = inputs;
        let entries = [
            uniform.as_entire_binding(),
            wgpu::BindingResource::TextureView(&samples.samples),
            wgpu::BindingResource::TextureView(&shadow.view),
            wgpu::BindingResource::Sampler(&shadow.sampler),
            wgpu::BindingResource::TextureView(&lens.map),
        ];
        let entries: Vec<_> =
            (0..).zip(entries).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shading"),
            layout: &layout,
            entries: &entries,
        });
        let size_px = lens.grid.size_px;
        let output = |&(format, bytes)| {
            let target = texture(gpu, size_px, format, wgpu::TextureUsages::COPY_SRC);
            (target, ReadBack::new(gpu, size_px.0, size_px.1, bytes))
        };
        let outputs = kind.formats().iter().map(output).collect();
        let pipelines = ShadingPipelines::new(gpu, &layout, kind, lens);
        ShadingPass { pipelines, uniform, group, outputs, size_px }
    }

    pub fn record(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, job: &ShadingJob) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&job.numbers));
        let views: Vec<_> =
            self.outputs.iter().map(|(t, _)| t.create_view(&wgpu::TextureViewDescriptor::default())).collect();
        let attachments: Vec<_> = views.iter().map(|v| Some(cleared(v))).collect();
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("shading"),
                color_attachments: &attachments,
                ..wgpu::RenderPassDescriptor::default()
            });
            pass.set_pipeline(self.pipelines.of(gpu, job));
            pass.set_bind_group(0, &self.group, &[]);
            let [left, top, width, height] = job.rectangle_px;
            if width > 0 && height > 0 {
                pass.set_scissor_rect(left, top, width, height);
                pass.draw(0..3, 0..1);
            }
        }
        for (texture, read_back) in &self.outputs {
            read_back.copy_from(encoder, texture);
        }
    }

    /// Waits for the adapter and fetches the image.
    pub fn fetch(&self, gpu: &Gpu) -> Result<RenderedFrame, RenderError> {
        self.outputs.iter().for_each(|(_, read_back)| read_back.request());
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| gpu.error("finish the picture", e))?;
        let bytes = self.outputs.iter().map(|(_, r)| r.take(gpu)).collect::<Result<Vec<_>, _>>()?;
        let depth = |d: f32| if d > 0.0 { d } else { f32::NAN };
        Ok(RenderedFrame {
            width_px: self.size_px.0,
            height_px: self.size_px.1,
            radiance: bytemuck::pod_collect_to_vec(&bytes[0]),
            depth_m: bytemuck::pod_collect_to_vec::<u8, f32>(&bytes[1]).into_iter().map(depth).collect(),
            mask: bytes[2].clone(),
            surface: bytes.get(3).map(|b| bytemuck::pod_collect_to_vec(b)),
        })
    }
}

fn group_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let image = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let samples = image(wgpu::TextureSampleType::Float { filterable: false });
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shading"),
        entries: &[
            uniform_entry(0, wgpu::ShaderStages::FRAGMENT),
            entry(1, samples),
            entry(2, image(wgpu::TextureSampleType::Depth)),
            entry(3, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering)),
            entry(4, samples),
        ],
    })
}
