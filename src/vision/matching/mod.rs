//! Descriptors and their matching. A `descriptor` describes features by rows of bytes (`orb`, `sift`; `descriptor_kind`
//! is the list of all, `describe` the way in); `matcher` finds mutual best matches, anywhere or near a prediction
//! (`cell_index`), by OpenCV's code (`opencv_matcher`) or our own (`fused_matcher`). What matches mean for the motion
//! is the business of `pair`.

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
