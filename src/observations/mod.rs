//! What the front end writes and navigation reads: tracks (`track`), rotations of image pairs (`rotation`), statuses of
//! images (`frame_status`), chains of attitudes over them, the camera that a filter predicts for a map to be searched
//! (`predicted_camera`), and their files. Free of OpenCV, so that whoever has observations of another make navigates by
//! them alike: write `tracks.csv`, or fill the structs.

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
