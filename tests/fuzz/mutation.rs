//! Damages files: bytes, numbers, lines, pieces of other files.

use rand::{Rng, RngExt};

/// What a number, a word or a separator may turn into.
const PIECES: [&str; 44] = [
    "",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "1e400",
    "-1e400",
    "1e308",
    "1e-320",
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "255",
    "256",
    "65536",
    "0.5",
    "1.",
    ".5",
    "+1",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "9223372036854775808",
    "-9223372036854775808",
    "-9223372036854775809",
    "18446744073709551615",
    "99999999999999999999999",
    "0x10",
    "1_000",
    "1e",
    "--1",
    " ",
    ",",
    ":",
    "/",
    "\"",
    "#",
    "[",
    "{",
    "\n",
    "é",
    "\u{feff}",
];

/// Longest file made.
const LONGEST: usize = 1 << 16;

/// A damaged copy of a file; `other` lends pieces.
pub fn damaged(file: &[u8], other: &[u8], random: &mut impl Rng) -> Vec<u8> {
    let mut bytes = file.to_vec();
    let changes = if random.random() { 1 } else { random.random_range(2..=4) };
    for _ in 0..changes {
        match random.random_range(0..12) {
            0 => flip(&mut bytes, random),
            1 => insert(&mut bytes, random),
            2 => cut(&mut bytes, random),
            3 => repeat(&mut bytes, random),
            4 => bytes.truncate(random.random_range(0..=bytes.len())),
            5 => splice(&mut bytes, other, random),
            6 | 7 => lines(&mut bytes, random),
            _ => word(&mut bytes, random),
        }
    }
    bytes.truncate(LONGEST);
    bytes
}

/// A place in the file, its end included.
fn place(bytes: &[u8], random: &mut impl Rng) -> usize {
    random.random_range(0..=bytes.len())
}

/// A short stretch of the file.
fn stretch(bytes: &[u8], random: &mut impl Rng) -> std::ops::Range<usize> {
    let from = place(bytes, random);
    from..(from + random.random_range(0..=40)).min(bytes.len())
}

fn flip(bytes: &mut [u8], random: &mut impl Rng) {
    if !bytes.is_empty() {
        let at = random.random_range(0..bytes.len());
        bytes[at] = if random.random() { bytes[at] ^ (1 << random.random_range(0..8)) } else { random.random() };
    }
}

fn insert(bytes: &mut Vec<u8>, random: &mut impl Rng) {
    let at = place(bytes, random);
    let value = [0, 0xff, b'-', b'.', b'0', b'\n', random.random()][random.random_range(0..7)];
    let count = if random.random_ratio(1, 8) { 4 } else { 1 };
    bytes.splice(at..at, std::iter::repeat_n(value, count));
}

fn cut(bytes: &mut Vec<u8>, random: &mut impl Rng) {
    bytes.drain(stretch(bytes, random));
}

fn repeat(bytes: &mut Vec<u8>, random: &mut impl Rng) {
    let piece = bytes[stretch(bytes, random)].to_vec();
    let at = place(bytes, random);
    bytes.splice(at..at, piece);
}

fn splice(bytes: &mut Vec<u8>, other: &[u8], random: &mut impl Rng) {
    let piece = other[stretch(other, random)].to_vec();
    let range = stretch(bytes, random);
    bytes.splice(range, piece);
}

/// Drops, doubles or swaps whole lines.
fn lines(bytes: &mut Vec<u8>, random: &mut impl Rng) {
    let mut lines: Vec<Vec<u8>> = bytes.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    if lines.is_empty() {
        return;
    }
    let (a, b) = (random.random_range(0..lines.len()), random.random_range(0..lines.len()));
    match random.random_range(0..3) {
        0 => drop(lines.remove(a)),
        1 => lines.insert(b, lines[a].clone()),
        _ => lines.swap(a, b),
    }
    *bytes = lines.concat();
}

/// Puts something else in the place of a word or number.
fn word(bytes: &mut Vec<u8>, random: &mut impl Rng) {
    let is_part = |b: &u8| b.is_ascii_alphanumeric() || b"+-._".contains(b);
    let at = place(bytes, random);
    let from = bytes[..at].iter().rposition(|b| !is_part(b)).map_or(0, |p| p + 1);
    let to = bytes[at..].iter().position(|b| !is_part(b)).map_or(bytes.len(), |p| at + p);
    let piece = PIECES[random.random_range(0..PIECES.len())];
    bytes.splice(from..to, piece.bytes());
}
