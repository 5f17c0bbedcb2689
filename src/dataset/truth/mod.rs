//! The ground truth of a data set, `truth/`: everything that an estimator may not see. States of the lander or of
//! several spacecraft (`lander`), of the small body (`asteroid`), points of the ground and where they are seen
//! (`landmark`), optical flow (`flow`), and where each file lies (`layout`). The scene writes it, evaluation reads it;
//! the architecture test keeps vision and navigation out.

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
