//! What the machine offers, and what to do about what it lacks.

use crate::render::{AdapterReport, Gpu, list_adapters};
use crate::vision::opencv_version;
use serde::Serialize;

/// What was found on this machine.
#[derive(Debug, Clone, Serialize)]
pub struct Diagnosis {
    /// Version of opnav.
    pub opnav_version: &'static str,
    /// Version of OpenCV linked in.
    pub opencv_version: String,
    /// Graphics adapters.
    pub adapters: Vec<AdapterReport>,
    /// The adapter that rendering takes by default.
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

/// Looks at graphics adapters, OpenCV and processors.
pub fn diagnose() -> Diagnosis {
    let (default_adapter, advice) = match Gpu::new(None) {
        Ok(gpu) => (Some(gpu.adapter_name().to_string()), Vec::new()),
        Err(error) => (None, vec![error.to_string()]),
    };
    Diagnosis {
        opnav_version: env!("CARGO_PKG_VERSION"),
        opencv_version: opencv_version(),
        adapters: list_adapters(),
        default_adapter,
        threads: rayon::current_num_threads(),
        advice,
    }
}
