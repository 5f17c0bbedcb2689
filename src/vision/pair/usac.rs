//! First robust estimates through OpenCV's USAC framework (MAGSAC scores, a fixed seed, one thread).

use super::config::RotationConfig;
use super::models::{General, Plane};
use super::normalized_match::NormalizedMatch;
use crate::vision::error::VisionError;
use crate::vision::opencv_bridge::{mat_from, matrix_from, points, vector_from};
use nalgebra::{Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};
use opencv::calib3d::{
    LocalOptimMethod, NeighborSearchMethod, SamplingMethod, ScoreMethod, UsacParams, decompose_homography_mat,
    find_essential_mat_4, find_homography_1,
};
use opencv::core::{Mat, Vector, no_array};

fn parameters(config: &RotationConfig, threshold: f64) -> UsacParams {
    UsacParams {
        confidence: 0.999,
        is_parallel: false,
        lo_iterations: 5,
        lo_method: LocalOptimMethod::LOCAL_OPTIM_INNER_LO,
        lo_sample_size: 14,
        max_iterations: 2000,
        neighbors_search: NeighborSearchMethod::NEIGH_GRID,
        random_generator_state: (config.seed % 0x7fff_ffff) as i32,
        sampler: SamplingMethod::SAMPLING_UNIFORM,
        score: ScoreMethod::SCORE_METHOD_MAGSAC,
        threshold,
    }
}

/// Essential matrix of the matches in ideal coordinates; `None` where none was found. `focal_px` scales the threshold.
pub(super) fn essential(
    normalized: &[NormalizedMatch],
    focal_px: f64,
    config: &RotationConfig,
) -> Result<Option<Matrix3<f64>>, VisionError> {
    let camera = mat_from(&Matrix3::new(focal_px, 0.0, 0.0, 0.0, focal_px, 0.0, 0.0, 0.0, 1.0))
        .map_err(VisionError::opencv("make a camera matrix"))?;
    let (from, to) =
        (points(normalized.iter().map(|s| s.from * focal_px)), points(normalized.iter().map(|s| s.to * focal_px)));
    let mut mask = Mat::default();
    let parameters = parameters(config, config.threshold_px);
    // OpenCV throws where no sample gives a model: that is an outcome, not an error.
    let found = find_essential_mat_4(&from, &to, &camera, &camera, &no_array(), &no_array(), &mut mask, parameters);
    Ok(found.ok().and_then(|e| matrix_from(&e)))
}

/// Homography of the matches in ideal coordinates, scaled so that its middle singular value is 1 and points stay in
/// front; `None` where none was found.
pub(super) fn homography(
    normalized: &[NormalizedMatch],
    focal_px: f64,
    config: &RotationConfig,
) -> Option<Matrix3<f64>> {
    let (from, to) =
        (points(normalized.iter().map(|s| s.from * focal_px)), points(normalized.iter().map(|s| s.to * focal_px)));
    let mut mask = Mat::default();
    let found = find_homography_1(&from, &to, &mut mask, parameters(config, config.threshold_px)).ok()?;
    let scale = Matrix3::from_diagonal(&Vector3::new(focal_px, focal_px, 1.0));
    let h = scale.try_inverse()? * matrix_from(&found)? * scale;
    let mut singular: Vec<f64> = h.singular_values().iter().copied().collect();
    singular.sort_by(f64::total_cmp);
    let h = h / singular[1];
    let ahead = normalized.iter().filter(|s| s.second_ray().dot(&(h * s.first_ray())) > 0.0).count();
    Some(if 2 * ahead < normalized.len() { -h } else { h })
}

/// The planes and motions that a homography stands for (at most four, two of them in front of the camera).
pub(super) fn planes(h: &Matrix3<f64>) -> Vec<Plane> {
    let (mut rotations, mut translations, mut normals) =
        (Vector::<Mat>::new(), Vector::<Mat>::new(), Vector::<Mat>::new());
    let decomposed = mat_from(h).and_then(|h| {
        let identity = mat_from(&Matrix3::identity())?;
        decompose_homography_mat(&h, &identity, &mut rotations, &mut translations, &mut normals)
    });
    if decomposed.is_err() {
        return Vec::new();
    }
    let all = rotations.iter().zip(translations.iter()).zip(normals.iter());
    all.filter_map(|((r, t), n)| {
        let normal = Unit::try_new(vector_from(&n)?, 1e-12)?;
        let rotation = nearest_rotation(&matrix_from(&r)?)?;
        Some(Plane { rotation, translation: vector_from(&t)?, normal })
    })
    .collect()
}

/// The two rotations and two directions of an essential matrix, in all four pairs (Hartley and Zisserman, 9.6.2).
pub(super) fn motions(essential: &Matrix3<f64>) -> Vec<General> {
    let svd = essential.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return Vec::new() };
    let w = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let mut motions = Vec::with_capacity(4);
    for turn in [w, w.transpose()] {
        let r = u * turn * v_t;
        let Some(rotation) = nearest_rotation(&(r * r.determinant().signum())) else { continue };
        let smallest = svd.singular_values.imin();
        let direction = Unit::new_normalize(u.column(smallest).into_owned());
        motions.push(General { rotation, direction });
        motions.push(General { rotation, direction: -direction });
    }
    motions
}

fn nearest_rotation(matrix: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let svd = matrix.svd(true, true);
    let r = svd.u? * svd.v_t?;
    (r.determinant() > 0.0).then(|| UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(r)))
}
