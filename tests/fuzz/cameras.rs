//! Camera files.

use super::campaign::Target;
use super::fuzzed;
use nalgebra::Vector2;
use opnav::dataset::{read_camera_sensor, write_camera_sensor};

const LENSES: [&str; 3] = [
    "none\ndistortion_coefficients: []\n",
    "radial-tangential\ndistortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]\n",
    "equidistant\ndistortion_coefficients: [0.120292, 0.033713, -0.000063, 0.000032]\n",
];

fn camera() -> Target {
    let file = |lens: &str| {
        format!(
            "%YAML:1.0\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1.0, 0.0, 0.0, 0.5,\n   0.0, 0.0, -1.0, 0.0,\n   \
             0.0, 1.0, 0.0, 0.0,\n   0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nbits: 12\nresolution: [752, 480]\n\
             intrinsics: [458.654, 457.296, 367.215, 248.375]\ndistortion_model: {lens}"
        )
    };
    Target {
        name: "camera",
        file: "sensor.yaml",
        beside: vec![],
        whole: LENSES.iter().map(|lens| file(lens).into_bytes()).collect(),
        read: |folder| {
            let sensor = read_camera_sensor(&folder.join("sensor.yaml")).map_err(|e| e.to_string())?;
            // What is accepted can be used: every corner has a bearing, and the file can be written and read again.
            let corner =
                Vector2::new(f64::from(sensor.camera.width_px) - 0.5, f64::from(sensor.camera.height_px) - 0.5);
            assert!(sensor.camera.unproject(&corner).is_some_and(|b| b.iter().all(|v| v.is_finite())));
            let back = folder.join("back.yaml");
            write_camera_sensor(&back, &sensor).expect("written");
            assert_eq!(read_camera_sensor(&back).expect("read back").camera, sensor.camera);
            Ok(())
        },
    }
}

fuzzed! {
    camera_files: camera();
}
