//! Scenarios that name elevation models and orthoimages.

use crate::scene::{datasets, scenario};
use opnav::scene::{DescentScene, Scene};
use std::path::Path;

fn build(text: &str, folder: &Path) -> Result<DescentScene, String> {
    match scenario(text).map_err(|e| e.to_string())?.build(folder).map_err(|e| e.to_string())? {
        Scene::Descent(scene) => Ok(*scene),
        _ => panic!("not a descent"),
    }
}

const COPRATES: &str = "[descent.elevation]\nfile.path = \"mola/coprates.lbl\"\n";

#[test]
fn the_site_lies_on_measured_ground() {
    let site = "site.degrees = { latitude_deg = -13.375, longitude_deg = 299.875 }\n";
    let scene = build(&format!("{COPRATES}{site}"), datasets()).unwrap();
    let summary = scene.terrain.base().unwrap().elevation.as_ref().unwrap().summary();
    assert_eq!((summary.site_height_m, summary.filled_posts), (-4751.0, 0));
    assert_eq!(scene.terrain.height_m(0.0, 0.0), 0.0);
    // The post to the north is 2149 m higher, and the planet falls 32 m on the way.
    let detail_m = 400.0;
    let north_m = scene.terrain.height_m(0.0, 14_797.0);
    assert!((north_m - (4751.0 - 2602.0 - 32.0)).abs() < detail_m, "{north_m}");
    let bare = build(&format!("{COPRATES}{site}detail = false\n"), datasets()).unwrap();
    let north_m = bare.terrain.height_m(0.0, 14_797.0);
    assert!((north_m - (4751.0 - 2602.0 - 32.0)).abs() < 5.0, "{north_m}");
}

#[test]
fn resolved_copies_of_measured_ground_read_back_equal() {
    let text = format!(
        "{COPRATES}site.metres = {{ x_m = 1, y_m = 2 }}\nfile.no_data = [-1, 7.5]\nfile.radius_m = 3e6\n\
         file.layout = {{ columns = 9, rows = 8, sample = \"f32-little\" }}\n\
         file.geometry.degrees = {{ px_per_deg = 4, first_longitude_deg = 0, first_latitude_deg = 1 }}\n\
         [descent.orthoimage]\nfile.path = \"a.png\"\nvalues = \"absolute\"\nfile.scale = 0.01\n\
         file.geometry.metres = {{ metres_per_px = 4 }}\nsite = \"middle\"\n"
    );
    let first = scenario(&text).unwrap();
    assert_eq!(first, scenario(&first.to_toml()).unwrap(), "{}", first.to_toml());
}

#[test]
fn faults_of_measured_ground_name_the_key_or_the_file() {
    let at = |latitude_deg: f64| {
        format!("{COPRATES}site.degrees = {{ latitude_deg = {latitude_deg}, longitude_deg = 299.9 }}\n")
    };
    let cases = [
        (at(20.0), "coprates.lbl", "descent.elevation.site is latitude 20"),
        (at(-4.2), "descent.elevation.site", "flies beyond the elevation model"),
        (at(-95.0), "descent.elevation.site.degrees.latitude_deg", "-95"),
        (COPRATES.replace("coprates", "none"), "none.lbl", "read the raster"),
        (format!("{COPRATES}file.scale = 0\n"), "descent.elevation.file.scale", "not be 0"),
        (format!("{COPRATES}colour = 1\n"), "descent.elevation.colour", "there is no key"),
        ("[descent.elevation]\ndetail = true\n".into(), "file", "missing"),
        (COPRATES.replace("elevation", "orthoimage") + "file.offset = -1e5\n", "coprates.lbl", "mean albedo"),
    ];
    for (text, key, fault) in cases {
        let error = build(&text, datasets()).unwrap_err();
        assert!(error.contains(key) && error.contains(fault), "{text}: {error}");
    }
}
