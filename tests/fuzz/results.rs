//! Result tables, inventories, and models of other tools.

use super::campaign::Target;
use super::fuzzed;
use opnav::dataset::*;
use opnav::evaluation::Summary;
use opnav::observations::*;
use std::path::Path;

fn target(name: &'static str, file: &'static str, whole: &[&str], read: fn(&Path) -> Result<(), String>) -> Target {
    let whole = whole.iter().map(|text| text.as_bytes().to_vec()).collect();
    Target { name, file, beside: vec![], whole, read }
}

fn tracks() -> Target {
    let whole = ["t_ns,track_id,u_px,v_px,sigma_px,response\n-3,0,1.5,40.25,0.1,1e-7\n9,7,100,2e1,0.05,0\n"];
    target("tracks", "tracks.csv", &whole, |folder| {
        let tracks = read_tracks(&folder.join("tracks.csv")).map_err(|e| e.to_string())?;
        let back = folder.join("back.csv");
        write_tracks(&back, &tracks).expect("written");
        assert_eq!(read_tracks(&back).expect("read back"), tracks);
        Ok(())
    })
}

fn rotations() -> Target {
    let whole = ["t_ns_from,t_ns_to,qw,qx,qy,qz,sigma_x_rad,sigma_y_rad,sigma_z_rad,matches,inliers,model,status\n\
                  -5,9,1,0,0,0,1e-3,2e-3,3e-3,12,10,essential,ok\n9,12,0.6,0.8,0,0,0,0,0,12,0,none,few-matches\n"];
    target("rotations", "relative_rotations.csv", &whole, |folder| {
        let rotations = read_relative_rotations(&folder.join("relative_rotations.csv")).map_err(|e| e.to_string())?;
        let back = folder.join("back.csv");
        write_relative_rotations(&back, &rotations).expect("written");
        assert_eq!(read_relative_rotations(&back).expect("read back").len(), rotations.len());
        Ok(())
    })
}

const SHA: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

fn manifest() -> Target {
    let whole = format!(
        r#"{{"opnav_version": "0.1.0", "adapter": "llvmpipe", "frame_count": 3, "cameras": ["cam0"], "sha256": {{"a": "{SHA}"}}}}"#
    );
    target("manifest", "manifest.json", &[&whole], |root| read_manifest(root).map(drop).map_err(|e| e.to_string()))
}

/// A journal is never refused: what is not a whole line is passed over. So is a manifest beside it.
fn journal() -> Target {
    let whole = format!("# opnav 0.1.0, llvmpipe\n{SHA}  cam0/data/1.png\n{SHA}  truth/state.csv\n");
    target("journal", "unfinished.txt", &[&whole], |root| {
        let work = read_earlier_work(root).map_err(|e| e.to_string())?;
        assert!(work.finished.values().all(|sha256| sha256.len() == 64));
        match work.finished.len() {
            2 => Ok(()),
            _ => Err("unfinished.txt: lines were lost".into()),
        }
    })
}

fn summary() -> Target {
    let whole =
        [r#"{"mission": "tracking", "t0_ns": 5, "options": {"every": 1}, "final": null, "timing_ms": {"load": 1.5}}"#];
    target("summary", "summary.json", &whole, |folder| Summary::read(folder).map(drop).map_err(|e| e.to_string()))
}

const CAMERAS: &str = "# cameras\n1 PINHOLE 64 48 60 60 32 24\n2 OPENCV 64 48 60 60 32 24 -0.2 0.1 1e-3 0\n";
const IMAGES: &str = "# images\n1 1 0 0 0 1 2 3 1 a.png\n10.5 20.5 1 30 40 -1\n2 0.6 0.8 0 0 1 2 3 2 b.png\n\n";
const POINTS: &str = "# points\n1 1 2 3 255 255 255 0.5 1 0\n";

fn colmap(file: &'static str, name: &'static str, whole: &'static str) -> Target {
    let all = [("cameras.txt", CAMERAS), ("images.txt", IMAGES), ("points3D.txt", POINTS)];
    let beside =
        all.into_iter().filter(|(other, _)| *other != file).map(|(other, text)| (other, text.into())).collect();
    let read = |folder: &Path| read_colmap(folder).map(drop).map_err(|e| e.to_string());
    Target { beside, ..target(name, file, &[whole], read) }
}

fuzzed! {
    track_tables: tracks();
    rotation_tables: rotations();
    manifests: manifest();
    journals: journal();
    summaries: summary();
    colmap_cameras: colmap("cameras.txt", "colmap_cameras", CAMERAS);
    colmap_images: colmap("images.txt", "colmap_images", IMAGES);
    colmap_points: colmap("points3D.txt", "colmap_points", POINTS);
}
