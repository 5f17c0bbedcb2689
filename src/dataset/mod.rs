//! The contract on disk: image frames, camera and IMU files, the manifest, and the ground truth.
//!
//! Layout and column names follow EuRoC/ASL, so that other tools read a data set as it is. Every file is written to a
//! temporary name and renamed, so an interrupted job leaves nothing half-written. The ground truth has a module of its
//! own, [`truth`], which estimators may not name.

mod camera_id;
mod designated;
mod error;
mod exchange;
mod ground_map;
mod ground_map_file;
mod images;
mod imu;
mod initial;
mod storage;
pub mod truth;

pub use camera_id::{CameraId, find_cameras};
pub use designated::{DesignatedPoint, read_designated, write_designated};
pub use error::DatasetError;
pub use exchange::{
    ColmapImage, ColmapModel, ColmapPoint, StampedPose, read_colmap, read_tum, write_colmap, write_tum,
};
pub use ground_map::{GroundMap, MapLevel};
pub use ground_map_file::{read_ground_map, write_ground_map};
pub use images::{
    CameraSensor, CameraSource, Frame, FrameTimes, GreyRaster, ImageSequence, IntensityScale, encode_grey_png,
    encode_scalar_tiff, encode_vector_tiff, read_camera_sensor, read_depth_tiff, read_mask_png, read_normals_tiff,
    write_camera_sensor, write_depth_tiff, write_grey_png,
};
pub use imu::{ImuBiasNoise, ImuNoise, ImuSample, read_imu, write_imu, write_imu_sensor};
pub use initial::{InitialState, read_initial_state, write_initial_state};
pub use storage::{
    Checksums, EarlierWork, Journal, Manifest, TimedRow, TimedTable, read_earlier_work, read_manifest,
    read_timed_table, remove_partial_files, sha256_hex, write_atomically, write_manifest, write_text,
    write_timed_table,
};
