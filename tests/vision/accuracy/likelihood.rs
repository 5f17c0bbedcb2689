//! The floor of a pair's rotation: the maximum of the likelihood, started from the truth with right matches only.

use crate::vision::pair::bearings::Scene;
use nalgebra::{Matrix5, UnitQuaternion, Vector3, Vector5};
use opnav::geometry::so3;
use opnav::vision::MatchedPair;

/// A rotation and a direction of translation, the structure eliminated by the Sampson error.
#[derive(Clone, Copy)]
struct Motion {
    rotation: UnitQuaternion<f64>,
    translation: Vector3<f64>,
}

impl Motion {
    fn moved(&self, step: &Vector5<f64>) -> Motion {
        let aside = so3::tangent_basis(&nalgebra::Unit::new_normalize(self.translation));
        Motion {
            rotation: so3::exp(&step.fixed_rows::<3>(0).into_owned()) * self.rotation,
            translation: (self.translation + aside * step.fixed_rows::<2>(3)).normalize(),
        }
    }

    /// Sampson errors of all matches (Hartley and Zisserman, 11.4.3), in ideal coordinates.
    fn residuals(&self, rays: &[(Vector3<f64>, Vector3<f64>)]) -> Vec<f64> {
        let essential = so3::hat(&self.translation) * self.rotation.to_rotation_matrix().into_inner();
        let sampson = |(a, b): &(Vector3<f64>, Vector3<f64>)| {
            let (left, right) = (essential.tr_mul(b), essential * a);
            b.dot(&right) / (left.xy().norm_squared() + right.xy().norm_squared()).sqrt()
        };
        rays.iter().map(sampson).collect()
    }
}

/// The rotation at the maximum of the likelihood of the matches after `skip`, by Gauss-Newton with halved steps.
pub fn most_likely_rotation(scene: &Scene, pair: &MatchedPair, skip: usize) -> UnitQuaternion<f64> {
    let ray = |pixel| scene.camera.normalize(pixel).expect("a pinhole camera").push(1.0);
    let rays: Vec<_> = (skip..pair.from_px.len()).map(|i| (ray(&pair.from_px[i]), ray(&pair.to_px[i]))).collect();
    let cost = |m: &Motion| m.residuals(&rays).iter().map(|r| r * r).sum::<f64>();
    let mut best = Motion { rotation: scene.rotation, translation: scene.translation.normalize() };
    for _ in 0..20 {
        let step = gauss_newton_step(&best, &rays);
        let halved = (0..8).map(|k| best.moved(&(step * 0.5f64.powi(k)))).find(|m| cost(m) < cost(&best));
        let Some(next) = halved else { break };
        best = next;
    }
    best.rotation
}

fn gauss_newton_step(motion: &Motion, rays: &[(Vector3<f64>, Vector3<f64>)]) -> Vector5<f64> {
    const STEP: f64 = 1e-6;
    let residuals = motion.residuals(rays);
    let column = |j: usize| {
        let d = Vector5::ith(j, STEP);
        let (ahead, behind) = (motion.moved(&d).residuals(rays), motion.moved(&-d).residuals(rays));
        ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * STEP)).collect::<Vec<f64>>()
    };
    let columns: [Vec<f64>; 5] = std::array::from_fn(column);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let information = Matrix5::from_fn(|i, j| dot(&columns[i], &columns[j]));
    let gradient = Vector5::from_fn(|i, _| dot(&columns[i], &residuals));
    -information.cholesky().map_or(Vector5::zeros(), |c| c.solve(&gradient))
}
