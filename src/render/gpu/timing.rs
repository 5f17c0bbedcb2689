//! Where the time of an image goes.

use super::device::Gpu;
use crate::render::error::RenderError;
use cpu_time::ProcessTime;
use std::time::Instant;

/// Time that one stage of an image took.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct StageTime {
    /// What was done.
    pub stage: &'static str,
    /// Time of all threads of this process in ms; a software adapter draws in them.
    pub cpu_ms: f64,
    /// Time on the clock in ms.
    pub wall_ms: f64,
    /// Time between the adapter's own time stamps in ms, if it has them.
    pub gpu_ms: Option<f64>,
}

impl StageTime {
    /// Does something and says how long it took.
    pub fn measure<T>(stage: &'static str, work: impl FnOnce() -> T) -> (T, StageTime) {
        let (cpu, wall) = (ProcessTime::now(), Instant::now());
        let done = work();
        let cpu_ms = cpu.elapsed().as_secs_f64() * 1e3;
        (done, StageTime { stage, cpu_ms, wall_ms: wall.elapsed().as_secs_f64() * 1e3, gpu_ms: None })
    }
}

/// Submits commands, waits for them and says how long they took.
pub fn submit_timed(
    gpu: &Gpu,
    stage: &'static str,
    record: impl FnOnce(&mut wgpu::CommandEncoder),
) -> Result<StageTime, RenderError> {
    let stamps = gpu.timestamps.then(|| Stamps::new(gpu));
    let (outcome, mut time) = StageTime::measure(stage, || {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        if let Some(stamps) = &stamps {
            encoder.write_timestamp(&stamps.queries, 0);
        }
        record(&mut encoder);
        if let Some(stamps) = &stamps {
            encoder.write_timestamp(&stamps.queries, 1);
            encoder.resolve_query_set(&stamps.queries, 0..2, &stamps.resolved, 0);
            encoder.copy_buffer_to_buffer(&stamps.resolved, 0, &stamps.readable, 0, 16);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely())
    });
    outcome.map_err(|e| gpu.error("finish a stage of the picture", e))?;
    time.gpu_ms = stamps.map(|stamps| stamps.elapsed_ms(gpu)).transpose()?;
    Ok(time)
}

struct Stamps {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
}

impl Stamps {
    fn new(gpu: &Gpu) -> Self {
        let buffer = |usage| super::geometry_pass::buffer(gpu, 16, usage);
        Stamps {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("time stamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
        }
    }

    fn elapsed_ms(&self, gpu: &Gpu) -> Result<f64, RenderError> {
        self.readable.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| gpu.error("read time stamps", e))?;
        let mapped = self.readable.get_mapped_range(..).map_err(|e| gpu.error("read time stamps", e))?;
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&mapped);
        Ok(stamps[1].saturating_sub(stamps[0]) as f64 * f64::from(gpu.queue.get_timestamp_period()) * 1e-6)
    }
}
