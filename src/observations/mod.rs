//! What the front end writes and navigation reads: tracks, rotations of image pairs, statuses of images, and their
//! files. Free of OpenCV, so that whoever has observations of another make navigates by them alike.

mod attitude_chains;
mod frame_status;
mod predicted_camera;
mod rotation;
mod rotations_file;
mod text_table;
mod track;
mod tracks_file;

pub use attitude_chains::attitude_chains;
pub use frame_status::FrameStatus;
pub use predicted_camera::PredictedCamera;
pub use rotation::{PairStatus, RelativeRotation, RotationModel};
pub use rotations_file::{read_relative_rotations, write_relative_rotations};
pub use track::TrackObservation;
pub use tracks_file::{read_tracks, write_tracks};
