//! Matching in one pass over all pairs of descriptors, both ways at once.

use super::descriptor::{DescriptorNorm, MatchLimits};
use super::descriptor_set::DescriptorSet;
use super::index_match::{Candidates, IndexMatch};

/// The same rows as OpenCV's matcher finds; `None` for descriptors of a form that this does not know.
pub(super) fn matched(
    (from, to): (&DescriptorSet, &DescriptorSet),
    candidates: Option<&Candidates>,
    (norm, limits): (DescriptorNorm, &MatchLimits),
) -> Option<Vec<IndexMatch>> {
    match (norm, from.row_bytes(), to.row_bytes()) {
        (DescriptorNorm::Hamming, 32, 32) => Some(mutual::<Bits>((from, to), candidates, limits)),
        (DescriptorNorm::Euclidean, 128, 128) => Some(mutual::<Sums>((from, to), candidates, limits)),
        _ => None,
    }
}

/// A descriptor of a fixed size.
trait Comparable: Copy {
    /// Whether vectors of 256 bits compare two of them faster than whole words do.
    const WIDE: bool;

    fn from_row(row: &[u8]) -> Self;

    /// A whole number that grows with the distance, quick to find.
    fn difference(&self, other: &Self) -> u32;

    /// The distance that belongs to a difference.
    fn distance(difference: u32) -> f64;
}

/// 256 bits.
type Bits = [u64; 4];

impl Comparable for Bits {
    const WIDE: bool = false;

    fn from_row(row: &[u8]) -> Self {
        std::array::from_fn(|i| u64::from_le_bytes(row[8 * i..8 * i + 8].try_into().expect("eight bytes")))
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> u32 {
        self.iter().zip(other).map(|(x, y)| (x ^ y).count_ones()).sum()
    }

    #[inline(always)]
    fn distance(difference: u32) -> f64 {
        f64::from(difference)
    }
}

/// 128 components of a vector.
type Sums = [u8; 128];

impl Comparable for Sums {
    const WIDE: bool = true;

    fn from_row(row: &[u8]) -> Self {
        row.try_into().expect("128 bytes")
    }

    #[inline(always)]
    fn difference(&self, other: &Self) -> u32 {
        // Sixteen sums side by side, as the processor's vectors hold them. None can overflow: saying so leaves out the
        // checks of builds for development, which would keep it from using them.
        let mut sums = [0i32; 16];
        for block in 0..8 {
            for (lane, sum) in sums.iter_mut().enumerate() {
                let at = 16 * block + lane;
                let off = i16::from(self[at]).wrapping_sub(i16::from(other[at]));
                *sum = sum.wrapping_add(i32::from(off).wrapping_mul(i32::from(off)));
            }
        }
        sums.iter().fold(0i32, |all, sum| all.wrapping_add(*sum)) as u32
    }

    #[inline(always)]
    fn distance(difference: u32) -> f64 {
        f64::from(difference).sqrt()
    }
}

/// Best and second best so far.
#[derive(Clone, Copy)]
struct Best {
    row: usize,
    best: u32,
    second: u32,
}

impl Best {
    const NONE: Best = Best { row: usize::MAX, best: u32::MAX, second: u32::MAX };

    #[inline(always)]
    fn offer(&mut self, row: usize, difference: u32) {
        if difference < self.best {
            *self = Best { row, best: difference, second: self.best };
        } else if difference < self.second {
            self.second = difference;
        }
    }

    fn passes<D: Comparable>(&self, limits: &MatchLimits) -> bool {
        let (best, second) = (D::distance(self.best), D::distance(self.second));
        best <= limits.max_distance && best < limits.max_ratio * second
    }
}

fn mutual<D: Comparable>(
    (from, to): (&DescriptorSet, &DescriptorSet),
    candidates: Option<&Candidates>,
    limits: &MatchLimits,
) -> Vec<IndexMatch> {
    let rows = |set: &DescriptorSet| -> Vec<D> { set.bytes().chunks(set.row_bytes()).map(D::from_row).collect() };
    let (a, b) = (rows(from), rows(to));
    let mut best = BestOfBoth { from: vec![Best::NONE; a.len()], to: vec![Best::NONE; b.len()] };
    match candidates {
        None => compare_all(&a, &b, &mut best),
        Some(candidates) => {
            for (row, candidates) in candidates.iter().enumerate() {
                candidates.iter().for_each(|other| best.offer(row, *other, a[row].difference(&b[*other])));
            }
        }
    }
    best.mutual::<D>(limits)
}

#[inline(always)]
fn compare<D: Comparable>(from: &[D], to: &[D], best: &mut BestOfBoth) {
    for (row, a) in from.iter().enumerate() {
        for (other, b) in to.iter().enumerate() {
            best.offer(row, other, a.difference(b));
        }
    }
}

/// Every descriptor against every other, with the processor's bit counter or wide vectors where it has them.
fn compare_all<D: Comparable>(from: &[D], to: &[D], best: &mut BestOfBoth) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "popcnt")]
        fn with_popcnt<D: Comparable>(from: &[D], to: &[D], best: &mut BestOfBoth) {
            compare(from, to, best);
        }
        #[target_feature(enable = "avx2")]
        fn with_avx2<D: Comparable>(from: &[D], to: &[D], best: &mut BestOfBoth) {
            compare(from, to, best);
        }
        if D::WIDE && is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions that the function is compiled for.
            return unsafe { with_avx2(from, to, best) };
        }
        if !D::WIDE && is_x86_feature_detected!("popcnt") {
            // SAFETY: the processor has the instruction that the function is compiled for.
            return unsafe { with_popcnt(from, to, best) };
        }
    }
    compare(from, to, best);
}

struct BestOfBoth {
    from: Vec<Best>,
    to: Vec<Best>,
}

impl BestOfBoth {
    #[inline(always)]
    fn offer(&mut self, from: usize, to: usize, difference: u32) {
        self.from[from].offer(to, difference);
        self.to[to].offer(from, difference);
    }

    fn mutual<D: Comparable>(&self, limits: &MatchLimits) -> Vec<IndexMatch> {
        let agree = |(from, best): (usize, &Best)| {
            let back = self.to.get(best.row)?;
            let mutual = back.row == from && best.passes::<D>(limits) && back.passes::<D>(limits);
            mutual.then_some(IndexMatch { from, to: best.row, distance: D::distance(best.best) })
        };
        self.from.iter().enumerate().filter_map(agree).collect()
    }
}
