//! Ripples: patches of wind-blown sand in parallel waves with rounded troughs and narrower crests.

use super::site_taper::grown_from_site;
use crate::scene::noise::{NOISE_2D_STEEPEST, NoiseOctave, NoiseTable};
use crate::scene::terrain::relief::{FeatureSample, GroundDetail};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Ripples of one wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct RippleClass {
    /// Distance between crests in m.
    pub wavelength_m: f64,
    /// Height of the crests over the troughs in m.
    pub height_m: f64,
    /// Ripples are lower than this times the distance from the origin.
    pub site_slope: f64,
    /// Direction across the crests; a unit vector.
    pub across: Vector2<f64>,
    /// Where sand lies: where this field and a part of `bend` exceed `least_cover`.
    pub cover: NoiseOctave,
    /// The field that bends the crests.
    pub bend: NoiseOctave,
    /// Least sum of the fields with sand.
    pub least_cover: f64,
    /// Relative change of the albedo from troughs to crests.
    pub albedo_contrast: f64,
}

/// Tables of the two fields of a class.
pub type RippleTables = [Option<NoiseTable>; 2];

impl RippleClass {
    /// Wavelength of the field of cover over that of the ripples.
    pub const COVER_WAVELENGTHS: f64 = 45.0;
    /// Wavelength of the field that bends crests over that of the ripples.
    pub const BEND_WAVELENGTHS: f64 = 7.0;
    /// Share of the bending field in the sum that tells where sand lies.
    pub const COVER_BY_BEND: f64 = 0.3;
    /// Phase that the bending field adds, in wavelengths.
    const BEND_PHASE: f64 = 2.2;
    /// Growth of the sum over which sand thickens to its full height.
    const EDGE: f64 = 0.12;

    /// Adds what the ripples do to a place (m).
    pub(in crate::scene) fn add_to(
        &self,
        total: &mut FeatureSample,
        at: &Vector2<f64>,
        (tables, detail): ([Option<&NoiseTable>; 2], &GroundDetail),
    ) {
        let [cover, _] = self.cover.values_planar_from(tables[0], at.x, at.y);
        // The bending field cannot exceed 1.
        if cover + Self::COVER_BY_BEND <= self.least_cover {
            return;
        }
        let [bend, _] = self.bend.values_planar_from(tables[1], at.x, at.y);
        let excess = (cover + Self::COVER_BY_BEND * bend - self.least_cover) / Self::EDGE;
        if excess <= 0.0 {
            return;
        }
        let cover_gradient = self.cover.sample_planar_from(tables[0], at.x, at.y).relief_gradient.xy();
        let bend_gradient = self.bend.sample_planar_from(tables[1], at.x, at.y).relief_gradient.xy();
        let s = excess.min(1.0);
        let sand = s * s * (3.0 - 2.0 * s);
        let sand_gradient = (cover_gradient + bend_gradient * Self::COVER_BY_BEND) * (6.0 * s * (1.0 - s) / Self::EDGE);
        let phase = self.across.dot(at) / self.wavelength_m + Self::BEND_PHASE * bend;
        let phase_gradient = self.across / self.wavelength_m + bend_gradient * Self::BEND_PHASE;
        let (sin, cos) = (TAU * (phase - phase.floor())).sin_cos();
        let half = 0.5 * (1.0 + cos);
        let (wave, wave_slope) = (half * half, -half * sin * TAU);
        let (height_m, height_gradient) = grown_from_site(self.height_m, self.site_slope, at);
        total.height_m += height_m * sand * wave;
        let gradient =
            height_gradient * (sand * wave) + (sand_gradient * wave + phase_gradient * (wave_slope * sand)) * height_m;
        let shown = self.shown(detail);
        total.gradient += gradient * shown;
        total.albedo += self.albedo_contrast * sand * (wave - 0.375) * shown;
    }

    /// How much of the waves shading shows: waves that details barely resolve would beat with them.
    fn shown(&self, detail: &GroundDetail) -> f64 {
        const NOTHING: f64 = 1.25;
        const ALL: f64 = 3.0;
        if detail.feature_m <= 0.0 {
            return 1.0;
        }
        let t = ((self.wavelength_m / detail.feature_m - NOTHING) / (ALL - NOTHING)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// Whether sand may lie within a distance of a place (both in m).
    pub(in crate::scene) fn may_lie_around(&self, at: &Vector2<f64>, within_m: f64) -> bool {
        let most = |field: &NoiseOctave| {
            let here = field.sample_planar(at.x, at.y).relief;
            (here + NOISE_2D_STEEPEST * within_m / field.wavelength_m).min(1.0)
        };
        most(&self.cover) + Self::COVER_BY_BEND * most(&self.bend) >= self.least_cover
    }
}
