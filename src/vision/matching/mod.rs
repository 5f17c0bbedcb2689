//! Descriptors and their matching.

mod cell_index;
mod config;
mod descriptor;
mod descriptor_set;
mod matcher;
mod orb;
mod sift;

pub use cell_index::CellIndex;
pub use config::{DescriptorKind, MatcherConfig, SiftConfig};
pub use descriptor::{Descriptor, MatchLimits, Orientation};
pub use descriptor_set::{Descriptions, match_described};
pub use matcher::{Described, IndexMatch, match_features, match_features_guided};
pub use orb::{OrbDescriptor, describe_orb};
pub use sift::{SiftDescriptor, describe_sift};
