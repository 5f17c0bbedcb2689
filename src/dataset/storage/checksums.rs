//! SHA-256 checksums of files.

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Name of the journal under a data set's root.
pub(super) const JOURNAL: &str = "unfinished.txt";

/// SHA-256 of file contents, by path relative to the data set's root.
pub type Checksums = BTreeMap<String, String>;

/// SHA-256 of some bytes as hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}
