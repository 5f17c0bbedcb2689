//! Photometric models: reference values, reciprocity, limits, energy.

use opnav::scene::{HapkeParameters, LunarWeight, PhotometricAngles, Photometry, chandrasekhar_h};
use std::f64::consts::PI;

fn at(incidence_deg: f64, emission_deg: f64, azimuth_deg: f64) -> PhotometricAngles {
    PhotometricAngles::from_angles(incidence_deg.to_radians(), emission_deg.to_radians(), azimuth_deg.to_radians())
}

fn lunar(weight: f64) -> Photometry {
    Photometry::LunarLambert { weight: LunarWeight::Constant(weight) }
}

fn hapke([asymmetry, opposition_amplitude, opposition_width, roughness_deg]: [f64; 4]) -> Photometry {
    Photometry::Hapke(HapkeParameters { asymmetry, opposition_amplitude, opposition_width, roughness_deg })
}

fn every_model() -> Vec<Photometry> {
    vec![
        Photometry::Lambert,
        Photometry::LommelSeeliger,
        lunar(0.6),
        Photometry::LunarLambert { weight: LunarWeight::MOON },
        Photometry::OrenNayar { slope_sigma_deg: 25.0 },
        hapke([-0.3, 1.0, 0.05, 0.0]),
        hapke([-0.3, 1.0, 0.05, 25.0]),
        hapke([0.3, 0.0, 0.05, 40.0]),
    ]
}

/// Angles over the whole domain, grazing ones too.
fn grid() -> impl Iterator<Item = PhotometricAngles> {
    const TILTS_DEG: [f64; 9] = [0.0, 0.5, 10.0, 30.0, 50.0, 70.0, 85.0, 89.0, 89.9];
    const AZIMUTHS_DEG: [f64; 7] = [0.0, 1.0, 40.0, 90.0, 130.0, 179.0, 180.0];
    TILTS_DEG.into_iter().flat_map(|i| {
        TILTS_DEG.into_iter().flat_map(move |e| AZIMUTHS_DEG.into_iter().map(move |azimuth| at(i, e, azimuth)))
    })
}

fn assert_near(found: f64, expected: f64, relative: f64, what: &str) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{what}: {found} for {expected}");
}

#[test]
fn angles_follow_from_directions() {
    for angles in grid() {
        let (i, e) = (angles.cos_incidence.acos(), angles.cos_emission.acos());
        let cosine = angles.cos_incidence * angles.cos_emission + i.sin() * e.sin() * angles.azimuth_rad.cos();
        assert!((angles.phase_rad.cos() - cosine).abs() < 1e-12, "{angles:?}");
    }
    assert!((at(30.0, 50.0, 0.0).phase_rad.to_degrees() - 20.0).abs() < 1e-9);
    assert!((at(30.0, 50.0, 180.0).phase_rad.to_degrees() - 80.0).abs() < 1e-9);
}

#[test]
fn closed_forms_at_special_angles() {
    // Everything in the zenith: I/F is the albedo.
    let zenith = at(0.0, 0.0, 0.0);
    for model in [Photometry::Lambert, Photometry::LommelSeeliger, lunar(0.37)] {
        assert_near(model.reflectance(0.2, &zenith), 0.2, 1e-12, "zenith");
    }
    // i = 60°, e = 0: Lambert A/2, Lommel-Seeliger 2 A 0.5/1.5.
    let slant = at(60.0, 0.0, 0.0);
    assert_near(Photometry::Lambert.reflectance(0.2, &slant), 0.1, 1e-9, "Lambert");
    assert_near(Photometry::LommelSeeliger.reflectance(0.2, &slant), 0.2 / 1.5, 1e-9, "Lommel-Seeliger");
    assert_near(lunar(0.25).reflectance(0.2, &slant), 0.25 * 0.2 / 1.5 + 0.75 * 0.1, 1e-9, "lunar-Lambert");
    // The Moon at a phase of 60°: L = 1 - 1.14 + 0.8712 - 0.31536.
    assert_near(LunarWeight::MOON.at(60.0_f64.to_radians()), 0.41584, 1e-9, "McEwen's L");
    let weight = 0.41584;
    let moon = Photometry::LunarLambert { weight: LunarWeight::MOON };
    assert_near(moon.reflectance(0.1, &slant), 0.1 * (2.0 * weight / 3.0 + 0.5 * (1.0 - weight)), 1e-9, "the Moon");
    assert_eq!((LunarWeight::MOON.at(0.0), LunarWeight::MOON.at(PI)), (1.0, 0.0));
    // L follows the phase: the same incidence seen from elsewhere has another L.
    let aside = at(60.0, 45.0, 90.0);
    let weight = LunarWeight::MOON.at(aside.phase_rad);
    assert_near(moon.reflectance(0.1, &aside), lunar(weight).reflectance(0.1, &aside), 1e-12, "phase");
    let by_incidence = lunar(LunarWeight::MOON.at(60.0_f64.to_radians())).reflectance(0.1, &aside);
    assert!((moon.reflectance(0.1, &aside) / by_incidence - 1.0).abs() > 0.01, "incidence is told from phase");
    // Oren-Nayar, σ = 30°, i = e = 60° on the Sun's side: C1 + C2 sin² 60°/cos 60°.
    let sigma2 = 30.0_f64.to_radians().powi(2);
    let (c1, c2) = (1.0 - 0.5 * sigma2 / (sigma2 + 0.33), 0.45 * sigma2 / (sigma2 + 0.09));
    let rough = Photometry::OrenNayar { slope_sigma_deg: 30.0 };
    assert_near(rough.reflectance(1.0, &at(60.0, 60.0, 0.0)), 0.5 * (c1 + c2 * 1.5), 1e-9, "Oren-Nayar");
    assert_near(rough.reflectance(1.0, &at(60.0, 60.0, 135.0)), 0.5 * c1, 1e-9, "Oren-Nayar, far side");
    // Hapke, smooth, in the zenith: w/8 ((1+B₀) p(0) + H(1)² - 1), with p(0) = (1+ξ)(1-ξ)/(1+ξ)³.
    let (w, asymmetry, amplitude) = (0.4, -0.25_f64, 0.8);
    let p0 = (1.0 - asymmetry) / (1.0 + asymmetry).powi(2);
    let expected = w / 8.0 * ((1.0 + amplitude) * p0 + chandrasekhar_h(w, 1.0).powi(2) - 1.0);
    assert_near(hapke([asymmetry, amplitude, 0.1, 0.0]).reflectance(w, &zenith), expected, 1e-9, "Hapke");
}

/// Values of Hapke's law worked out from his equations case by case in extended precision, with the H-function from the
/// integral equation: w, ξ, B₀, h, θ̄, i, e, ψ (°), I/F.
const HAPKE_VALUES: [([f64; 5], [f64; 3], f64); 7] = [
    ([0.37, -0.27, 1.6, 0.08, 20.0], [30.0, 50.0, 70.0], 0.11887945),
    ([0.037, -0.47, 1.03, 0.025, 20.0], [60.0, 20.0, 140.0], 0.0025054404),
    ([0.9, -0.1, 0.5, 0.05, 0.0], [40.0, 40.0, 90.0], 0.3614733),
    ([0.21, -0.35, 0.7, 0.05, 35.0], [10.0, 80.0, 10.0], 0.038404787),
    ([0.5, 0.2, 0.0, 0.1, 28.0], [75.0, 75.0, 180.0], 0.019931447),
    ([0.23, -0.27, 1.32, 0.08, 20.0], [0.0, 0.0, 0.0], 0.16419861),
    ([0.23, -0.27, 1.32, 0.08, 20.0], [45.0, 45.0, 0.0], 0.16358318),
];

#[test]
fn hapke_has_its_reference_values() {
    for ([w, asymmetry, amplitude, width, roughness_deg], [i, e, azimuth], expected) in HAPKE_VALUES {
        let found = hapke([asymmetry, amplitude, width, roughness_deg]).reflectance(w, &at(i, e, azimuth));
        // H is good to 7e-4, and a product of two of them to twice that.
        assert_near(found, expected, 1.3e-3, &format!("w {w}, i {i}°, e {e}°, ψ {azimuth}°"));
        // The other sign of ξ is another surface.
        let wrong = hapke([-asymmetry, amplitude, width, roughness_deg]).reflectance(w, &at(i, e, azimuth));
        assert!((wrong / expected - 1.0).abs() > 0.005, "ξ {asymmetry}: {wrong} for {expected}");
    }
}

/// H at the nodes of a quadrature on 0..1, from H(x) (√(1-w) + w/2 ∫ x' H(x')/(x+x') dx') = 1, the integral equation in
/// its stable form (Chandrasekhar 1960, chapter V).
fn solved_h(w: f64, nodes: &[(f64, f64)]) -> Vec<f64> {
    let integral =
        |x: f64, h: &[f64]| nodes.iter().zip(h).map(|((y, weight), h)| weight * y * h / (x + y)).sum::<f64>();
    let mut h = vec![1.0; nodes.len()];
    for _ in 0..400 {
        let next = |(x, _): &(f64, f64)| 1.0 / ((1.0 - w).sqrt() + 0.5 * w * integral(*x, &h));
        let next: Vec<f64> = nodes.iter().map(next).collect();
        h = h.iter().zip(next).map(|(a, b)| 0.5 * (a + b)).collect();
    }
    h
}

/// Midpoints in t of x = t³, so that the logarithm at 0 is resolved.
fn nodes() -> Vec<(f64, f64)> {
    let count = 300;
    let t = |k: u32| (f64::from(k) + 0.5) / f64::from(count);
    (0..count).map(|k| (t(k).powi(3), 3.0 * t(k).powi(2) / f64::from(count))).collect()
}

#[test]
fn the_h_function_solves_its_integral_equation() {
    let nodes = nodes();
    let mut worst: f64 = 0.0;
    let mut worst_hapke_1981: f64 = 0.0;
    for w in [0.05, 0.3, 0.6, 0.8, 0.9, 0.97, 0.99, 0.999, 1.0] {
        let exact = solved_h(w, &nodes);
        for ((x, _), h) in nodes.iter().zip(&exact) {
            // The solution itself, against the equation as Chandrasekhar states it.
            let sum: f64 = nodes.iter().zip(&exact).map(|((y, weight), h)| weight * h / (x + y)).sum();
            assert!((h * (1.0 - 0.5 * w * x * sum) - 1.0).abs() < 2e-3, "w {w}, x {x}");
            worst = worst.max((chandrasekhar_h(w, *x) / h - 1.0).abs());
            let older = (1.0 + 2.0 * x) / (1.0 + 2.0 * x * (1.0 - w).sqrt());
            worst_hapke_1981 = worst_hapke_1981.max((older / h - 1.0).abs());
        }
    }
    println!("H is off by {worst:.1e} at most; Hapke's approximation of 1981 by {worst_hapke_1981:.1e}");
    assert!(worst < 7e-4, "H off by {worst}");
    assert!(worst_hapke_1981 > 0.03, "the test can tell an approximation of some per cent");
    // Chandrasekhar (1960), table XI, conservative scattering.
    for (x, h) in [(0.1, 1.2474), (0.2, 1.4504), (0.5, 2.0128), (1.0, 2.9078)] {
        assert_near(chandrasekhar_h(1.0, x), h, 7e-4, "table XI");
    }
}

#[test]
fn every_model_is_reciprocal() {
    for model in every_model() {
        for angles in grid() {
            let over_cosine = |a: &PhotometricAngles| model.reflectance(0.2, a) / a.cos_incidence;
            assert_near(
                over_cosine(&angles),
                over_cosine(&angles.exchanged()),
                1e-9,
                &format!("{model:?}, {angles:?}"),
            );
        }
    }
    // I/F itself is not symmetric.
    let angles = at(10.0, 70.0, 20.0);
    let whole = |a: &PhotometricAngles| Photometry::Lambert.reflectance(0.2, a);
    assert!((whole(&angles) / whole(&angles.exchanged()) - 1.0).abs() > 0.5);
}

#[test]
fn models_meet_at_their_limits() {
    let same = |a: &Photometry, b: &Photometry, relative| {
        // A slight roughness still matters where a direction grazes the surface as closely.
        for angles in grid().filter(|a| a.cos_incidence.min(a.cos_emission) > 0.08) {
            assert_near(
                a.reflectance(0.3, &angles),
                b.reflectance(0.3, &angles),
                relative,
                &format!("{a:?}, {angles:?}"),
            );
        }
    };
    same(&lunar(1.0), &Photometry::LommelSeeliger, 1e-12);
    same(&lunar(0.0), &Photometry::Lambert, 1e-12);
    same(&Photometry::OrenNayar { slope_sigma_deg: 0.0 }, &Photometry::Lambert, 1e-12);
    same(&hapke([-0.3, 1.0, 0.05, 0.06]), &hapke([-0.3, 1.0, 0.05, 0.0]), 0.02);
    // Dark isotropic grains without surge: w/4 µ₀/(µ₀+µ), so Lommel and Seeliger's law with the albedo w/8; the rest is
    // multiple scattering, of the order of w.
    let grains = hapke([0.0, 0.0, 0.05, 0.0]);
    for w in [1e-2, 1e-3, 1e-4] {
        for angles in grid() {
            let dark = Photometry::LommelSeeliger.reflectance(w / 8.0, &angles);
            assert_near(grains.reflectance(w, &angles), dark, 1.5 * w, &format!("w {w}, {angles:?}"));
        }
    }
}

#[test]
fn no_surface_sends_back_more_light_than_it_receives() {
    let incidences_deg = (0..30).map(|k| 3.0 * f64::from(k)).chain([89.0, 89.5, 89.9]);
    // The brightest albedo at which each model may be used.
    let brightest = |model: &Photometry| match model {
        Photometry::Lambert | Photometry::OrenNayar { .. } => 1.0,
        Photometry::LommelSeeliger => 0.25,
        Photometry::LunarLambert { weight: LunarWeight::Constant(weight) } => 1.0 / (1.0 + 3.0 * weight),
        Photometry::LunarLambert { .. } => 0.3,
        Photometry::Hapke(_) => 0.9,
    };
    for model in every_model() {
        let albedo = brightest(&model);
        let shares = incidences_deg.clone().map(|i| model.directional_hemispherical(albedo, f64::to_radians(i)));
        let most = shares.fold(0.0, f64::max);
        println!("{model:?} with the albedo {albedo:.3}: {most:.4} at most");
        assert!(most <= 1.0 + 1e-9, "{model:?} sends back {most}");
        assert!(most > 0.2, "{model:?} is not dark");
    }
    // Closed forms: A for Lambert; 4 A (1 - µ₀ ln((1+µ₀)/µ₀)) for Lommel-Seeliger; 1 - √(1-w) H(µ₀) for isotropic grains.
    for incidence_deg in [0.0_f64, 40.0, 75.0] {
        let (i, cosine) = (incidence_deg.to_radians(), incidence_deg.to_radians().cos());
        assert_near(Photometry::Lambert.directional_hemispherical(0.7, i), 0.7, 1e-3, "Lambert");
        let seeliger = 4.0 * 0.2 * (1.0 - cosine * ((1.0 + cosine) / cosine).ln());
        assert_near(Photometry::LommelSeeliger.directional_hemispherical(0.2, i), seeliger, 1e-3, "Lommel-Seeliger");
        let (w, grains) = (0.95, hapke([0.0, 0.0, 0.05, 0.0]));
        let expected = 1.0 - f64::sqrt(1.0 - w) * chandrasekhar_h(w, cosine);
        assert_near(grains.directional_hemispherical(w, i), expected, 3e-3, "Hapke");
    }
}

#[test]
fn surfaces_brighter_than_their_model_allows_are_refused() {
    for (model, fine, too_bright) in [(lunar(0.6), 0.34, 0.4), (Photometry::LommelSeeliger, 0.24, 0.3)] {
        model.validate(fine).expect("possible");
        let message = model.validate(too_bright).expect_err("impossible").to_string();
        assert!(message.contains("albedo is") && message.contains("lower"), "{message}");
    }
    let cases = [
        ("[tumbling.surface]\nalbedo = 0.9", "tumbling.surface.albedo"),
        ("[descent.terrain]\nalbedo = 0.9", "descent.terrain.albedo"),
        (
            "[tumbling.surface.photometry.lunar-lambert]\nweight = 2.0",
            "tumbling.surface.photometry.lunar-lambert.weight",
        ),
        ("[descent.terrain.photometry.oren-nayar]\nslope_sigma_deg = 80", "photometry.oren-nayar.slope_sigma_deg"),
        ("[tumbling.surface.photometry.hapke]\nroughness_deg = 60", "photometry.hapke.roughness_deg"),
    ];
    for (text, key) in cases {
        let message = super::scenario(text).expect_err("refused").to_string();
        assert!(message.contains(key), "{text}: {message}");
    }
}

#[test]
fn scenarios_name_models_in_every_form() {
    let photometry = |line: &str| {
        let text = format!("[tumbling.surface]\nphotometry = {line}\n");
        let scenario = super::scenario(&text).expect(line);
        assert_eq!(scenario, super::scenario(&scenario.to_toml()).expect("reads back"), "{}", scenario.to_toml());
        super::tumbling(&text).body.surface.photometry
    };
    assert_eq!(photometry("\"lambert\""), Photometry::Lambert);
    assert_eq!(photometry("\"lommel-seeliger\""), Photometry::LommelSeeliger);
    assert_eq!(photometry("{ lunar-lambert = { weight = 0.3 } }"), lunar(0.3));
    let moon = "{ lunar-lambert = { weight = [-0.019, 2.42e-4, -1.46e-6] } }";
    assert_eq!(photometry(moon), Photometry::LunarLambert { weight: LunarWeight::MOON });
    assert_eq!(
        photometry("{ oren-nayar = { slope_sigma_deg = 20 } }"),
        Photometry::OrenNayar { slope_sigma_deg: 20.0 }
    );
    assert_eq!(photometry("{ hapke = {} }"), Photometry::Hapke(HapkeParameters::default()));
    let text = "[tumbling.surface.photometry.lunar-lambert]\nweight = \"moon\"";
    let message = super::scenario(text).expect_err("refused").to_string();
    assert!(message.contains("three coefficients"), "{message}");
}
