//! Matching by OpenCV's brute-force matcher.

use super::descriptor::{DescriptorNorm, MatchLimits};
use super::descriptor_set::DescriptorSet;
use super::index_match::{Candidates, IndexMatch};
use opencv::core::{CV_8U, CV_32F, DMatch, Mat, NORM_HAMMING, NORM_L2SQR, Scalar, Vector, no_array};
use opencv::features2d::BFMatcher;
use opencv::prelude::*;

/// Rows that are masked together: a mask of all would grow with the product of both images' features.
const BAND: usize = 256;

/// A query's nearest row, and its distances to this and to the next nearest (infinite where there is none).
#[derive(Clone, Copy)]
struct Nearest {
    row: usize,
    best: f64,
    second: f64,
}

impl Nearest {
    fn passes(&self, limits: &MatchLimits) -> bool {
        self.best <= limits.max_distance && self.best < limits.max_ratio * self.second
    }
}

/// Rows of two sets, each the other's nearest, both passing the limits; in order of the first set's rows.
pub(super) fn matched(
    (from, to): (&DescriptorSet, &DescriptorSet),
    candidates: Option<&Candidates>,
    (norm, limits): (DescriptorNorm, &MatchLimits),
) -> opencv::Result<Vec<IndexMatch>> {
    let matcher = Matcher::new(norm)?;
    let (a, b) = (matcher.rows(from)?, matcher.rows(to)?);
    let forth = matcher.nearest(&a, &b, candidates.map(Vec::as_slice))?;
    let passing: Vec<(usize, Nearest)> =
        forth.into_iter().enumerate().filter_map(|(row, n)| Some((row, n.filter(|n| n.passes(limits))?))).collect();
    // The way back is asked only of rows that are somebody's nearest.
    let mut targets: Vec<usize> = passing.iter().map(|(_, nearest)| nearest.row).collect();
    targets.sort_unstable();
    targets.dedup();
    let mut asked = Mat::default();
    targets.iter().try_for_each(|row| asked.push_back(&b.row(*row as i32)?))?;
    let reversed = candidates.map(|candidates| reversed(candidates, &targets));
    let back = matcher.nearest(&asked, &a, reversed.as_deref())?;
    let mutual = |(row, nearest): (usize, Nearest)| {
        let target = targets.binary_search(&nearest.row).expect("every nearest row was asked");
        let agrees = back[target].is_some_and(|b| b.row == row && b.passes(limits));
        agrees.then_some(IndexMatch { from: row, to: nearest.row, distance: nearest.best })
    };
    Ok(passing.into_iter().filter_map(mutual).collect())
}

/// For each target the rows that have it among their candidates, ascending.
fn reversed(candidates: &Candidates, targets: &[usize]) -> Candidates {
    let mut reversed = vec![Vec::new(); targets.len()];
    for (row, candidates) in candidates.iter().enumerate() {
        for target in candidates.iter().filter_map(|c| targets.binary_search(c).ok()) {
            reversed[target].push(row);
        }
    }
    reversed
}

struct Matcher {
    brute_force: opencv::core::Ptr<BFMatcher>,
    norm: DescriptorNorm,
}

impl Matcher {
    fn new(norm: DescriptorNorm) -> opencv::Result<Self> {
        let by = match norm {
            DescriptorNorm::Hamming => NORM_HAMMING,
            DescriptorNorm::Euclidean => NORM_L2SQR,
        };
        Ok(Matcher { brute_force: BFMatcher::create(by, false)?, norm })
    }

    /// A set's rows as OpenCV compares them fastest.
    fn rows(&self, set: &DescriptorSet) -> opencv::Result<Mat> {
        let rows = Mat::new_rows_cols_with_data(set.len() as i32, set.row_bytes() as i32, set.bytes())?;
        let kind = match self.norm {
            DescriptorNorm::Hamming => CV_8U,
            DescriptorNorm::Euclidean => CV_32F,
        };
        let mut converted = Mat::default();
        rows.convert_to(&mut converted, kind, 1.0, 0.0)?;
        Ok(converted)
    }

    /// Nearest of `among` for each query, only among its candidates where they are given.
    fn nearest(
        &self,
        queries: &Mat,
        among: &Mat,
        candidates: Option<&[Vec<usize>]>,
    ) -> opencv::Result<Vec<Option<Nearest>>> {
        let Some(candidates) = candidates else { return self.two_nearest(queries, among, &no_array()) };
        let mut all = Vec::with_capacity(candidates.len());
        for (band, candidates) in candidates.chunks(BAND).enumerate() {
            let first = (band * BAND) as i32;
            let queries = queries.row_bounds(first, first + candidates.len() as i32)?;
            let mut mask =
                Mat::new_rows_cols_with_default(candidates.len() as i32, among.rows(), CV_8U, Scalar::all(0.0))?;
            for (row, candidates) in candidates.iter().enumerate() {
                let line = mask.at_row_mut::<u8>(row as i32)?;
                candidates.iter().for_each(|candidate| line[*candidate] = 1);
            }
            all.append(&mut self.two_nearest(&queries, among, &mask)?);
        }
        Ok(all)
    }

    fn two_nearest(
        &self,
        queries: &impl opencv::core::ToInputArray,
        among: &Mat,
        mask: &impl opencv::core::ToInputArray,
    ) -> opencv::Result<Vec<Option<Nearest>>> {
        let mut found = Vector::<Vector<DMatch>>::new();
        self.brute_force.knn_train_match(queries, among, &mut found, 2, mask, false)?;
        let distance = |m: DMatch| match self.norm {
            DescriptorNorm::Hamming => f64::from(m.distance),
            DescriptorNorm::Euclidean => f64::from(m.distance).sqrt(),
        };
        let nearest = |two: Vector<DMatch>| {
            let best = two.get(0).ok()?;
            let second = two.get(1).map_or(f64::INFINITY, distance);
            Some(Nearest { row: best.train_idx as usize, best: distance(best), second })
        };
        Ok(found.iter().map(nearest).collect())
    }
}
