//! Matching of descriptors: mutual best, ratio test (Lowe 2004), and a search radius where a prediction is given.

use super::cell_index::CellIndex;
use super::config::MatcherConfig;
use super::descriptor::{Descriptor, MatchLimits};
use crate::vision::features::Feature;
use nalgebra::Vector2;

/// Indices of the same surface point among the features of two pictures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexMatch {
    /// Index in the first picture.
    pub from: usize,
    /// Index in the second picture.
    pub to: usize,
    /// Distance of the two descriptors in their own measure: bits that differ, or length of the vector between them.
    pub distance: f64,
}

/// Features of one picture with their descriptors.
#[derive(Debug, Clone, Copy)]
pub struct Described<'a, D> {
    /// The features.
    pub features: &'a [Feature],
    /// One descriptor a feature.
    pub descriptors: &'a [Option<D>],
}

/// Best and second best so far.
#[derive(Clone, Copy)]
struct Best {
    index: usize,
    best: u32,
    second: u32,
}

impl Best {
    const NONE: Best = Best { index: usize::MAX, best: u32::MAX, second: u32::MAX };

    #[inline(always)]
    fn offer(&mut self, index: usize, distance: u32) {
        if distance < self.best {
            *self = Best { index, best: distance, second: self.best };
        } else if distance < self.second {
            self.second = distance;
        }
    }

    fn passes<D: Descriptor>(&self, limits: &MatchLimits) -> bool {
        let (best, second) = (D::distance(self.best), D::distance(self.second));
        best <= limits.max_distance && best < limits.max_ratio * second
    }
}

/// Matches two pictures' features anywhere in the picture: each the other's best, both passing the ratio test. In order
/// of the first picture's index.
pub fn match_features<D: Descriptor>(from: Described<D>, to: Described<D>, config: &MatcherConfig) -> Vec<IndexMatch> {
    let present =
        |d: Described<D>| -> Vec<usize> { (0..d.descriptors.len()).filter(|i| d.descriptors[*i].is_some()).collect() };
    let (rows, columns) = (present(from), present(to));
    if rows.is_empty() || columns.is_empty() {
        return Vec::new();
    }
    let mut best = BestOfBoth::new(from.features.len(), to.features.len());
    let (a, b) = (gathered(from, &rows), gathered(to, &columns));
    compare_all(&a, &b, &mut best);
    best.mutual::<D>(&D::limits(config))
}

/// As [`match_features`], with candidates only within the search radius of where `predict` puts a pixel of the first
/// picture; `None` from `predict` leaves the feature out.
pub fn match_features_guided<D: Descriptor>(
    from: Described<D>,
    to: Described<D>,
    predict: &dyn Fn(&Vector2<f64>) -> Option<Vector2<f64>>,
    config: &MatcherConfig,
) -> Vec<IndexMatch> {
    let index = CellIndex::new(to.features.iter().map(|f| &f.pixel_px), config.guided_radius_px);
    let mut best = BestOfBoth::new(from.features.len(), to.features.len());
    for (row, feature) in from.features.iter().enumerate() {
        let (Some(a), Some(predicted)) = (from.descriptors[row], predict(&feature.pixel_px)) else { continue };
        for column in index.near(&predicted) {
            let off = to.features[column].pixel_px - predicted;
            if let Some(b) = to.descriptors[column].filter(|_| off.norm() <= config.guided_radius_px) {
                best.offer(row, column, a.difference(&b));
            }
        }
    }
    best.mutual::<D>(&D::limits(config))
}

/// Descriptors with their features' indices.
fn gathered<D: Descriptor>(described: Described<D>, chosen: &[usize]) -> Vec<(usize, D)> {
    chosen.iter().filter_map(|i| described.descriptors[*i].map(|d| (*i, d))).collect()
}

#[inline(always)]
fn compare<D: Descriptor>(from: &[(usize, D)], to: &[(usize, D)], best: &mut BestOfBoth) {
    for (row, a) in from {
        for (column, b) in to {
            best.offer(*row, *column, a.difference(b));
        }
    }
}

/// Every descriptor against every other, with the processor's bit counter or wide vectors where it has them.
fn compare_all<D: Descriptor>(from: &[(usize, D)], to: &[(usize, D)], best: &mut BestOfBoth) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "popcnt")]
        fn with_popcnt<D: Descriptor>(from: &[(usize, D)], to: &[(usize, D)], best: &mut BestOfBoth) {
            compare(from, to, best);
        }
        #[target_feature(enable = "avx2")]
        fn with_avx2<D: Descriptor>(from: &[(usize, D)], to: &[(usize, D)], best: &mut BestOfBoth) {
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
    rows: Vec<Best>,
    columns: Vec<Best>,
}

impl BestOfBoth {
    fn new(rows: usize, columns: usize) -> Self {
        BestOfBoth { rows: vec![Best::NONE; rows], columns: vec![Best::NONE; columns] }
    }

    #[inline(always)]
    fn offer(&mut self, row: usize, column: usize, distance: u32) {
        self.rows[row].offer(column, distance);
        self.columns[column].offer(row, distance);
    }

    fn mutual<D: Descriptor>(&self, limits: &MatchLimits) -> Vec<IndexMatch> {
        let agree = |(from, best): (usize, &Best)| {
            let back = self.columns.get(best.index)?;
            let mutual = back.index == from && best.passes::<D>(limits) && back.passes::<D>(limits);
            mutual.then_some(IndexMatch { from, to: best.index, distance: D::distance(best.best) })
        };
        self.rows.iter().enumerate().filter_map(agree).collect()
    }
}
