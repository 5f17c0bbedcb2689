//! Sums of noise octaves, each with its own rotation, offset and seed, so that no lattice shows.

use super::gradient_noise::{
    Corners, NOISE_2D_RMS, NOISE_2D_SLOPE_RMS, NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS, NoiseSample, PointGradients,
    albedo_gradient, corners_of, interpolate, interpolate_values, noise_3d, point_gradients, split,
};
use crate::stats::random_stream;
use nalgebra::{Matrix3, Rotation3, Unit, Vector2, Vector3};
use rand::RngExt;

/// One octave of surface detail.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseOctave {
    /// Edge of a lattice cell in m.
    pub wavelength_m: f64,
    /// Lattice coordinates of a point in m: `lattice_from_reference * point + offset`.
    pub lattice_from_reference: Matrix3<f64>,
    /// Offset in lattice units.
    pub offset: Vector3<f64>,
    /// Seed of the lattice's hash.
    pub seed: u32,
    /// Height in m that a noise value of 1 stands for.
    pub relief_m: f64,
    /// Relative change of the albedo that a noise value of 1 stands for.
    pub albedo: f64,
}

/// How strong octaves are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OctaveStrength {
    /// Largest wavelength in m.
    pub largest_m: f64,
    /// Every octave down to this wavelength in m.
    pub smallest_m: f64,
    /// R.m.s. slope of one octave at a wavelength of 1 m.
    pub slope_at_1_m: f64,
    /// Hurst exponent: the slope of an octave goes as the wavelength to the power of this minus 1.
    pub hurst: f64,
    /// Relative r.m.s. change of the albedo by one octave, for wavelengths well below [`OctaveStrength::EVEN_ALBEDO_M`].
    pub albedo_contrast: f64,
}

impl OctaveStrength {
    /// Albedo varies less, by the square root, at wavelengths beyond this one in m.
    pub const EVEN_ALBEDO_M: f64 = 300.0;

    /// Slope of one octave at 1 m for which all octaves down to `scale_m` add up to `rms_slope`.
    pub fn slope_at_1_m_from_rms(&self, rms_slope: f64, scale_m: f64) -> f64 {
        let sum: f64 =
            self.wavelengths_m().filter(|w| *w >= 0.999 * scale_m).map(|w| w.powf(2.0 * (self.hurst - 1.0))).sum();
        if sum > 0.0 { rms_slope / sum.sqrt() } else { 0.0 }
    }

    fn wavelengths_m(&self) -> impl Iterator<Item = f64> + use<> {
        let smallest_m = self.smallest_m;
        std::iter::successors(Some(self.largest_m), |w| Some(0.5 * w)).take_while(move |w| *w >= 0.999 * smallest_m)
    }
}

impl NoiseOctave {
    /// Octaves over the plane x, y, from the largest wavelength to the smallest.
    pub fn planar(strength: &OctaveStrength, seed: u64, purpose: &str) -> Vec<NoiseOctave> {
        build(strength, [NOISE_2D_RMS, NOISE_2D_SLOPE_RMS], |wavelength_m, index| {
            planar_placement(wavelength_m, seed, purpose, index)
        })
    }

    /// One field over the plane x, y with lattice cells of `wavelength_m`, for other uses than relief and albedo.
    pub fn field(wavelength_m: f64, seed: u64, purpose: &str, index: u64) -> NoiseOctave {
        let (lattice_from_reference, offset, seed) = planar_placement(wavelength_m, seed, purpose, index);
        NoiseOctave { wavelength_m, lattice_from_reference, offset, seed, relief_m: 0.0, albedo: 0.0 }
    }

    /// Octaves in space, from the largest wavelength to the smallest.
    pub fn solid(strength: &OctaveStrength, seed: u64, purpose: &str) -> Vec<NoiseOctave> {
        build(strength, [NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS], |wavelength_m, index| {
            let mut random = random_stream(seed, purpose, index);
            let axis = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0));
            let axis = Unit::try_new(axis, 1e-6).unwrap_or(Vector3::z_axis());
            let turn = Rotation3::from_axis_angle(&axis, random.random_range(0.0..std::f64::consts::TAU));
            let offset = Vector3::from_fn(|_, _| random.random_range(0.0..1e3));
            (turn.matrix() / wavelength_m, offset, random.random())
        })
    }

    /// The planar noise at a place (m); the gradient is per m.
    pub fn sample_planar(&self, x_m: f64, y_m: f64) -> NoiseSample {
        self.sample_planar_from(None, x_m, y_m)
    }

    /// As [`NoiseOctave::sample_planar`], exactly, with the lattice looked up in a table of the place's surroundings.
    pub(in crate::scene) fn sample_planar_from(&self, table: Option<&NoiseTable>, x_m: f64, y_m: f64) -> NoiseSample {
        let (cell, fraction) = self.cell_at(x_m, y_m);
        let mut sample = interpolate(&self.corners(table, cell), fraction);
        sample.relief_gradient = self.per_m(&sample.relief_gradient);
        sample
    }

    /// Relief and albedo of [`NoiseOctave::sample_planar_from`] alone.
    pub(in crate::scene) fn values_planar_from(&self, table: Option<&NoiseTable>, x_m: f64, y_m: f64) -> [f64; 2] {
        let (cell, fraction) = self.cell_at(x_m, y_m);
        interpolate_values(&self.corners(table, cell), fraction)
    }

    /// Gradient of the planar albedo field at a place (m), per m.
    pub(in crate::scene) fn albedo_gradient_from(
        &self,
        table: Option<&NoiseTable>,
        x_m: f64,
        y_m: f64,
    ) -> Vector2<f64> {
        let (cell, fraction) = self.cell_at(x_m, y_m);
        self.per_m(&albedo_gradient(&self.corners(table, cell), fraction).push(0.0)).xy()
    }

    /// Lattice coordinates of a place (m) in the plane.
    pub(super) fn planar_lattice(&self, x_m: f64, y_m: f64) -> [f64; 2] {
        let m = &self.lattice_from_reference;
        [m.m11 * x_m + m.m12 * y_m + self.offset.x, m.m21 * x_m + m.m22 * y_m + self.offset.y]
    }

    fn cell_at(&self, x_m: f64, y_m: f64) -> ([i64; 2], [f64; 2]) {
        let [x, y] = self.planar_lattice(x_m, y_m);
        let ((cell_x, fx), (cell_y, fy)) = (split(x), split(y));
        ([cell_x, cell_y], [fx, fy])
    }

    fn corners(&self, table: Option<&NoiseTable>, cell: [i64; 2]) -> Corners {
        match table {
            Some(table) => table.corners(cell),
            None => corners_of(cell, self.seed),
        }
    }

    fn per_m(&self, g: &Vector3<f64>) -> Vector3<f64> {
        let m = &self.lattice_from_reference;
        Vector3::new(m.m11 * g.x + m.m21 * g.y, m.m12 * g.x + m.m22 * g.y, 0.0)
    }

    /// The solid noise at a point (m); the gradient is per m.
    pub fn sample_solid(&self, point_m: &Vector3<f64>) -> NoiseSample {
        let mut sample = noise_3d(&(self.lattice_from_reference * point_m + self.offset), self.seed);
        sample.relief_gradient = self.lattice_from_reference.tr_mul(&sample.relief_gradient);
        sample
    }

    /// How much of an octave an image shows: 0 for lattice cells below one pixel footprint (waves of about two), 1 above
    /// two and a half, smooth between, so that nothing pops into view.
    pub fn visibility(wavelength_m: f64, footprint_m: f64) -> f64 {
        let t = ((wavelength_m / footprint_m - 1.0) / 1.5).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

fn planar_placement(wavelength_m: f64, seed: u64, purpose: &str, index: u64) -> (Matrix3<f64>, Vector3<f64>, u32) {
    let mut random = random_stream(seed, purpose, index);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), random.random_range(0.0..std::f64::consts::TAU));
    let offset = Vector3::new(random.random_range(0.0..1e3), random.random_range(0.0..1e3), 0.0);
    (turn.matrix() / wavelength_m, offset, random.random())
}

fn build(
    strength: &OctaveStrength,
    [value_rms, slope_rms]: [f64; 2],
    mut placement: impl FnMut(f64, u64) -> (Matrix3<f64>, Vector3<f64>, u32),
) -> Vec<NoiseOctave> {
    let octave = |(index, wavelength_m): (usize, f64)| {
        let (lattice_from_reference, offset, seed) = placement(wavelength_m, index as u64);
        let slope = strength.slope_at_1_m * wavelength_m.powf(strength.hurst - 1.0);
        NoiseOctave {
            wavelength_m,
            lattice_from_reference,
            offset,
            seed,
            relief_m: slope * wavelength_m / slope_rms,
            albedo: strength.albedo_contrast
                / (value_rms * (1.0 + wavelength_m / OctaveStrength::EVEN_ALBEDO_M).sqrt()),
        }
    };
    strength.wavelengths_m().enumerate().map(octave).collect()
}

/// Rectangles with more lattice points are not worth a table.
const MOST_POINTS: i64 = 1 << 14;

/// Gradients of an octave's lattice points in and around a rectangle.
#[derive(Debug, Clone)]
pub struct NoiseTable {
    first: [i64; 2],
    columns: usize,
    gradients: Vec<PointGradients>,
}

impl NoiseTable {
    /// The points that places between two corners (m) need; `None` where they are too many.
    pub fn covering(octave: &NoiseOctave, low_m: &Vector2<f64>, high_m: &Vector2<f64>) -> Option<NoiseTable> {
        let corners = [[low_m.x, low_m.y], [high_m.x, low_m.y], [low_m.x, high_m.y], [high_m.x, high_m.y]];
        let lattice = corners.map(|[x_m, y_m]| octave.planar_lattice(x_m, y_m));
        let ends = [0, 1].map(|axis| {
            let along = lattice.map(|point| point[axis]);
            let least = along.iter().copied().fold(f64::INFINITY, f64::min);
            let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            // Rounding can put a place of the rectangle's edge into the next cell.
            [(least - 1e-6).floor() as i64, (most + 1e-6).floor() as i64 + 1]
        });
        let [columns, rows] = ends.map(|[first, last]| last.saturating_sub(first).saturating_add(1));
        if columns.saturating_mul(rows) > MOST_POINTS {
            return None;
        }
        let [[first_x, last_x], [first_y, last_y]] = ends;
        let points = (first_y..=last_y).flat_map(|y| (first_x..=last_x).map(move |x| (x, y)));
        let gradients = points.map(|(x, y)| point_gradients(x, y, octave.seed)).collect();
        Some(NoiseTable { first: [first_x, first_y], columns: columns as usize, gradients })
    }

    /// Gradients at the corners of a cell of the rectangle.
    pub(super) fn corners(&self, [x, y]: [i64; 2]) -> Corners {
        let at = (y - self.first[1]) as usize * self.columns + (x - self.first[0]) as usize;
        let above = at + self.columns;
        [self.gradients[at], self.gradients[at + 1], self.gradients[above], self.gradients[above + 1]]
    }
}
