//! The scenes that are rendered, and where they are kept: an interrupted calibration goes on with those that are there.

use opnav::pipeline::{MapRequest, Silent, SurveyLevel, SynthesizeRequest, make_map, synthesize};
use opnav::settings::Layers;
use std::path::{Path, PathBuf};

/// Parts of the way down at which stretches of pictures begin, 1 s apart: from 5.5 km to 50 m.
const STRETCHES: [f64; 6] = [0.05, 0.30, 0.53, 0.71, 0.83, 0.90];
/// Pictures of a whole descent whose height shrinks by the same ratio from each to the next.
const FLIGHT: usize = 60;

/// What is rendered.
#[derive(Debug, Clone, Copy)]
pub struct Set {
    /// Folder under `datasets/`.
    pub folder: &'static str,
    /// Scenarios of descents, with the time that they take, s.
    pub grounds: &'static [(&'static str, f64)],
    /// Scenarios of bodies.
    pub bodies: &'static [&'static str],
    /// Pictures of a stretch.
    pub stretch: usize,
}

/// What the constants are fitted on.
pub const FIT: Set = Set {
    folder: "calibration",
    grounds: &[("ground_smooth", 198.0), ("ground_rocky", 170.0), ("ground_cratered", 198.0), ("ground_noisy", 220.0)],
    bodies: &["body_round", "body_long", "body_boulders", "body_fast"],
    stretch: 5,
};

/// What the fit is judged on, once.
pub const HELD_OUT: Set = Set {
    folder: "calibration/held_out",
    grounds: &[("ground_east", 198.0), ("ground_west", 185.0)],
    bodies: &["body_flat", "body_rough"],
    stretch: 6,
};

/// A rendered scene.
#[derive(Debug, Clone)]
pub struct Scene {
    pub images: PathBuf,
    /// The map of its ground.
    pub map: Option<PathBuf>,
}

/// All scenes of a set by kind.
pub struct Scenes {
    pub stretches: Vec<Scene>,
    pub flights: Vec<Scene>,
    pub bodies: Vec<Scene>,
}

impl Set {
    fn scenario(&self, name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(self.folder).join(format!("{name}.toml"))
    }

    /// Paths of the scenarios from the repository's root.
    pub fn scenarios(&self) -> Vec<String> {
        let names = self.grounds.iter().map(|g| g.0).chain(self.bodies.iter().copied());
        names.map(|name| format!("datasets/{}/{name}.toml", self.folder)).collect()
    }

    /// Renders what is not there yet.
    pub fn rendered(&self) -> Scenes {
        let mut scenes = Scenes { stretches: vec![], flights: vec![], bodies: vec![] };
        for (ground, duration_s) in self.grounds {
            let map = Some(self.map(ground));
            for share in STRETCHES {
                let start_s = (duration_s * share).floor();
                let end_s = start_s + (self.stretch - 1) as f64;
                let name = format!("{ground}_{}", (100.0 * share).round());
                let schedule = format!("uniform={{rate_hz=1.0,start_s={start_s:.1},end_s={end_s:.1}}}");
                let images = self.render(ground, &name, &[format!("descent.schedule={{{schedule}}}")]);
                scenes.stretches.push(Scene { images, map: map.clone() });
            }
            let name = format!("{ground}_flight");
            let schedule = format!("descent.schedule={{constant-scale={{count={FLIGHT}}}}}");
            let images = self.render(ground, &name, &[schedule]);
            scenes.flights.push(Scene { images, map: map.clone() });
        }
        for body in self.bodies {
            scenes.bodies.push(Scene { images: self.render(body, body, &[]), map: None });
        }
        scenes
    }

    fn render(&self, scenario: &str, name: &str, overrides: &[String]) -> PathBuf {
        let out = kept().join(name);
        if !out.join("manifest.json").is_file() {
            println!("rendering {name}");
            let request = SynthesizeRequest {
                scenario: self.scenario(scenario),
                out: out.clone(),
                layers: Layers::from(overrides),
                frames: None,
                resume: out.exists(),
                adapter: None,
            };
            synthesize(&request, &Silent).expect("the scenario renders");
        }
        out
    }

    fn map(&self, ground: &str) -> PathBuf {
        let out = kept().join(format!("{ground}_map"));
        if !out.join("map.toml").is_file() {
            println!("mapping {ground}");
            let level = |metres_per_px, side_m| SurveyLevel { metres_per_px, side_m };
            let levels = vec![level(0.5, 400.0), level(2.0, 1600.0), level(8.0, 8000.0), level(16.0, 20_000.0)];
            let scenario = self.scenario(ground);
            let request = MapRequest { scenario, out: out.clone(), layers: Layers::default(), levels, adapter: None };
            make_map(&request, &Silent).expect("the map is drawn");
        }
        out
    }
}

/// Where rendered scenes are kept: `OPNAV_CALIBRATION`, or under the build's folder.
pub fn kept() -> PathBuf {
    match std::env::var_os("OPNAV_CALIBRATION") {
        Some(folder) => folder.into(),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("target/calibration/scenes"),
    }
}
