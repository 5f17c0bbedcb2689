//! How files come to be whole: written to a temporary name and renamed (`atomic`), as tables with their header and unit
//! (`table`), noted with their checksums in a journal so that an interrupted job goes on where it stopped (`journal`,
//! `checksums`), and described by the data set's `manifest`. Every writer of this room goes through here.

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
