//! The ground truth of a data set, `truth/`: everything that an estimator may not see.

mod asteroid;
mod flow;
mod lander;
mod landmark;
mod layout;

pub use asteroid::{AsteroidInertia, AsteroidState, read_asteroid, write_asteroid};
pub use flow::{OpticalFlow, encode_flow, read_flow};
pub use lander::{LanderState, read_lander_states, read_node_states, write_lander_states, write_node_states};
pub use landmark::{
    Landmark, LandmarkObservation, read_landmarks, read_observations, write_landmarks, write_observations,
};
pub use layout::{TruthRaster, camera_poses_file, truth_folder};
