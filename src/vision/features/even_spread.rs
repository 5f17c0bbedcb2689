//! Choosing features that cover the image.

/// Chooses at most `count` of `peaks` (response and pixel index) that `accept` makes something of (it is asked about few of
/// them), no two closer than `distance_px`, and gives what was made of them in order of response.
///
/// The image is cut into about `count / 2` cells; each round takes the strongest remaining peak of every cell, so that
/// dim ground is covered before bright ground is crowded.
pub(super) fn bucketed<T>(
    peaks: &[(f32, usize)],
    (width, height): (usize, usize),
    count: usize,
    distance_px: f64,
    accept: impl Fn(usize) -> Option<T>,
) -> Vec<T> {
    let cell = ((width * height) as f64 / (count as f64 / 2.0).max(1.0)).sqrt().max(distance_px).ceil() as usize;
    let mut sorted = peaks.to_vec();
    let mut cells = queues(&mut sorted, width.div_ceil(cell) * height.div_ceil(cell), |at| {
        (at / width / cell) * width.div_ceil(cell) + at % width / cell
    });
    let mut taken = Occupancy::new(width, height, distance_px);
    let mut chosen: Vec<(f32, usize, T)> = Vec::with_capacity(count);
    while chosen.len() < count && cells.iter().any(|c| !c.is_empty()) {
        let mut round: Vec<(f32, usize, T)> = Vec::new();
        for queue in &mut cells {
            while let Some((&(response, at), rest)) = queue.split_first() {
                *queue = rest;
                let made = if taken.is_free(at) { accept(at) } else { None };
                if let Some(made) = made {
                    taken.take(at);
                    round.push((response, at, made));
                    break;
                }
            }
        }
        round.sort_unstable_by(strongest_first);
        round.truncate(count - chosen.len());
        chosen.append(&mut round);
    }
    chosen.sort_unstable_by(strongest_first);
    chosen.into_iter().map(|(_, _, made)| made).collect()
}

fn strongest_first<T>(a: &(f32, usize, T), b: &(f32, usize, T)) -> std::cmp::Ordering {
    b.0.total_cmp(&a.0).then(a.1.cmp(&b.1))
}

/// Sorts the peaks by cell and gives each cell's, strongest first.
fn queues(peaks: &mut [(f32, usize)], cells: usize, cell_of: impl Fn(usize) -> usize) -> Vec<&[(f32, usize)]> {
    let mut starts = vec![0; cells + 1];
    peaks.iter().for_each(|(_, at)| starts[cell_of(*at) + 1] += 1);
    (1..=cells).for_each(|i| starts[i] += starts[i - 1]);
    let (mut next, unsorted) = (starts.clone(), peaks.to_vec());
    for peak in unsorted {
        let place = &mut next[cell_of(peak.1)];
        peaks[*place] = peak;
        *place += 1;
    }
    starts.windows(2).for_each(|w| {
        peaks[w[0]..w[1]].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    });
    starts.windows(2).map(|w| &peaks[w[0]..w[1]]).collect()
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

    fn is_free(&self, at: usize) -> bool {
        !self.blocked[at]
    }

    /// Takes a pixel: blocks the disc about it.
    fn take(&mut self, at: usize) {
        let (x, y) = (at % self.width, at / self.width);
        for j in y.saturating_sub(self.radius)..=(y + self.radius).min(self.height - 1) {
            for i in x.saturating_sub(self.radius)..=(x + self.radius).min(self.width - 1) {
                let d2 = (i.abs_diff(x).pow(2) + j.abs_diff(y).pow(2)) as f64;
                self.blocked[j * self.width + i] |= d2 < self.radius2;
            }
        }
    }
}
