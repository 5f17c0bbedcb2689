//! Files of tracks and of rotations of pairs.

use nalgebra::{Matrix3, UnitQuaternion, Vector2, Vector3};
use opnav::observations::*;

fn observation(t_ns: i64, track_id: u64) -> TrackObservation {
    let pixel_px = Vector2::new(1.0 / 3.0 + track_id as f64, 40.25);
    TrackObservation { t_ns, track_id, pixel_px, sigma_px: 0.1, response: 1e-7 }
}

fn rotation(status: PairStatus, model: RotationModel) -> RelativeRotation {
    RelativeRotation {
        t_ns_from: -5,
        t_ns_to: 1_000_000_000,
        camera_to_from_camera_from: UnitQuaternion::from_scaled_axis(Vector3::new(0.1, -0.2, 0.3)),
        covariance_rad2: Matrix3::from_diagonal(&Vector3::new(1e-6, 4e-6, 9e-6)),
        matches: 12,
        inliers: 10,
        model,
        status,
    }
}

#[test]
fn tracks_come_back_as_written_under_the_contract_header() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tracks.csv");
    let all = vec![observation(-3, 0), observation(-3, 7), observation(9, 7)];
    write_tracks(&path, &all).unwrap();
    assert_eq!(read_tracks(&path).unwrap(), all);
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.lines().next().unwrap(), "t_ns,track_id,u_px,v_px,sigma_px,response");
}

#[test]
fn rotations_come_back_as_written_with_every_word_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("relative_rotations.csv");
    let all = vec![
        rotation(PairStatus::Ok, RotationModel::Essential),
        rotation(PairStatus::NoFeatures, RotationModel::None),
        rotation(PairStatus::FewMatches, RotationModel::None),
        rotation(PairStatus::Degenerate, RotationModel::Homography),
        rotation(PairStatus::NoMotion, RotationModel::FixedCenter),
        rotation(PairStatus::Rejected, RotationModel::None),
    ];
    write_relative_rotations(&path, &all).unwrap();
    for (read, written) in read_relative_rotations(&path).unwrap().iter().zip(&all) {
        assert!((read.covariance_rad2 - written.covariance_rad2).abs().max() < 1e-18);
        assert_eq!((read.status, read.model), (written.status, written.model));
        assert_eq!(read.camera_to_from_camera_from, written.camera_to_from_camera_from);
        assert_eq!((read.t_ns_from, read.matches, read.inliers), (-5, 12, 10));
    }
    let text = std::fs::read_to_string(&path).unwrap();
    let header = "t_ns_from,t_ns_to,qw,qx,qy,qz,sigma_x_rad,sigma_y_rad,sigma_z_rad,matches,inliers,model,status";
    assert_eq!(text.lines().next().unwrap(), header);
    for word in ["no-features", "few-matches", "degenerate", "no-motion", "rejected", "fixed-center", ",essential,ok"] {
        assert!(text.contains(word), "{word}");
    }
}

#[test]
fn malformed_results_are_refused_with_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tracks.csv");
    let header = "t_ns,track_id,u_px,v_px,sigma_px,response\n";
    for (body, word) in [
        ("1,2,3,4,0.1\n", "5 columns found, 6 expected"),
        ("1,2,x,4,0.1,0\n", "u_px is 'x'"),
        ("1,2,3,NaN,0.1,0\n", "v_px is 'NaN'"),
        ("1,2.5,3,4,0.1,0\n", "track_id is '2.5'"),
        ("1,2,3,4,0,0\n", "sigma_px is 0"),
    ] {
        std::fs::write(&path, format!("{header}{body}")).unwrap();
        let error = read_tracks(&path).unwrap_err().to_string();
        assert!(error.contains("tracks.csv, line 2") && error.contains(word), "{error}");
    }
    std::fs::write(&path, format!("{header}5,1,3,4,0.1,0\n4,1,3,4,0.1,0\n")).unwrap();
    assert!(read_tracks(&path).unwrap_err().to_string().contains("line 3"));
    std::fs::write(&path, "t_ns,id\n").unwrap();
    assert!(read_tracks(&path).unwrap_err().to_string().contains("line 1"));
    let path = folder.path().join("relative_rotations.csv");
    write_relative_rotations(&path, &[rotation(PairStatus::Ok, RotationModel::Essential)]).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    for (old, new, word) in [(",ok", ",fine", "status 'fine'"), (",essential", ",epipolar", "model 'epipolar'")] {
        std::fs::write(&path, text.replace(old, new)).unwrap();
        let error = read_relative_rotations(&path).unwrap_err().to_string();
        assert!(error.contains("line 2") && error.contains(word), "{error}");
    }
    assert!(read_tracks(&folder.path().join("absent.csv")).unwrap_err().to_string().contains("absent.csv"));
}
