//! Runs a function of a shader on the adapter over many inputs, for comparison with its twin on the CPU.

use super::device::Gpu;
use super::geometry_pass::buffer;
use super::read_back::fetch_buffer;
use wgpu::util::DeviceExt;

/// What to run.
pub struct Twin<'a> {
    /// The shader, with one compute entry point of workgroups of 64.
    pub source: &'a str,
    /// Values of its overrides.
    pub constants: &'a [(&'a str, f64)],
    /// Contents of the storage buffers from binding 0 on.
    pub inputs: &'a [&'a [u8]],
    /// Bytes of the buffer at the binding after those, for the results.
    pub result_bytes: usize,
    /// Number of invocations, rounded up to whole workgroups.
    pub invocations: usize,
}

impl Twin<'_> {
    /// The results' bytes.
    pub fn run(&self, gpu: &Gpu) -> Vec<u8> {
        let device = &gpu.device;
        let upload = |contents: &&[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let results = buffer(gpu, self.result_bytes as u64, usage);
        let buffers: Vec<wgpu::Buffer> = self.inputs.iter().map(upload).chain([results]).collect();
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(self.source.into()),
        });
        let constants = self.constants;
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        let entries: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, b)| wgpu::BindGroupEntry { binding, resource: b.as_entire_binding() })
            .collect();
        let layout = pipeline.get_bind_group_layout(0);
        let group =
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups((self.invocations as u32).div_ceil(64), 1, 1);
        }
        fetch_buffer(gpu, encoder, &buffers[buffers.len() - 1])
    }
}
