//! Symmetric filters over images that arrive line by line: only the few lines that a filter reaches over are kept, so
//! that they stay in the processor's cache.
//!
//! Beyond its edges an image goes on as its mirror image about the edge's own pixels (`…2 1 | 0 1 2…`). Sums are always
//! made in the same order, pixel by pixel: how wide the processor's registers are does not show in them.

/// The last lines of an image.
pub(super) struct Lines {
    width: usize,
    height: usize,
    kept: usize,
    values: Vec<f32>,
    /// Lines that have been made, from the top.
    pub(super) made: usize,
}

impl Lines {
    /// Room for what a filter of `reach` lines above and below needs.
    pub(super) fn new((width, height): (usize, usize), reach: usize) -> Self {
        let kept = 2 * reach + 1;
        Lines { width, height, kept, values: vec![0.0; kept * width], made: 0 }
    }

    /// Line that is made next, to be filled.
    #[inline(always)]
    pub(super) fn next(&mut self) -> &mut [f32] {
        let at = self.made % self.kept * self.width;
        self.made += 1;
        &mut self.values[at..at + self.width]
    }

    /// A line of those kept, mirrored where it lies outside.
    #[inline(always)]
    pub(super) fn line(&self, y: isize) -> &[f32] {
        let at = mirrored(y, self.height) % self.kept * self.width;
        &self.values[at..at + self.width]
    }
}

/// Index of what lies at `at` of a row of `count`, mirrored about the first and the last.
#[inline(always)]
pub(super) fn mirrored(at: isize, count: usize) -> usize {
    let last = count as isize - 1;
    let mut at = at;
    while at < 0 || at > last {
        at = if last == 0 {
            0
        } else if at < 0 {
            -at
        } else {
            2 * last - at
        };
    }
    at as usize
}

/// Weights of a normal law, of the middle one and of those at each distance from it; their sum over both sides is 1.
pub(super) fn gaussian(sigma: f64) -> Vec<f32> {
    let reach = ((8.0 * sigma + 1.0).round() as usize | 1) / 2;
    let weight = |k: usize| (-(k as f64).powi(2) / (2.0 * sigma * sigma)).exp();
    let sum = weight(0) + 2.0 * (1..=reach).map(weight).sum::<f64>();
    (0..=reach).map(|k| (weight(k) / sum) as f32).collect()
}

/// Down the columns: `weights[k]` times the lines at distance `k` of the middle one, into a line with room on both sides.
#[inline(always)]
pub(super) fn down(lines: &Lines, y: usize, weights: &[f32], out: &mut Padded) {
    let inside = out.inside();
    weigh(lines.line(y as isize), weights[0], inside);
    for (k, weight) in weights.iter().enumerate().skip(1) {
        add_both((lines.line(y as isize - k as isize), lines.line(y as isize + k as isize)), *weight, inside);
    }
}

/// Along a line: `weights[k]` times the pixels at distance `k` on both sides.
#[inline(always)]
pub(super) fn along(line: &mut Padded, weights: &[f32], out: &mut [f32]) {
    line.mirror_edges();
    weigh(line.shifted(0), weights[0], out);
    for (k, weight) in weights.iter().enumerate().skip(1) {
        add_both((line.shifted(-(k as isize)), line.shifted(k as isize)), *weight, out);
    }
}

#[inline(always)]
fn weigh(from: &[f32], weight: f32, out: &mut [f32]) {
    out.iter_mut().zip(from).for_each(|(value, from)| *value = weight * from);
}

#[inline(always)]
fn add_both((a, b): (&[f32], &[f32]), weight: f32, out: &mut [f32]) {
    out.iter_mut().zip(a).zip(b).for_each(|((value, a), b)| *value += weight * (a + b));
}

/// A line with room for its mirror image on both sides.
pub(super) struct Padded {
    width: usize,
    reach: usize,
    values: Vec<f32>,
}

impl Padded {
    pub(super) fn new(width: usize, reach: usize) -> Self {
        Padded { width, reach, values: vec![0.0; width + 2 * reach] }
    }

    /// The line itself.
    #[inline(always)]
    pub(super) fn inside(&mut self) -> &mut [f32] {
        &mut self.values[self.reach..self.reach + self.width]
    }

    /// The line as seen from pixels further to the right.
    #[inline(always)]
    pub(super) fn shifted(&self, by: isize) -> &[f32] {
        let first = self.reach.wrapping_add_signed(by);
        &self.values[first..first + self.width]
    }

    #[inline(always)]
    pub(super) fn mirror_edges(&mut self) {
        for k in 1..=self.reach {
            let (left, right) =
                (mirrored(-(k as isize), self.width), mirrored((self.width + k - 1) as isize, self.width));
            self.values[self.reach - k] = self.values[self.reach + left];
            self.values[self.reach + self.width + k - 1] = self.values[self.reach + right];
        }
    }
}
