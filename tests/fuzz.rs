//! Every reader of files against damaged ones: no panic, no endless work, and an error that names the file.
//!
//! `cargo test` runs some hundreds of files a reader, always the same ones; `make fuzz` goes on for ten minutes a reader
//! (`FUZZ_SECONDS`) with the seed in `FUZZ_SEED`. A file that breaks a reader is kept, and its place is printed.

#[cfg(feature = "scene")]
mod bodies;
mod cameras;
mod campaign;
#[cfg(feature = "scene")]
mod found;
mod images;
mod mutation;
mod results;
#[cfg(feature = "scene")]
mod scenarios;
mod tables;

/// Makes a short and a long test of each target: its name, and a function that gives the [`campaign::Target`].
macro_rules! fuzzed {
    ($($name:ident: $target:expr;)*) => {$(
        mod $name {
            #[allow(unused_imports)]
            use super::*;

            #[test]
            fn in_short() {
                crate::fuzz::campaign::in_short($target);
            }

            #[test]
            #[ignore = "ten minutes"]
            fn at_length() {
                crate::fuzz::campaign::at_length($target);
            }
        }
    )*};
}
pub(crate) use fuzzed;
