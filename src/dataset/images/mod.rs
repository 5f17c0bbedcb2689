//! Images and what is known of them: from a folder to a list of frames with times (`sequence`, `frame_list`), from a
//! file of any depth to numbers (`image_file`) and to intensities on one scale for all (`grey_levels`), and the camera
//! that took them (`sensor`). `raster` writes and reads images of numbers: depth, normals, masks. Read `sequence`
//! first. The front end and the writers of data sets use it; estimators need none of it.

mod frame;
mod frame_list;
mod grey_levels;
mod image;
mod image_file;
mod raster;
mod sensor;
mod sequence;

pub use frame::Frame;
pub use frame_list::FrameTimes;
pub use grey_levels::IntensityScale;
pub use image::GreyRaster;
pub use image_file::{RawImage, read_header, read_numbers};
pub use raster::{
    encode_grey_png, encode_scalar_tiff, encode_vector_tiff, read_depth_tiff, read_mask_png, read_normals_tiff,
    write_depth_tiff, write_grey_png,
};
pub use sensor::{CameraSensor, read_camera_sensor, write_camera_sensor};
pub use sequence::{CameraSource, ImageSequence};
