//! How materials scatter sunlight: one page of formulas.
//!
//! Every model gives I/F, the radiance I of a place over that of a perfect Lambert surface with the Sun in its zenith (F is
//! the Sun's irradiance over π). i is the incidence and e the emission, from the normal; µ₀ = cos i, µ = cos e; α is the
//! phase, the true angle between the directions to Sun and camera; ψ is the azimuth between them around the normal, so
//! that cos α = µ₀ µ + sin i sin e cos ψ. A is the albedo of the material. Where µ₀ ≤ 0 nothing is reflected. Cosines are
//! kept above 1e-4, so that every quotient is finite. All models are reciprocal: I/F over µ₀ stays the same when Sun and
//! camera are exchanged.
//!
//! | `photometry` | I/F | source |
//! |---|---|---|
//! | `"lambert"` | A µ₀ | Lambert 1760 |
//! | `"lommel-seeliger"` | 2 A µ₀/(µ₀+µ) | Seeliger 1887; Hapke 1993, chapter 8 |
//! | `{ lunar-lambert = { weight = L } }` | A (2 L µ₀/(µ₀+µ) + (1-L) µ₀) | McEwen 1991, *Icarus* 92, 298; 1996, *LPSC* 27, 841 |
//! | `{ oren-nayar = { slope_sigma_deg = σ } }` | A µ₀ (C1 + C2 max(0, cos ψ) sin a tan b) | Oren and Nayar 1994, SIGGRAPH, eq. 30 |
//! | `{ hapke = { … } }` | w/4 µ₀ₑ/(µ₀ₑ+µₑ) ((1+B) p + H(µ₀ₑ) H(µₑ) - 1) S | Hapke 1993, chapters 8 and 12 |
//!
//! # Albedo
//!
//! A is I/F with Sun and camera both in the zenith: the normal albedo. In the models of Lommel-Seeliger and McEwen a bright
//! surface would send back more light than it receives at grazing incidence, up to A (1+3L) of it; a scenario that does so
//! at its mean albedo is refused ([`Photometry::validate`]). In Hapke's model the material's albedo *is* the
//! single-scattering albedo w of the grains, and everything that varies the albedo (contrast, a texture) varies w, kept
//! between 0 and 1. The normal albedo is then about w/8 (1+B₀) p(0) for dark grains.
//!
//! # Lunar-Lambert
//!
//! The factor 2 makes both parts equal to A at µ₀ = µ = 1. L is a constant, or L(α) = 1 + a α + b α² + c α³ with α in
//! degrees, kept between 0 and 1: `weight = [-0.019, 2.42e-4, -1.46e-6]` is the Moon's (McEwen 1996). L = 0 is Lambert's
//! law, L = 1 that of Lommel and Seeliger. L takes the phase, never the incidence.
//!
//! # Oren-Nayar
//!
//! The qualitative model for facets without interreflection: a is the larger and b the smaller of i and e,
//! C1 = 1 - σ²/(2 (σ²+0.33)), C2 = 0.45 σ²/(σ²+0.09) with σ in rad. The full model's C3 and interreflection terms, a few per
//! cent, are left out. σ = 0 is Lambert's law.
//!
//! # Hapke
//!
//! Five parameters: w (the material's albedo), ξ, B₀, h and θ̄.
//! - p(α) = (1-ξ²) / (1 + 2 ξ cos α + ξ²)^(3/2) (Henyey and Greenstein 1941), ξ < 0 scatters back to the Sun.
//! - B(α) = B₀ / (1 + tan(α/2)/h), the opposition surge (Hapke 1986, *Icarus* 67, 264).
//! - H solves Chandrasekhar's integral equation for isotropic scattering within 0.07 %, see [`chandrasekhar_h`].
//! - θ̄ is the mean slope of roughness below the resolution. With χ = 1/√(1 + π tan² θ̄),
//!   E₁(x) = exp(-2/π cot θ̄ cot x), E₂(x) = exp(-1/π cot² θ̄ cot² x), η(x) = χ (cos x + sin x tan θ̄ E₂(x)/(2 - E₁(x))),
//!   f = exp(-2 tan(ψ/2)), n the smaller and m the larger of i and e, D = 2 - E₁(m) - ψ/π E₁(n):
//!   cos nₑ = χ (cos n + sin n tan θ̄ (cos ψ E₂(m) + sin²(ψ/2) E₂(n))/D),
//!   cos mₑ = χ (cos m + sin m tan θ̄ (E₂(m) - sin²(ψ/2) E₂(n))/D),
//!   S = µₑ/η(e) µ₀/η(i) χ / (1 - f + f χ cos n/η(n)) (Hapke 1984, *Icarus* 59, 41; 1993, chapter 12). θ̄ = 0 is a smooth surface.
//!
//! For ξ = 0, B₀ = 0, θ̄ = 0 and small w, Hapke's law tends to w/4 µ₀/(µ₀+µ), that of Lommel and Seeliger with A = w/8.
//!
//! `shaders/photometry.wgsl` computes the same on the adapter.

mod chandrasekhar;
mod directions;
mod energy;
mod hapke;
mod lunar_lambert;
mod model;
mod oren_nayar;

pub use chandrasekhar::chandrasekhar_h;
pub use directions::PhotometricAngles;
pub use hapke::HapkeParameters;
pub use lunar_lambert::LunarWeight;
pub use model::Photometry;
pub use oren_nayar::oren_nayar_coefficients;
