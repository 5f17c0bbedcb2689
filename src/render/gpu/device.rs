//! The graphics adapter and its device.

use crate::render::error::RenderError;

/// An adapter that this machine offers.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct AdapterReport {
    /// Name, such as `llvmpipe (LLVM 15.0.6, 256 bits)`.
    pub name: String,
    /// Graphics interface, such as `vulkan`.
    pub backend: String,
    /// Kind, such as `Cpu` or `DiscreteGpu`.
    pub device_type: String,
    /// Driver and its version.
    pub driver: String,
}

/// A graphics device; clones share it.
#[derive(Debug, Clone)]
pub struct Gpu {
    pub(in crate::render) device: wgpu::Device,
    pub(in crate::render) queue: wgpu::Queue,
    adapter_name: String,
    /// Whether the adapter can stamp commands with its time.
    pub(super) timestamps: bool,
}

/// Every adapter that this machine offers, real ones first.
pub fn list_adapters() -> Vec<AdapterReport> {
    adapters().iter().map(report).collect()
}

impl Gpu {
    /// Opens the adapter whose name contains `adapter` (any case), or the best one.
    ///
    /// # Errors
    /// [`RenderError`] says what to install, or lists the names available.
    pub fn new(adapter: Option<&str>) -> Result<Self, RenderError> {
        let found = adapters();
        if found.is_empty() {
            return Err(RenderError::NoAdapter);
        }
        let wanted = adapter.unwrap_or("").to_lowercase();
        let Some(chosen) = found.iter().find(|a| a.get_info().name.to_lowercase().contains(&wanted)) else {
            let available = found.iter().map(|a| a.get_info().name).collect::<Vec<_>>().join(", ");
            return Err(RenderError::AdapterNotFound { wanted: adapter.unwrap_or("").into(), available });
        };
        let adapter_name = chosen.get_info().name;
        let stamping = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
        let timestamps = chosen.features().contains(stamping);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("opnav"),
            required_features: if timestamps { stamping } else { wgpu::Features::empty() },
            required_limits: chosen.limits(),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(chosen.request_device(&descriptor)).map_err(|e| {
            RenderError::Device { adapter: adapter_name.clone(), action: "open a device", problem: e.to_string() }
        })?;
        if chosen.get_info().device_type == wgpu::DeviceType::Cpu {
            keep_freed_memory();
        }
        Ok(Gpu { device, queue, adapter_name, timestamps })
    }

    /// Name of the adapter.
    pub fn adapter_name(&self) -> &str {
        &self.adapter_name
    }

    pub(in crate::render) fn error(&self, action: &'static str, problem: impl ToString) -> RenderError {
        RenderError::Device { adapter: self.adapter_name.clone(), action, problem: problem.to_string() }
    }
}

/// Has the C library keep memory that is freed: a software adapter asks for some tens of megabytes and frees them several
/// times an image, and a sixth of an image's time went into clearing fresh pages. glibc keeps twice the largest block
/// that was freed, of up to 32 MiB (mallopt(3), `M_MMAP_THRESHOLD`); elsewhere this does nothing.
fn keep_freed_memory() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(31 << 20)));
}

fn adapters() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    let mut found = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    found.sort_by_key(|a| match a.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Cpu | wgpu::DeviceType::Other => 3,
    });
    found
}

fn report(adapter: &wgpu::Adapter) -> AdapterReport {
    let info = adapter.get_info();
    AdapterReport {
        name: info.name,
        backend: info.backend.to_string(),
        device_type: format!("{:?}", info.device_type),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_string(),
    }
}
