//! Exposure: how many electrons an irradiance frees.

use crate::render::frame::RenderedFrame;
use crate::scene::{Exposure, SensorConfig};

/// Electrons that an irradiance (I/F) of 1 frees; 0 if the exposure is automatic and nothing is lit.
pub(super) fn electrons_per_irradiance(irradiance: &[f32], mask: &[u8], config: &SensorConfig) -> f32 {
    let automatic = |(percentile, full_well_share): (f64, f64)| {
        let lit = || irradiance.iter().zip(mask).filter(|(_, m)| *m & RenderedFrame::LIT != 0).map(|(value, _)| *value);
        match quantile(lit, percentile) {
            Some(level) if level > 0.0 => full_well_share * config.full_well_electrons / f64::from(level),
            _ => 0.0,
        }
    };
    let electrons = match config.exposure {
        Exposure::Fixed { electrons_per_radiance } => electrons_per_radiance,
        Exposure::Timed { electrons_per_radiance_s } => electrons_per_radiance_s * config.shutter.exposure_time_s,
        Exposure::Auto | Exposure::Percentile { .. } => config.exposure.automatic_level().map_or(0.0, automatic),
    };
    electrons as f32
}

/// The value at the rank `share` (0 to 1, rounded down) of all; `None` if there is none. Two passes of counting, for the
/// bits of floats from 0 on sort like their values.
fn quantile<I: Iterator<Item = f32>>(values: impl Fn() -> I, share: f64) -> Option<f32> {
    let bits = || values().map(|value| value.max(0.0).to_bits());
    let mut coarse = vec![0_usize; 1 << 16];
    bits().for_each(|b| coarse[(b >> 16) as usize] += 1);
    let count: usize = coarse.iter().sum();
    let rank = (count.checked_sub(1)? as f64 * share) as usize;
    let (high, rank) = bin_of_rank(&coarse, rank)?;
    let mut fine = vec![0_usize; 1 << 16];
    bits().filter(|b| (b >> 16) as usize == high).for_each(|b| fine[(b & 0xffff) as usize] += 1);
    let (low, _) = bin_of_rank(&fine, rank)?;
    Some(f32::from_bits((high << 16 | low) as u32))
}

/// The bin that holds the rank, and the rank within it.
fn bin_of_rank(counts: &[usize], rank: usize) -> Option<(usize, usize)> {
    let mut rest = rank;
    for (bin, count) in counts.iter().enumerate() {
        if rest < *count {
            return Some((bin, rest));
        }
        rest -= count;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::quantile;
    use crate::stats::random_stream;
    use rand::RngExt;

    #[test]
    fn quantile_is_that_of_sorted_values() {
        let mut random = random_stream(1, "quantile test", 0);
        let values: Vec<f32> = (0..5000).map(|_| random.random::<f32>().powi(6)).collect();
        let mut sorted = values.clone();
        sorted.sort_by(f32::total_cmp);
        for (share, rank) in [(0.0, 0), (0.5, 2499), (0.99, 4949), (1.0, 4999)] {
            assert_eq!(quantile(|| values.iter().copied(), share), Some(sorted[rank]));
        }
        assert_eq!(quantile(std::iter::empty, 0.5), None);
    }
}
