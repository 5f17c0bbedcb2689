//! Descriptors and their matching.

mod cell_index;
mod config;
mod describe;
mod descriptor;
mod descriptor_config;
mod descriptor_kind;
mod descriptor_set;
mod fused_matcher;
mod index_match;
mod matcher;
mod opencv_matcher;
mod orb;
mod sift;

pub use cell_index::CellIndex;
pub use config::MatcherConfig;
pub use describe::describe_features;
pub use descriptor::{Descriptor, DescriptorNorm, MatchLimits, Orientation};
pub use descriptor_config::{DescriptorConfig, SiftConfig};
pub use descriptor_kind::DescriptorKind;
pub use descriptor_set::DescriptorSet;
pub use index_match::IndexMatch;
pub use matcher::{Described, Predict, match_features, match_features_guided};
