//! Tests of the wing `dataset::images`.

mod camera_file;
mod frame_list;
mod grey_levels;
mod image_file;
mod raster;
mod sequence;
