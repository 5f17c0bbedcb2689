//! How files are written and found again: atomic writes, tables, checksums, the journal of unfinished work, the manifest.

mod atomic;
mod checksums;
mod journal;
mod manifest;
mod table;

pub use atomic::{remove_partial_files, write_atomically, write_text};
pub use checksums::{Checksums, sha256_hex};
pub use journal::{EarlierWork, Journal, read_earlier_work};
pub use manifest::{Manifest, read_manifest, write_manifest};
pub use table::{TimedRow, TimedTable, parse_finite, read_text, read_timed_table, seconds_to_ns, write_timed_table};
