//! One image of a sequence.

use std::path::PathBuf;

/// One image of a sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Position in the sequence, from 0.
    pub index: usize,
    /// Time in ns.
    pub t_ns: i64,
    /// The image's file.
    pub path: PathBuf,
}
