//! What the machine offers, and what to do about what it lacks.

#[cfg(feature = "render")]
use crate::render::{AdapterReport, Gpu, list_adapters};
use serde::Serialize;

/// What was found on this machine.
#[derive(Debug, Clone, Serialize)]
pub struct Diagnosis {
    /// Version of opnav.
    pub opnav_version: &'static str,
    /// Version of OpenCV linked in; `None` in a build without `vision`.
    pub opencv_version: Option<String>,
    /// Graphics adapters.
    #[cfg(feature = "render")]
    pub adapters: Vec<AdapterReport>,
    /// The adapter that rendering takes by default; `None` if there is none, or in a build without `render`.
    pub default_adapter: Option<String>,
    /// Processor threads.
    pub threads: usize,
    /// What is missing and what to do, empty if all is well.
    pub advice: Vec<String>,
}

impl Diagnosis {
    /// Whether everything needed is there.
    pub fn is_healthy(&self) -> bool {
        self.advice.is_empty()
    }
}

/// Looks at graphics adapters, OpenCV and processors, as far as the build needs them.
pub fn diagnose() -> Diagnosis {
    let (default_adapter, advice) = default_adapter();
    Diagnosis {
        opnav_version: env!("CARGO_PKG_VERSION"),
        opencv_version: opencv_version(),
        #[cfg(feature = "render")]
        adapters: list_adapters(),
        default_adapter,
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        advice,
    }
}

/// The adapter that rendering takes by default, or what to do about there being none.
#[cfg(feature = "render")]
fn default_adapter() -> (Option<String>, Vec<String>) {
    match Gpu::new(None) {
        Ok(gpu) => (Some(gpu.adapter_name().to_string()), Vec::new()),
        Err(error) => (None, vec![error.to_string()]),
    }
}

#[cfg(not(feature = "render"))]
fn default_adapter() -> (Option<String>, Vec<String>) {
    (None, Vec::new())
}

#[cfg(feature = "vision")]
fn opencv_version() -> Option<String> {
    Some(crate::vision::opencv_version())
}

#[cfg(not(feature = "vision"))]
fn opencv_version() -> Option<String> {
    None
}
