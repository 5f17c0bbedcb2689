//! Matches by index.

/// Indices of the same surface point among the features of two images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexMatch {
    /// Index in the first image.
    pub from: usize,
    /// Index in the second image.
    pub to: usize,
    /// Distance of the two descriptors in their own measure: bits that differ, or length of the vector between them.
    pub distance: f64,
}

/// For each row of the first set the rows of the second that may match it, ascending.
pub(super) type Candidates = Vec<Vec<usize>>;
