//! Rays against meshes in f64, to hold the renderer against: shares no code with it.

use nalgebra::Vector3;
use opnav::scene::Mesh;

/// Faces that a box need not be cut further for.
const LEAF_FACES: usize = 4;

/// A mesh with a tree of boxes around its faces.
pub struct RayCaster<'a> {
    mesh: &'a Mesh,
    order: Vec<usize>,
    boxes: Vec<FaceBox>,
}

struct FaceBox {
    low: Vector3<f64>,
    high: Vector3<f64>,
    content: Content,
}

enum Content {
    /// Places in `order`.
    Faces(std::ops::Range<usize>),
    /// Two boxes.
    Boxes([usize; 2]),
}

/// Where a ray meets a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the direction.
    pub t: f64,
    /// Number of the face.
    pub face: usize,
    /// Weights of the face's second and third corner.
    pub weights: [f64; 2],
}

impl<'a> RayCaster<'a> {
    pub fn new(mesh: &'a Mesh) -> Self {
        let mut caster = RayCaster { mesh, order: (0..mesh.faces.len()).collect(), boxes: Vec::new() };
        caster.build(0..mesh.faces.len());
        caster
    }

    /// Encloses a range of `order`, cut at the median of the longest side; returns the box's number.
    fn build(&mut self, range: std::ops::Range<usize>) -> usize {
        let mesh = self.mesh;
        let corners = |face: &usize| mesh.faces[*face].map(|i| mesh.vertices_m[i as usize]);
        let all = self.order[range.clone()].iter().flat_map(corners);
        let none = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        let (low, high) = all.fold(none, |(low, high), v| (low.inf(&v), high.sup(&v)));
        let at = self.boxes.len();
        self.boxes.push(FaceBox { low, high, content: Content::Faces(range.clone()) });
        if range.len() > LEAF_FACES {
            let axis = (high - low).imax();
            let middle = |face: &usize| corners(face).iter().map(|v| v[axis]).sum::<f64>();
            let half = range.len() / 2;
            self.order[range.clone()].select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
            let cut = range.start + half;
            let children = [self.build(range.start..cut), self.build(cut..range.end)];
            self.boxes[at].content = Content::Boxes(children);
        }
        at
    }

    /// The nearest hit at more than `least` lengths of the direction.
    pub fn nearest(&self, origin: &Vector3<f64>, direction: &Vector3<f64>, least: f64) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            let most = best.map_or(f64::INFINITY, |hit| hit.t);
            if !self.boxes[at].is_met(origin, direction, least, most) {
                continue;
            }
            match &self.boxes[at].content {
                Content::Boxes(children) => open.extend(children),
                Content::Faces(range) => {
                    let hits = self.order[range.clone()].iter().filter_map(|f| self.face_hit(*f, origin, direction));
                    let nearer = hits.filter(|hit| hit.t > least).min_by(|a, b| a.t.total_cmp(&b.t));
                    best = [best, nearer].into_iter().flatten().min_by(|a, b| a.t.total_cmp(&b.t));
                }
            }
        }
        best
    }

    /// Source: Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", Journal of Graphics Tools 2(1), 1997.
    fn face_hit(&self, face: usize, origin: &Vector3<f64>, direction: &Vector3<f64>) -> Option<Hit> {
        let [a, b, c] = self.mesh.faces[face].map(|i| self.mesh.vertices_m[i as usize]);
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(&ac);
        let determinant = ab.dot(&p);
        let from_a = origin - a;
        let q = from_a.cross(&ab);
        let (u, v) = (from_a.dot(&p) / determinant, direction.dot(&q) / determinant);
        let hit = Hit { t: ac.dot(&q) / determinant, face, weights: [u, v] };
        // A ray in the plane of the face divides by zero and fails here.
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some(hit)
    }
}

impl FaceBox {
    fn is_met(&self, origin: &Vector3<f64>, direction: &Vector3<f64>, least: f64, most: f64) -> bool {
        let (mut near, mut far) = (least, most);
        for axis in 0..3 {
            let inverse = 1.0 / direction[axis];
            let (a, b) = ((self.low[axis] - origin[axis]) * inverse, (self.high[axis] - origin[axis]) * inverse);
            // min and max pass over a 0 · ∞ = NaN.
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
        near <= far * (1.0 + 1e-12)
    }
}
