//! Geological units: patches of lighter and darker ground whose contacts are scarps.
//!
//! A unit is where a field of noise is positive. The field is scaled to about the distance from the contact in m, and
//! displaced by the albedo fields of the finer octaves, so that contacts are ragged at every scale.

use super::site_taper::grown_from_site;
use crate::scene::noise::{NOISE_2D_STEEPEST, NoiseOctave, NoiseTable};
use crate::scene::terrain::relief::{FeatureSample, GroundDetail, OctaveSums};
use nalgebra::Vector2;

/// One size of geological units.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitClass {
    /// The field whose sign tells the units apart.
    pub field: NoiseOctave,
    /// First octave of the terrain that displaces the contact.
    pub first_octave: usize,
    /// Height of the scarp in m.
    pub scarp_m: f64,
    /// Half of the contact's width in m.
    pub half_width_m: f64,
    /// The scarp is lower than this times the distance from the origin.
    pub site_slope: f64,
    /// Relative difference of the albedo between the units.
    pub contrast: f64,
    /// Relative change of the albedo on the face of the scarp.
    pub face_contrast: f64,
}

/// Distance from the contact over wavelength and field, for the field's r.m.s. slope.
const DISTANCE_PER_FIELD: f64 = 1.4;
/// Octaves of at most this share of the units' wavelength displace contacts.
pub(super) const LARGEST_DISPLACING: f64 = 0.45;
/// Half-width of a scarp over its height: slopes of about 30°.
pub(super) const HALF_WIDTH: f64 = 1.3;

impl UnitClass {
    /// Wavelength over the size of details from which on units are evaluated.
    pub(in crate::scene) const SMALLEST_SHOWN: f64 = 1.25;

    /// Adds what the units do to a place (m).
    pub(in crate::scene) fn add_to(
        &self,
        total: &mut FeatureSample,
        at: &Vector2<f64>,
        (table, detail): (Option<&NoiseTable>, &GroundDetail),
        ground: &OctaveSums,
    ) {
        let [field, _] = self.field.values_planar_from(table, at.x, at.y);
        let per_field_m = DISTANCE_PER_FIELD * self.field.wavelength_m;
        // No narrower than the details that are evaluated, so that vertices do not miss it.
        let half_width_m = self.half_width_m.hypot(detail.height_m).max(1e-3);
        let (coarse_m, fine_most_m) = ground.coarse_displacement_m(self.first_octave);
        let coarse_m = per_field_m * field + coarse_m;
        if coarse_m.abs() > half_width_m + fine_most_m {
            self.add_side_to(total, at, (0.5_f64.copysign(coarse_m), detail));
            return;
        }
        let distance_m = coarse_m + ground.fine_displacement_m(self.first_octave);
        let across = distance_m / half_width_m;
        if across.abs() >= 1.0 {
            self.add_side_to(total, at, (0.5_f64.copysign(across), detail));
            return;
        }
        let flat = 1.0 - across * across;
        let side = across * (0.75 - 0.25 * across * across);
        self.add_side_to(total, at, (side, detail));
        let shown = self.shown(detail);
        // The face fades with the width that its slope is spread over.
        total.albedo += self.face_contrast * flat * flat * (self.half_width_m / half_width_m) * shown;
        if self.scarp_m > 0.0 {
            let field_gradient = self.field.sample_planar_from(table, at.x, at.y).relief_gradient.xy();
            let distance_gradient = field_gradient * per_field_m + ground.displacement_gradient(self.first_octave);
            let (scarp_m, _) = grown_from_site(self.scarp_m, self.site_slope, at);
            total.gradient += distance_gradient * (scarp_m * 0.75 * flat / half_width_m * shown);
        }
    }

    /// Adds what a place (m) has of the upper (0.5) or lower (-0.5) unit, apart from the contact's own slope.
    pub(in crate::scene) fn add_side_to(
        &self,
        total: &mut FeatureSample,
        at: &Vector2<f64>,
        (side, detail): (f64, &GroundDetail),
    ) {
        let (scarp_m, scarp_gradient) = grown_from_site(self.scarp_m, self.site_slope, at);
        let shown = self.shown(detail);
        total.height_m += scarp_m * side;
        total.gradient += scarp_gradient * (side * shown);
        total.albedo += self.contrast * side * shown;
    }

    /// How much of the units shading shows: patches that details barely resolve come in little by little.
    fn shown(&self, detail: &GroundDetail) -> f64 {
        const ALL: f64 = 5.0;
        if detail.feature_m <= 0.0 {
            return 1.0;
        }
        let sizes = self.field.wavelength_m / detail.feature_m;
        ((sizes - UnitClass::SMALLEST_SHOWN) / (ALL - UnitClass::SMALLEST_SHOWN)).clamp(0.0, 1.0)
    }

    /// The side on which all places within a distance of a place lie, for [`UnitClass::add_side_to`]; `None` if a contact
    /// may be near. `ground` is that of the place.
    pub(in crate::scene) fn side_around(
        &self,
        within_m: f64,
        ground: &OctaveSums,
        detail: &GroundDetail,
    ) -> Option<f64> {
        let per_field_m = DISTANCE_PER_FIELD * self.field.wavelength_m;
        let field = self.field.sample_planar(ground.at().x, ground.at().y).relief;
        let distance_m = per_field_m * field + ground.displacement_m(self.first_octave);
        let change_m = DISTANCE_PER_FIELD * NOISE_2D_STEEPEST * within_m
            + ground.displacement_change_m(self.first_octave, within_m)
            + self.half_width_m.hypot(detail.height_m).max(1e-3);
        (distance_m.abs() > change_m).then(|| 0.5_f64.copysign(distance_m))
    }
}
