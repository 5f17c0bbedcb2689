//! What a result says of itself, `summary.json`.

use super::error::EvaluationError;
use crate::dataset::DatasetError;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// What was estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mission {
    /// A lander's position, velocity and attitude.
    Landing,
    /// A small body's attitude, rate and inertia ratios.
    Tumbling,
    /// Tracks and relative rotations alone.
    Tracking,
}

/// The summary of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// What was estimated.
    pub mission: Mission,
    /// The whole object as it stands in the file.
    pub object: Value,
}

impl Summary {
    /// Reads `summary.json` of a result folder.
    ///
    /// # Errors
    /// Names the file if it is missing, not JSON, or its `mission` is not one of `landing`, `tumbling`, `tracking`.
    pub fn read(result_folder: &Path) -> Result<Self, EvaluationError> {
        let path = result_folder.join("summary.json");
        if !path.is_file() {
            let cure = "give the folder that 'opnav land', 'opnav tumble' or 'opnav track' wrote".into();
            return Err(DatasetError::Missing { path, cure }.into());
        }
        let text = std::fs::read_to_string(&path).map_err(DatasetError::io("read", &path))?;
        let unusable = |problem: String| DatasetError::Unusable { path: path.clone(), problem };
        let object: Value = serde_json::from_str(&text).map_err(|e| unusable(e.to_string()))?;
        let mission = object.get("mission").cloned().unwrap_or(Value::Null);
        let mission = serde_json::from_value(mission.clone())
            .map_err(|_| unusable(format!("its mission is {mission}, not landing, tumbling or tracking")))?;
        Ok(Summary { mission, object })
    }

    /// A whole number of the top level, such as `t0_ns`.
    pub fn integer(&self, key: &str) -> Option<i64> {
        self.object.get(key)?.as_i64()
    }
}
