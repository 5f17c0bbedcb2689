//! A plane with relief about it, seen twice: the likelihood of a match, its score and its information.
//!
//! In units of the plane's distance the inverse depth of a point at ray `x` of the first camera is `n·x + δ`, with a
//! relief `δ` that is normal with variance `τ²`. Its image in the second camera then lies about that of the plane,
//! `H = R + m nᵀ`, with the pixels' noise all round and the relief's parallax along the line to the epipole:
//!
//! `to ~ N(π(H x), s² Σ + τ² g gᵀ)`, `g = ∂π/∂δ`.
//!
//! As `τ` grows this becomes the epipolar constraint, and as it shrinks the homography of a plane; `τ` and `s` are
//! estimated with the motion, so nothing has to choose between the two. Scores and information are those of a normal law
//! whose mean and covariance both depend on the parameters (Kay 1993, eq. 3.31).

use crate::geometry::so3::{exp, tangent_basis};
use crate::vision::pair::normalized_match::NormalizedMatch;
use nalgebra::{Matrix2, Matrix2x3, Matrix3, SMatrix, SVector, Unit, UnitQuaternion, Vector2, Vector3};

/// Free parameters: rotation (3), translation over the plane's distance (3), normal (2), variances of relief and noise.
pub(super) const PARAMETERS: usize = 10;
/// Parameters of the motion and the plane.
pub(super) const GEOMETRY: usize = 8;
/// Place of the relief's variance among the parameters.
pub(super) const RELIEF: usize = 8;
/// Place of the noise's variance among the parameters.
pub(super) const NOISE: usize = 9;

/// A value a parameter.
pub(super) type Parameters = SVector<f64, PARAMETERS>;
/// Information of the parameters.
pub(super) type Information = SMatrix<f64, PARAMETERS, PARAMETERS>;

/// Motion over a plane with relief. A point `x` in the first camera is `R x + t` in the second.
#[derive(Debug, Clone, Copy)]
pub struct ReliefPlane {
    /// `R`; errors turn it as `exp(d) R`.
    pub rotation: UnitQuaternion<f64>,
    /// `m = t` over the plane's distance, in the second camera.
    pub translation: Vector3<f64>,
    /// The plane's normal in the first camera, away from it.
    pub normal: Unit<Vector3<f64>>,
    /// `τ²`: variance of the inverse depth about the plane, in units of the plane's inverse distance.
    pub relief_variance: f64,
    /// `s²`: variance of the noise over the nominal one.
    pub noise_variance: f64,
}

/// A match as a ground predicts it.
pub struct Prediction {
    /// Seen less predicted.
    pub(super) residual: Vector2<f64>,
    /// `g`: how the image moves with the relief.
    pub by_relief: Vector2<f64>,
    /// `Σ`: nominal covariance of the residual, both pixels' noise.
    pub nominal: Matrix2<f64>,
    /// Derivative of the image by the point in the second camera, and that point's depth there.
    projection: Matrix2x3<f64>,
    depth: f64,
}

/// What a match says about the parameters, as whitened rows: two of the mean, three of the covariance.
pub(super) struct Evidence {
    /// `-2 ln` of the likelihood, without its constant.
    pub(super) cost: f64,
    rows: SMatrix<f64, 5, PARAMETERS>,
    residual: SVector<f64, 5>,
}

impl Evidence {
    /// Derivative of the log-likelihood.
    pub(super) fn score(&self) -> Parameters {
        self.rows.tr_mul(&self.residual)
    }

    /// Expected information.
    pub(super) fn information(&self) -> Information {
        self.rows.tr_mul(&self.rows)
    }
}

impl ReliefPlane {
    /// `H = R + m nᵀ`.
    pub fn homography(&self) -> Matrix3<f64> {
        self.rotation.to_rotation_matrix().into_inner() + self.translation * self.normal.transpose()
    }

    /// The ground moved along its parameters; variances stay above nothing.
    pub(super) fn moved(&self, step: &Parameters) -> Self {
        let aside = tangent_basis(&self.normal) * step.fixed_rows::<2>(6);
        ReliefPlane {
            rotation: exp(&step.fixed_rows::<3>(0).into_owned()) * self.rotation,
            translation: self.translation + step.fixed_rows::<3>(3),
            normal: Unit::new_normalize(self.normal.into_inner() + aside),
            relief_variance: (self.relief_variance + step[RELIEF]).max(0.0),
            noise_variance: (self.noise_variance + step[NOISE]).max(0.25 * self.noise_variance),
        }
    }

    /// The image of a match; `None` where the plane lies behind the second camera.
    pub fn predict(&self, homography: &Matrix3<f64>, matched: &NormalizedMatch) -> Option<Prediction> {
        let p = homography * matched.first_ray();
        if p.z <= 1e-9 {
            return None;
        }
        let image = p.xy() / p.z;
        let projection = Matrix2x3::new(1.0, 0.0, -image.x, 0.0, 1.0, -image.y) / p.z;
        let by_from = projection * homography.fixed_columns::<2>(0);
        Some(Prediction {
            residual: matched.to - image,
            by_relief: projection * self.translation,
            nominal: matched.to_covariance + by_from * matched.from_covariance * by_from.transpose(),
            projection,
            depth: p.z,
        })
    }

    /// `S = s² Σ + τ² g gᵀ`.
    pub(super) fn covariance(&self, seen: &Prediction) -> Matrix2<f64> {
        seen.nominal * self.noise_variance + seen.by_relief * seen.by_relief.transpose() * self.relief_variance
    }

    /// Squared Mahalanobis distance of a match (two degrees of freedom) and the logarithm of its covariance's determinant.
    pub(super) fn misfit(&self, homography: &Matrix3<f64>, matched: &NormalizedMatch) -> Option<(f64, f64)> {
        let seen = self.predict(homography, matched)?;
        let s = self.covariance(&seen);
        let determinant = s.m11 * s.m22 - s.m12 * s.m21;
        let r = &seen.residual;
        let square = (s.m22 * r.x * r.x - 2.0 * s.m12 * r.x * r.y + s.m11 * r.y * r.y) / determinant;
        Some((square, determinant.ln()))
    }

    /// Derivatives of image and `g` by the eight geometric parameters.
    fn derivatives(
        &self,
        seen: &Prediction,
        matched: &NormalizedMatch,
        axes: &Axes,
    ) -> [(Vector2<f64>, Vector2<f64>); GEOMETRY] {
        let x = matched.first_ray();
        let turned = axes.rotation * x;
        let inverse_depth = self.normal.dot(&x);
        let derivative = |j: usize| {
            let dp = match j {
                0 => Vector3::new(0.0, -turned.z, turned.y),
                1 => Vector3::new(turned.z, 0.0, -turned.x),
                2 => Vector3::new(-turned.y, turned.x, 0.0),
                3..6 => Vector3::ith(j - 3, inverse_depth),
                _ => self.translation * axes.aside.column(j - 6).dot(&x),
            };
            let by_image = seen.projection * dp;
            let stretch = -(seen.by_relief * dp.z + by_image * self.translation.z) / seen.depth;
            let own = if (3..6).contains(&j) { seen.projection.column(j - 3).into_owned() } else { Vector2::zeros() };
            (by_image, stretch + own)
        };
        std::array::from_fn(derivative)
    }

    /// What a match says; `None` where the plane lies behind the second camera.
    pub(super) fn evidence(&self, axes: &Axes, matched: &NormalizedMatch) -> Option<Evidence> {
        const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
        let seen = self.predict(&axes.homography, matched)?;
        let (whitening, ln_determinant) = whitening(&self.covariance(&seen));
        let (z, g) = (whitening * seen.residual, whitening * seen.by_relief);
        // Half the inner product of symmetric matrices, as that of (m11, √2 m12, m22) / √2.
        let mut rows = SMatrix::<f64, 5, PARAMETERS>::zeros();
        for (j, (image, turn)) in self.derivatives(&seen, matched, axes).iter().enumerate() {
            let (mean, t) = (whitening * image, whitening * turn * self.relief_variance);
            let column = [mean.x, mean.y, 2.0 * H * g.x * t.x, g.x * t.y + g.y * t.x, 2.0 * H * g.y * t.y];
            rows.set_column(j, &SVector::from(column));
        }
        let noise = whitening * seen.nominal * whitening.transpose();
        rows.set_column(RELIEF, &SVector::from([0.0, 0.0, H * g.x * g.x, g.x * g.y, H * g.y * g.y]));
        rows.set_column(NOISE, &SVector::from([0.0, 0.0, H * noise.m11, noise.m12, H * noise.m22]));
        let residual = SVector::from([z.x, z.y, H * (z.x * z.x - 1.0), z.x * z.y, H * (z.y * z.y - 1.0)]);
        Some(Evidence { cost: z.norm_squared() + ln_determinant, rows, residual })
    }
}

/// `W` with `W S Wᵀ = 1`, and the logarithm of the determinant of `S`.
pub fn whitening(s: &Matrix2<f64>) -> (Matrix2<f64>, f64) {
    let a = s.m11.sqrt();
    let b = s.m12 / a;
    let c = (s.m22 - b * b).max(1e-300).sqrt();
    (Matrix2::new(1.0 / a, 0.0, -b / (a * c), 1.0 / c), 2.0 * (a * c).ln())
}

/// Matrices of a ground that all its matches share.
pub(super) struct Axes {
    pub(super) homography: Matrix3<f64>,
    rotation: Matrix3<f64>,
    aside: nalgebra::Matrix3x2<f64>,
}

impl Axes {
    pub(super) fn of(ground: &ReliefPlane) -> Self {
        Axes {
            homography: ground.homography(),
            rotation: ground.rotation.to_rotation_matrix().into_inner(),
            aside: tangent_basis(&ground.normal),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::random_stream;
    use rand_distr::{Distribution, StandardNormal};

    fn ground() -> ReliefPlane {
        ReliefPlane {
            rotation: exp(&Vector3::new(0.02, -0.015, 0.3)),
            translation: Vector3::new(0.02, 0.03, -0.1),
            normal: Unit::new_normalize(Vector3::new(0.2, -0.1, 0.97)),
            relief_variance: 1e-4,
            noise_variance: 1.3,
        }
    }

    fn matched() -> NormalizedMatch {
        let from_covariance = Matrix2::new(4.0, 1.0, 1.0, 2.0) * 1e-7;
        let to_covariance = Matrix2::new(3.0, -1.0, -1.0, 5.0) * 1e-7;
        let mut matched =
            NormalizedMatch { from: Vector2::new(0.3, -0.2), to: Vector2::zeros(), from_covariance, to_covariance };
        let seen = ground().predict(&ground().homography(), &matched).expect("ahead");
        matched.to = -seen.residual + Vector2::new(8e-4, -5e-4);
        matched
    }

    fn cost(ground: &ReliefPlane, matched: &NormalizedMatch) -> f64 {
        let (square, ln_determinant) = ground.misfit(&ground.homography(), matched).expect("ahead");
        square + ln_determinant
    }

    #[test]
    fn the_score_is_the_derivative_of_the_likelihood() {
        // The nominal noise is taken as known where the image moves: its share in the score is left out, so its step is.
        let matched = NormalizedMatch { from_covariance: Matrix2::zeros(), ..matched() };
        let evidence = ground().evidence(&Axes::of(&ground()), &matched).expect("ahead");
        for j in 0..PARAMETERS {
            let step = [1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-6, 1e-6, 1e-8, 1e-5][j];
            let d = Parameters::ith(j, step);
            let numeric = -(cost(&ground().moved(&d), &matched) - cost(&ground().moved(&-d), &matched)) / (4.0 * step);
            let off = (numeric - evidence.score()[j]).abs();
            assert!(off < 1e-5 * evidence.score()[j].abs() + 1e-3, "{j}: {numeric} against {}", evidence.score()[j]);
        }
    }

    /// Mean ratio of the scores' spread to the information, over matches drawn with a relief of their own.
    fn spread_over_information(relief_variance: f64) -> f64 {
        let (axes, model, mut random) = (Axes::of(&ground()), ground(), random_stream(1, "scores", 0));
        let drawn = ReliefPlane { relief_variance, ..model };
        let seen = drawn.predict(&axes.homography, &matched()).expect("ahead");
        let factor = drawn.covariance(&seen).cholesky().expect("positive").l();
        let (mut spread, mut information) = (Parameters::zeros(), Parameters::zeros());
        for _ in 0..20_000 {
            let noise = factor * Vector2::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) });
            let here = NormalizedMatch { to: matched().to - seen.residual + noise, ..matched() };
            let evidence = model.evidence(&axes, &here).expect("ahead");
            spread += evidence.score().component_mul(&evidence.score());
            information += evidence.information().diagonal();
        }
        spread.component_div(&information).mean()
    }

    #[test]
    fn the_information_is_the_spread_of_the_scores() {
        let right = spread_over_information(1e-4);
        assert!((right - 1.0).abs() < 0.05, "{right}");
        let wrong = spread_over_information(3e-4);
        assert!((wrong - 1.0).abs() > 0.5, "{wrong}");
    }
}
