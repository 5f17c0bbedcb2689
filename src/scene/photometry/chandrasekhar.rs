//! The H-function of isotropic multiple scattering.

/// Chandrasekhar's H(x) for the single-scattering albedo w, both 0 to 1: the solution of
/// H(x) = 1 / (1 - w/2 x ∫₀¹ H(x')/(x+x') dx').
///
/// Hapke's second approximation (Hapke 2002, "Bidirectional reflectance spectroscopy: 5") is up to 1 % off; the
/// polynomial in γ = √(1-w) and x, fitted to the integral equation, leaves less than 0.07 %.
pub fn chandrasekhar_h(w: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let gamma = (1.0 - w).max(0.0).sqrt();
    let r0 = (1.0 - gamma) / (1.0 + gamma);
    let hapke = 1.0 / (1.0 - w * x * (r0 + (0.5 - r0 * x) * ((1.0 + x) / x).ln()));
    let in_x = |row: &[f64; 3]| row[0] + x * (row[1] + x * row[2]);
    let [c0, c1, c2] = H_CORRECTION.each_ref().map(in_x);
    hapke * (1.0 + (1.0 - gamma).powi(2) * x * (c0 + gamma * (c1 + gamma * c2)))
}

/// Coefficients by powers of γ (rows) and x (columns); the same as in `shaders/photometry.wgsl`.
const H_CORRECTION: [[f64; 3]; 3] = [[0.0271, -0.0336, 0.0149], [0.2652, -0.4981, 0.2804], [-0.214, 0.3815, -0.2267]];
