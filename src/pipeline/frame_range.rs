//! Which frames a story takes.

use super::error::PipelineError;
use std::ops::Range;

/// The frames asked for, or all; refused where they do not lie within those there are.
pub(super) fn checked_frames(frames: Option<Range<usize>>, available: usize) -> Result<Range<usize>, PipelineError> {
    let range = frames.unwrap_or(0..available);
    if range.start >= range.end || range.end > available {
        return Err(PipelineError::FrameRange { from: range.start, to: range.end, available });
    }
    Ok(range)
}
