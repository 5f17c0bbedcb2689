//! The contract on disk: image frames, camera and IMU files, the manifest, and the ground truth.
//!
//! Layout and column names follow EuRoC/ASL, so that other tools read a data set as it is. Every file is written to a
//! temporary name and renamed, so an interrupted job leaves nothing half-written. The ground truth has a module of its
//! own, [`truth`], which estimators may not name.

mod atomic;
mod camera_id;
mod colmap;
mod designated;
mod error;
mod frame_list;
mod grey_levels;
mod ground_map;
mod ground_map_file;
mod imu;
mod initial;
mod journal;
mod manifest;
mod picture;
mod picture_file;
mod raster;
mod sensor;
mod sequence;
mod table;
pub mod truth;
mod tum;

pub use atomic::{remove_partial_files, write_atomically, write_text};
pub use camera_id::{CameraId, find_cameras};
pub use colmap::{ColmapImage, ColmapModel, ColmapPoint, read_colmap, write_colmap};
pub use designated::{DesignatedPoint, read_designated, write_designated};
pub use error::DatasetError;
pub use frame_list::FrameTimes;
pub use grey_levels::GreyLevels;
pub use ground_map::{GroundMap, MapLevel};
pub use ground_map_file::{read_ground_map, write_ground_map};
pub use imu::{ImuBiasNoise, ImuNoise, ImuSample, read_imu, write_imu, write_imu_sensor};
pub use initial::{InitialState, read_initial_state, write_initial_state};
pub use journal::{Checksums, EarlierWork, Journal, read_earlier_work, sha256_hex};
pub use manifest::{Manifest, read_manifest, write_manifest};
pub use picture::GreyPicture;
pub use raster::{
    encode_grey_png, encode_scalar_tiff, encode_vector_tiff, read_depth_tiff, read_mask_png, read_normals_tiff,
    write_depth_tiff, write_grey_png,
};
pub use sensor::{CameraSensor, read_camera_sensor, write_camera_sensor};
pub use sequence::{CameraSource, Frame, ImageSequence};
pub use table::{TimedRow, TimedTable, read_timed_table, write_timed_table};
pub use tum::{StampedPose, read_tum, write_tum};
