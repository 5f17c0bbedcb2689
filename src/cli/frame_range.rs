//! Ranges of frames on the command line.

use std::ops::Range;

/// Parses `A..B`: frames from A, counted from 0, up to and without B.
pub fn frame_range(text: &str) -> Result<Range<usize>, String> {
    let expected = || format!("'{text}' is not A..B with whole numbers A < B (frames count from 0, B is left out)");
    let (from, to) = text.split_once("..").ok_or_else(expected)?;
    let from: usize = from.trim().parse().map_err(|_| expected())?;
    let to: usize = to.trim().parse().map_err(|_| expected())?;
    if from < to { Ok(from..to) } else { Err(expected()) }
}
