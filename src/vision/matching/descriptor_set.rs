//! Descriptors of the features of an image.

use opencv::core::{KeyPoint, Mat, Vector};
use opencv::prelude::*;

/// Descriptors of an image's features, all of one length: a row of bytes for each feature that has one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DescriptorSet {
    row_bytes: usize,
    bytes: Vec<u8>,
    features: Vec<usize>,
}

impl DescriptorSet {
    /// An empty set with rows of a length (1 or more).
    pub fn new(row_bytes: usize) -> Self {
        DescriptorSet { row_bytes, bytes: Vec::new(), features: Vec::new() }
    }

    /// Adds the row of a feature, whose index is above those of all before.
    ///
    /// # Panics
    /// A row of another length, or an index out of order.
    pub fn push(&mut self, feature: usize, row: &[u8]) {
        assert!(row.len() == self.row_bytes && self.features.last().is_none_or(|last| *last < feature));
        self.features.push(feature);
        self.bytes.extend_from_slice(row);
    }

    /// From OpenCV's rows, whose key points hold their feature's index as `class_id`; only those that `keep` says.
    pub(super) fn from_opencv<T: opencv::core::DataType>(
        (key_points, rows): (&Vector<KeyPoint>, &Mat),
        row_bytes: usize,
        row: impl Fn(&[T], &mut Vec<u8>) -> bool,
    ) -> opencv::Result<Self> {
        let mut order: Vec<(usize, i32)> =
            key_points.iter().zip(0..).map(|(k, at)| (k.class_id() as usize, at)).collect();
        order.sort_unstable();
        let (mut set, mut bytes) = (DescriptorSet::new(row_bytes), Vec::with_capacity(row_bytes));
        for (feature, at) in order {
            bytes.clear();
            if row(rows.at_row::<T>(at)?, &mut bytes) {
                set.push(feature, &bytes);
            }
        }
        Ok(set)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.features.len()
    }

    /// Whether no feature is described.
    pub fn is_empty(&self) -> bool {
        self.features.is_empty()
    }

    /// Bytes of a row.
    pub fn row_bytes(&self) -> usize {
        self.row_bytes
    }

    /// Index of the feature of each row, ascending.
    pub fn features(&self) -> &[usize] {
        &self.features
    }

    /// All rows, one after the other.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The row of a feature, if it has one.
    pub fn of_feature(&self, feature: usize) -> Option<&[u8]> {
        let row = self.features.binary_search(&feature).ok()?;
        Some(&self.bytes[row * self.row_bytes..][..self.row_bytes])
    }
}
