//! Independent, reproducible random streams.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use sha2::{Digest, Sha256};

/// Stream number `index` (such as a row of an image) of a stream: independent of it and of its other sub-streams.
pub fn sub_stream(stream: &ChaCha8Rng, index: u64) -> ChaCha8Rng {
    let mut sub_stream = stream.clone();
    sub_stream.set_stream(index.wrapping_add(1));
    sub_stream.set_word_pos(0);
    sub_stream
}

/// Random generator for one `purpose` (such as `"imu"`) and one `index` (such as a frame or run number) of a seeded job.
///
/// Streams of different purposes or indices are independent, so the order in which frames are made does not matter.
pub fn random_stream(seed: u64, purpose: &str, index: u64) -> ChaCha8Rng {
    let mut hasher = Sha256::new();
    hasher.update(seed.to_le_bytes());
    hasher.update(index.to_le_bytes());
    hasher.update(purpose.as_bytes());
    ChaCha8Rng::from_seed(hasher.finalize().into())
}
