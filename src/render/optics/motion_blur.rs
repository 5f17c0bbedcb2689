//! Times of the images that one image with motion is made of, and how much each counts in each row.

use crate::scene::ShutterConfig;

/// Motion in px from one image to the next.
const STEP_PX: f64 = 0.5;
/// Motion in px over the whole image's time that is not drawn.
const UNSEEN_PX: f64 = 0.1;

/// Images around a time stamp. Their number is odd, so that the one in the middle is taken at the time stamp itself.
#[derive(Debug, Clone, PartialEq)]
pub struct SubImages {
    /// Times after the time stamp in s.
    pub offsets_s: Vec<f64>,
    rows: Rows,
}

#[derive(Debug, Clone, PartialEq)]
enum Rows {
    /// Each image counts alike in all rows.
    Alike,
    /// Each row has its own window of time.
    Windows { step_s: f64, window_s: f64, row_time_s: f64, middle_row: f64 },
}

impl SubImages {
    /// Time in s from the first row's opening to the last row's end.
    pub fn span_s(shutter: &ShutterConfig, height_px: u32) -> f64 {
        shutter.exposure_time_s + shutter.row_time_s * f64::from(height_px.saturating_sub(1))
    }

    /// Images for a scene in which a point moves by `motion_px` at most over the whole span.
    pub fn new(shutter: &ShutterConfig, height_px: u32, motion_px: f64) -> Self {
        if motion_px <= UNSEEN_PX {
            return SubImages { offsets_s: vec![0.0], rows: Rows::Alike };
        }
        // At least one image on either side of the middle one.
        let most = f64::from(shutter.sub_pictures_at_most.saturating_sub(1) / 2).max(1.0);
        let on_a_side = (0.5 * motion_px / STEP_PX).ceil().clamp(1.0, most);
        match shutter.row_time_s > 0.0 {
            true => Self::by_rows(shutter, height_px, on_a_side),
            false => Self::all_rows(shutter.exposure_time_s, on_a_side),
        }
    }

    /// The middles of n equal parts of the exposure time, moved outward by n/√(n² - 1): so the second moment of their
    /// times is that of the whole exposure, T²/12.
    fn all_rows(exposure_time_s: f64, on_a_side: f64) -> Self {
        let count = 2.0 * on_a_side + 1.0;
        let step_s = exposure_time_s / (count * count - 1.0).sqrt();
        SubImages { offsets_s: steps(on_a_side, step_s), rows: Rows::Alike }
    }

    /// Equal steps over the whole span. Between two of them the radiance is taken as linear in time, which adds a sixth
    /// of the step's square to the second moment: each row's window is shortened by as much.
    fn by_rows(shutter: &ShutterConfig, height_px: u32, on_a_side: f64) -> Self {
        let step_s = 0.5 * Self::span_s(shutter, height_px) / on_a_side;
        let window_s = (shutter.exposure_time_s.powi(2) - 2.0 * step_s * step_s).max(0.0).sqrt();
        let middle_row = 0.5 * (f64::from(height_px) - 1.0);
        let rows = Rows::Windows { step_s, window_s, row_time_s: shutter.row_time_s, middle_row };
        SubImages { offsets_s: steps(on_a_side, step_s), rows }
    }

    /// Share of an image in a row; the shares of a row add up to 1.
    pub fn weight(&self, index: usize, row: usize) -> f32 {
        match self.rows {
            Rows::Alike => 1.0 / self.offsets_s.len() as f32,
            Rows::Windows { step_s, window_s, row_time_s, middle_row } => {
                let from_image_s = (row as f64 - middle_row) * row_time_s - self.offsets_s[index];
                (hat_mean(from_image_s / step_s, window_s / step_s)) as f32
            }
        }
    }
}

/// Equal steps around 0.
fn steps(on_a_side: f64, step_s: f64) -> Vec<f64> {
    let last = on_a_side as i32;
    (-last..=last).map(|k| f64::from(k) * step_s).collect()
}

/// Integral over a window of the hat function 1 - |x|, from -1 to 1, by the window's width; the hat itself if the window
/// is an instant.
fn hat_mean(center: f64, width: f64) -> f64 {
    if width < 1e-6 {
        return (1.0 - center.abs()).max(0.0);
    }
    let below = |x: f64| {
        let x = x.clamp(-1.0, 1.0);
        x + 0.5 - 0.5 * x * x.abs()
    };
    (below(center + 0.5 * width) - below(center - 0.5 * width)) / width
}

#[cfg(test)]
mod tests {
    use super::SubImages;
    use crate::scene::ShutterConfig;

    fn moments(images: &SubImages, row: usize) -> (f64, f64, f64) {
        let weighted = |f: &dyn Fn(f64) -> f64| -> f64 {
            let terms = images.offsets_s.iter().enumerate();
            terms.map(|(k, t)| f64::from(images.weight(k, row)) * f(*t)).sum()
        };
        let mean = weighted(&|t| t);
        (weighted(&|_| 1.0), mean, weighted(&|t| (t - mean) * (t - mean)))
    }

    #[test]
    fn times_have_the_moments_of_the_exposure() {
        let global = ShutterConfig { exposure_time_s: 0.2, ..ShutterConfig::default() };
        for motion_px in [0.3, 1.2, 7.0, 20.0] {
            let (sum, mean, variance) = moments(&SubImages::new(&global, 100, motion_px), 3);
            assert!((sum - 1.0).abs() < 1e-6 && mean.abs() < 1e-9, "{sum} {mean}");
            assert!((variance / (0.04 / 12.0) - 1.0).abs() < 1e-5, "{motion_px} px: {variance}");
        }
        let rolling = ShutterConfig { row_time_s: 1e-3, ..global };
        for row in [0, 20, 77, 99] {
            let (sum, mean, variance) = moments(&SubImages::new(&rolling, 100, 20.0), row);
            assert!((sum - 1.0).abs() < 1e-6, "row {row}: {sum}");
            assert!((mean - 1e-3 * (row as f64 - 49.5)).abs() < 1e-8, "row {row}: {mean}");
            assert!((variance / (0.04 / 12.0) - 1.0).abs() < 0.02, "row {row}: {variance}");
        }
        let instant = ShutterConfig { exposure_time_s: 0.0, ..rolling };
        let (sum, mean, _) = moments(&SubImages::new(&instant, 100, 20.0), 10);
        assert!((sum - 1.0).abs() < 1e-6 && (mean + 39.5e-3).abs() < 1e-8, "{sum} {mean}");
    }

    #[test]
    fn their_number_follows_the_motion_up_to_the_limit() {
        let shutter = ShutterConfig { exposure_time_s: 0.2, sub_pictures_at_most: 10, ..ShutterConfig::default() };
        let count = |motion_px: f64| SubImages::new(&shutter, 100, motion_px).offsets_s.len();
        assert_eq!([0.0, 0.05, 0.2, 2.0, 2.1, 3.5, 500.0].map(count), [1, 1, 3, 5, 7, 9, 9]);
    }
}
