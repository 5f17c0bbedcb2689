//! Whole descents by a map, from pixels: yaw is observed, and the position is that of the map.

use nalgebra::Vector2;
use opnav::dataset::{read_ground_map, write_ground_map};
use opnav::evaluation::Metrics;
use opnav::pipeline::{
    LandInput, LandRequest, LandSettings, MapRequest, Silent, SurveyLevel, SynthesizeRequest, evaluate_result, land,
    make_map, synthesize,
};
use opnav::settings::Layers;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A descent with its map in a folder of their own.
struct Descent {
    folder: TempDir,
}

impl Descent {
    fn new(overrides: &[String], levels: &[SurveyLevel]) -> Descent {
        let folder = TempDir::new().expect("a temporary folder");
        let descent = Descent { folder };
        let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/mars_descent_small.toml");
        let images = SynthesizeRequest {
            scenario: scenario.clone(),
            out: descent.at("images"),
            layers: Layers::from(overrides),
            frames: None,
            resume: false,
            adapter: None,
        };
        synthesize(&images, &Silent).expect("the scenario renders");
        let map = MapRequest {
            scenario,
            out: descent.at("map"),
            layers: Layers::from(overrides),
            levels: levels.to_vec(),
            adapter: None,
        };
        make_map(&map, &Silent).expect("the scenario is mapped");
        descent
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// How well the descent was navigated, and what its summary says.
    fn landed_by(&self, map: Option<&str>) -> (Metrics, Vec<String>) {
        let request = LandRequest {
            folder: self.at("images"),
            out: self.at("landing"),
            settings: LandSettings {
                input: LandInput { map: map.map(|name| self.at(name)) },
                ..LandSettings::default()
            },
        };
        let summary = land(&request, &Silent).expect("the descent is navigated");
        (evaluate_result(&request.out, &request.folder).expect("the result is evaluated"), summary.notes)
    }

    /// A copy of the map that lies elsewhere.
    fn shift_map(&self, name: &str, by_m: Vector2<f64>) {
        let mut map = read_ground_map(&self.at("map")).expect("a map");
        map.levels.iter_mut().for_each(|level| level.first_in_site_m += by_m);
        write_ground_map(&self.at(name), &map).expect("written");
    }
}

fn figure(metrics: &Metrics, name: &str) -> f64 {
    metrics.figure(name).unwrap_or(f64::NAN)
}

/// A small descent with a coarse map; the same without any, and by one that lies 5 m off, show what the map brings.
#[test]
fn a_descent_follows_its_map() {
    let overrides = [
        "camera.width_px=256",
        "camera.height_px=256",
        "descent.schedule.constant-scale.count=30",
        "descent.landmarks=0",
    ];
    let level = |metres_per_px: f64, side_m: f64| SurveyLevel { metres_per_px, side_m };
    let levels = [level(1.0, 400.0), level(4.0, 2400.0), level(16.0, 16_000.0)];
    let descent = Descent::new(&overrides.map(String::from), &levels);
    let [(with, notes), (without, _)] = [Some("map"), None].map(|map| descent.landed_by(map));
    let horizontal_m = figure(&with, "last_picture_horizontal_error");
    let [yaw_deg, free_deg] = [&with, &without].map(|m| figure(m, "last_picture_yaw_error").abs());
    println!("{horizontal_m} m, yaw {yaw_deg} and {free_deg} degrees");
    assert!(horizontal_m < 0.5, "{horizontal_m} m from where the map says");
    assert!(figure(&with, "last_picture_z_error").abs() < 1.0);
    assert!(yaw_deg < 0.05, "yaw {yaw_deg} degrees");
    assert!(free_deg > 0.05, "yaw is observed without a map: {free_deg} degrees");
    descent.shift_map("shifted", Vector2::new(3.0, -4.0));
    let off_m = figure(&descent.landed_by(Some("shifted")).0, "last_picture_horizontal_error");
    assert!((4.0..6.0).contains(&off_m), "a map that lies 5 m off leads {off_m} m off");
    // The designated pixel is known to 0.1 px, 7 m of ground from so high: a map that lies 60 m off contradicts it.
    descent.shift_map("far", Vector2::new(36.0, -48.0));
    let (_, far) = descent.landed_by(Some("far"));
    let contradiction =
        |notes: &[String]| notes.iter().find(|n| n.contains("the map and the designated point")).cloned();
    assert!(contradiction(&notes).is_none(), "{notes:?}");
    let said = contradiction(&far).expect("the summary says so");
    println!("{said}");
    let lies_m = said.split("lies ").nth(1).and_then(|rest| rest.split(' ').next()).and_then(|m| m.parse::<f64>().ok());
    assert!(lies_m.is_some_and(|m| (45.0..75.0).contains(&m)), "{said}");
}
