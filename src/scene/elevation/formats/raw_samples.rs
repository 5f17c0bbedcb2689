//! Samples as they stand in a file without a header of its own.

use super::file_raster::{MOST_POSTS, too_many};
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the samples of a file are laid out: row by row from the top left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RawLayout {
    /// Samples in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Kind of a sample.
    pub sample: SampleKind,
    /// Bytes before the first sample (default 0).
    #[serde(default)]
    pub skip_bytes: usize,
}

/// Kind and byte order of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SampleKind {
    /// Unsigned, 8 bits.
    U8,
    /// Signed, 8 bits.
    I8,
    /// Unsigned, 16 bits, the most significant byte first.
    U16Big,
    /// Unsigned, 16 bits, the least significant byte first.
    U16Little,
    /// Signed, 16 bits, the most significant byte first.
    I16Big,
    /// Signed, 16 bits, the least significant byte first.
    I16Little,
    /// Unsigned, 32 bits, the most significant byte first.
    U32Big,
    /// Unsigned, 32 bits, the least significant byte first.
    U32Little,
    /// Signed, 32 bits, the most significant byte first.
    I32Big,
    /// Signed, 32 bits, the least significant byte first.
    I32Little,
    /// IEEE float, 32 bits, the most significant byte first.
    F32Big,
    /// IEEE float, 32 bits, the least significant byte first.
    F32Little,
}

impl SampleKind {
    /// Bytes of a sample.
    pub fn bytes(self) -> usize {
        use SampleKind::*;
        match self {
            U8 | I8 => 1,
            U16Big | U16Little | I16Big | I16Little => 2,
            U32Big | U32Little | I32Big | I32Little | F32Big | F32Little => 4,
        }
    }

    /// The value of a sample's bytes, as many as [`SampleKind::bytes`] says.
    pub fn value(self, bytes: &[u8]) -> f64 {
        use SampleKind::*;
        let two = || [bytes[0], bytes[1]];
        let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
        match self {
            U8 => f64::from(bytes[0]),
            I8 => f64::from(bytes[0] as i8),
            U16Big => f64::from(u16::from_be_bytes(two())),
            U16Little => f64::from(u16::from_le_bytes(two())),
            I16Big => f64::from(i16::from_be_bytes(two())),
            I16Little => f64::from(i16::from_le_bytes(two())),
            U32Big => f64::from(u32::from_be_bytes(four())),
            U32Little => f64::from(u32::from_le_bytes(four())),
            I32Big => f64::from(i32::from_be_bytes(four())),
            I32Little => f64::from(i32::from_le_bytes(four())),
            F32Big => f64::from(f32::from_be_bytes(four())),
            F32Little => f64::from(f32::from_le_bytes(four())),
        }
    }
}

impl RawLayout {
    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("columns", self.columns, 2, 1_000_000)?;
        limits::count("rows", self.rows, 2, 1_000_000)
    }

    /// That the samples fit in memory.
    pub(in crate::scene) fn check_size(&self) -> Result<(), String> {
        let fits = self.columns.saturating_mul(self.rows) <= MOST_POSTS;
        if fits { Ok(()) } else { Err(too_many([self.columns, self.rows])) }
    }

    /// The values in a file's bytes; `margins` are bytes before and after each row that hold no samples.
    ///
    /// # Errors
    /// A phrase that says how many bytes are missing.
    pub(in crate::scene) fn values(&self, bytes: &[u8], [before, after]: [usize; 2]) -> Result<Vec<f64>, String> {
        let size = self.sample.bytes();
        let row_bytes = before.saturating_add(self.columns.saturating_mul(size)).saturating_add(after);
        // The bytes after the last row may be missing.
        let needed = row_bytes.saturating_mul(self.rows - 1).saturating_add(row_bytes - after.min(row_bytes));
        let needed = needed.saturating_add(self.skip_bytes);
        if bytes.len() < needed {
            return Err(format!(
                "it has {} bytes, and {} columns and {} rows of {size} bytes a sample need {needed}: the file is cut \
                 short, or its size is stated wrongly",
                bytes.len(),
                self.columns,
                self.rows
            ));
        }
        let row = |row: usize| &bytes[self.skip_bytes + row * row_bytes + before..][..self.columns * size];
        Ok((0..self.rows).flat_map(|r| row(r).chunks_exact(size).map(|sample| self.sample.value(sample))).collect())
    }
}
