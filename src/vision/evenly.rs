//! Choosing features that cover the picture.

use std::collections::VecDeque;

/// Chooses at most `count` of `peaks` (response and pixel index, strongest first) that `accept` lets through (it is asked
/// about few of them), no two closer than `distance_px`.
///
/// The picture is cut into about `count / 2` cells; each round takes the strongest remaining peak of every cell, so that
/// dim ground is covered before bright ground is crowded. The result is in order of response.
pub(super) fn spread_evenly(
    peaks: &[(f32, usize)],
    (width, height): (usize, usize),
    count: usize,
    distance_px: f64,
    accept: impl Fn(usize) -> bool,
) -> Vec<(f32, usize)> {
    let cell = ((width * height) as f64 / (count as f64 / 2.0).max(1.0)).sqrt().max(distance_px).ceil() as usize;
    let columns = width.div_ceil(cell);
    let mut cells: Vec<VecDeque<(f32, usize)>> = vec![VecDeque::new(); columns * height.div_ceil(cell)];
    for &peak in peaks {
        let (x, y) = (peak.1 % width, peak.1 / width);
        cells[(y / cell) * columns + x / cell].push_back(peak);
    }
    let mut taken = Occupancy::new(width, height, distance_px);
    let mut chosen = Vec::with_capacity(count);
    while chosen.len() < count && cells.iter().any(|c| !c.is_empty()) {
        let mut round: Vec<(f32, usize)> = Vec::new();
        for queue in &mut cells {
            let mut waiting = std::iter::from_fn(|| queue.pop_front());
            round.extend(waiting.find(|p| accept(p.1) && taken.take(p.1 % width, p.1 / width)));
        }
        round.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        round.truncate(count - chosen.len());
        chosen.append(&mut round);
    }
    chosen.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    chosen
}

/// Which pixels are too close to a chosen feature.
struct Occupancy {
    width: usize,
    height: usize,
    radius: usize,
    radius2: f64,
    blocked: Vec<bool>,
}

impl Occupancy {
    fn new(width: usize, height: usize, distance_px: f64) -> Self {
        let blocked = vec![false; width * height];
        Occupancy { width, height, radius: distance_px.ceil() as usize, radius2: distance_px * distance_px, blocked }
    }

    /// Takes a pixel and blocks the disc about it; `false` where it is already blocked.
    fn take(&mut self, x: usize, y: usize) -> bool {
        if self.blocked[y * self.width + x] {
            return false;
        }
        for j in y.saturating_sub(self.radius)..=(y + self.radius).min(self.height - 1) {
            for i in x.saturating_sub(self.radius)..=(x + self.radius).min(self.width - 1) {
                let d2 = (i.abs_diff(x).pow(2) + j.abs_diff(y).pow(2)) as f64;
                self.blocked[j * self.width + i] |= d2 < self.radius2;
            }
        }
        true
    }
}
