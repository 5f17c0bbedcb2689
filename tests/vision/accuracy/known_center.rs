//! What a rendered body's pictures tell of its rotation if the centre of rotation is known: by the pixels as they were
//! tracked, by the true pixels of the same points, and by those with as much white noise as the tracked ones err. The first
//! against the last shows how much of the error is alike in neighbouring points.

use crate::vision::pair::bearings::{angle_deg, median, median_angle_deg};
use nalgebra::{Isometry3, Point3, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::{CameraSource, ImageSequence, StampedPose, read_depth_tiff, read_tum};
use opnav::geometry::Camera;
use opnav::observations::*;
use opnav::stats::random_stream;
use opnav::vision::*;
use rand_distr::{Distribution, StandardNormal};
use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;
use std::path::Path;

const SPANS: [usize; 4] = [1, 2, 3, 4];

/// Medians over the pairs, degrees.
pub struct KnownCenter {
    /// Error by the tracked pixels.
    pub error_deg: f64,
    /// What the covariances predict for that.
    pub predicted_deg: f64,
    /// Error by the true pixels.
    pub error_of_true_pixels_deg: f64,
    /// Error by the true pixels with white noise of the size of the tracked ones' errors.
    pub error_of_white_noise_deg: f64,
}

/// A pair of pictures by the tracks that it shares.
struct Pair {
    shared: MatchedPair,
    sigma_px: Vec<f64>,
    /// Where the points of the first picture truly are in the second one.
    true_to_px: Vec<Vector2<f64>>,
    dt_s: f64,
    true_rotation: UnitQuaternion<f64>,
}

/// Points of a picture by their track: pixel and 1σ of its drift, px.
type Points = BTreeMap<u64, (Vector2<f64>, f64)>;

/// A picture's points, with its true pose and depths.
struct PageImage {
    t_ns: i64,
    points: Points,
    reference_from_camera: Isometry3<f64>,
    depth_m: image::ImageBuffer<image::Luma<f32>, Vec<f32>>,
}

impl PageImage {
    /// Where the surface point at a pixel truly is in another picture; `None` where no surface is.
    fn true_pixel(&self, pixel_px: &Vector2<f64>, other: &PageImage, camera: &Camera) -> Option<Vector2<f64>> {
        let (u, v) = (pixel_px.x as u32, pixel_px.y as u32);
        let depth_m = |i, j| self.depth_m.get_pixel_checked(u + i, v + j).map_or(f64::NAN, |d| f64::from(d.0[0]));
        let (s, t) = (pixel_px.x.fract(), pixel_px.y.fract());
        let upper = depth_m(0, 0) * (1.0 - s) + depth_m(1, 0) * s;
        let lower = depth_m(0, 1) * (1.0 - s) + depth_m(1, 1) * s;
        let depth_m = Some(upper * (1.0 - t) + lower * t).filter(|d| d.is_finite())?;
        let point = Point3::from(camera.normalize(pixel_px)?.push(1.0) * depth_m);
        let other_from_this = other.reference_from_camera.inverse() * self.reference_from_camera;
        camera.project(&(other_from_this * point).coords)
    }
}

/// Solves the adjacent pairs and the keyframe pairs of a tracked sequence once more, the centre held where it is.
pub fn with_known_center(images: &Path, tracks: &Path) -> KnownCenter {
    let sequence = ImageSequence::open(images, &CameraSource::Folder).expect("pictures");
    let camera = &sequence.sensor.camera;
    let mut points: BTreeMap<i64, Points> = BTreeMap::new();
    for o in read_tracks(&tracks.join("tracks.csv")).expect("tracks") {
        points.entry(o.t_ns).or_default().insert(o.track_id, (o.pixel_px, o.sigma_px));
    }
    let poses = read_tum(&images.join("truth/cam0.tum")).expect("true poses");
    let picture = |pose: &StampedPose| {
        let depth_m = read_depth_tiff(&images.join(format!("truth/depth/cam0/{}.tiff", pose.t_ns))).expect("depths");
        let points = points.get(&pose.t_ns)?.clone();
        Some(PageImage { t_ns: pose.t_ns, points, reference_from_camera: pose.reference_from_moving, depth_m })
    };
    let all: Vec<PageImage> = poses.iter().filter_map(picture).collect();
    let spanned =
        |span: &usize| all.windows(span + 1).map(|w| pair(&w[0], w.last().expect("the second"), camera)).collect();
    let pairs: Vec<Pair> = SPANS.iter().flat_map(|span| -> Vec<Pair> { spanned(span) }).collect();
    let reference_from_camera = all.first().expect("a picture").reference_from_camera;
    let center = Unit::new_normalize(reference_from_camera.inverse().translation.vector);
    let errors = |pairs: &[Pair]| {
        let solved = solve(&sequence, pairs, center);
        let ok = pairs.iter().zip(&solved.pairs).filter(|(_, s)| s.status == PairStatus::Ok);
        let both = |(p, s): (&Pair, &PairSolution)| {
            (angle_deg(&p.true_rotation, &s.camera_to_from_camera_from), median_angle_deg(&s.covariance_rad2))
        };
        let (errors, predicted): (Vec<f64>, Vec<f64>) = ok.map(both).unzip();
        (median(errors), median(predicted))
    };
    let (error_deg, predicted_deg) = errors(&pairs);
    let noisy = |share: f64| -> Vec<Pair> { pairs.iter().enumerate().map(|(k, p)| p.with_noise(share, k)).collect() };
    KnownCenter {
        error_deg,
        predicted_deg,
        // A thousandth of the noise: none at all leaves no scale to weigh by.
        error_of_true_pixels_deg: errors(&noisy(1e-3)).0,
        error_of_white_noise_deg: errors(&noisy(1.0)).0,
    }
}

impl Pair {
    /// The same points at their true pixels, with white noise of a share of the tracked pixels' errors.
    fn with_noise(&self, share: f64, index: usize) -> Self {
        let off = |i: usize| (self.shared.to_px[i] - self.true_to_px[i]).norm() / (SQRT_2 * self.sigma_px[i]);
        // Half of the points of a plane normal distribution lie within 1.1774 σ.
        let scale = share * median((0..self.sigma_px.len()).map(off).collect()) / 1.1774;
        let mut random = random_stream(1, "known-center", index as u64);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let noisy =
            |(px, sigma_px): (&Vector2<f64>, &f64)| px + Vector2::new(normal(), normal()) * (SQRT_2 * sigma_px * scale);
        let to_px = self.true_to_px.iter().zip(&self.sigma_px).map(noisy).collect();
        Pair {
            shared: MatchedPair { from_px: self.shared.from_px.clone(), to_px },
            sigma_px: self.sigma_px.clone(),
            true_to_px: self.true_to_px.clone(),
            ..*self
        }
    }
}

fn pair(first: &PageImage, second: &PageImage, camera: &Camera) -> Pair {
    /// Further off than this, a point is not the same one, px.
    const FARTHEST_PX: f64 = 1.5;
    const LEAST_SIGMA_PX: f64 = 0.05;
    let mut found = Pair {
        shared: MatchedPair::default(),
        sigma_px: Vec::new(),
        true_to_px: Vec::new(),
        dt_s: (second.t_ns - first.t_ns) as f64 * 1e-9,
        true_rotation: second.reference_from_camera.rotation.inverse() * first.reference_from_camera.rotation,
    };
    for (track, (from_px, before_px)) in &first.points {
        let Some((to_px, after_px)) = second.points.get(track) else { continue };
        let Some(true_px) = first.true_pixel(from_px, second, camera) else { continue };
        if (true_px - to_px).norm() > FARTHEST_PX {
            continue;
        }
        found.true_to_px.push(true_px);
        found.shared.from_px.push(*from_px);
        found.shared.to_px.push(*to_px);
        let sigma_px = (after_px.powi(2) - before_px.powi(2)).max(LEAST_SIGMA_PX.powi(2)).sqrt();
        found.sigma_px.push(sigma_px / SQRT_2);
    }
    found
}

fn solve(sequence: &ImageSequence, pairs: &[Pair], center_guess: Unit<Vector3<f64>>) -> CenterSolution {
    let (config, rotation) =
        (FixedCenterConfig { center_sigma_rad: 1e-7, ..FixedCenterConfig::default() }, RotationConfig::default());
    let problem = CenterProblem { camera: &sequence.sensor.camera, center_guess, config: &config, rotation: &rotation };
    let centered = pairs.iter().map(|p| CenteredPair {
        matches: PixelMatches { pair: &p.shared, sigma_px: &p.sigma_px },
        dt_s: p.dt_s,
        predicted: Some(p.true_rotation),
    });
    rotations_about_center(&centered.collect::<Vec<_>>(), &problem)
}
