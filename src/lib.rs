//! **opnav**: optical navigation in deep space.
//!
//! Renders planetary descents, tumbling small bodies and linked spacecraft above a small body with pixel-exact truth,
//! extracts and matches Harris features, recovers relative rotation, and navigates by them (linked spacecraft not yet).
//! Data flows one way, from a scenario to a report:
//!
//! ```text
//! scenario -> scene -> render -> dataset -> vision -> navigation -> evaluation -> report
//!                                   ^                                   ^
//!                      any image folder enters here        truth meets estimate only here
//! ```
//!
//! # Conventions
//!
//! **Frames**, a closed list: `inertial`; `site` (fixed to the ground, z up, origin at the landing point); `lander` (IMU
//! axes); `asteroid` (fixed to the small body); `node` (one of several linked spacecraft); `camera` (OpenCV: x right,
//! y down, z forward); `pixel`; `clip`.
//!
//! **Rotations and poses** are named so that neighbours cancel: `camera_from_site = camera_from_lander *
//! lander_from_site`. A rotation is a nalgebra [`UnitQuaternion<f64>`](nalgebra::UnitQuaternion) (Hamilton, active); a
//! pose is an [`Isometry3<f64>`](nalgebra::Isometry3). Files name their columns `qw,qx,qy,qz`.
//!
//! **Error state**: `x.plus(d)` and `truth.minus(estimate)`, see [`geometry::Manifold`].
//!
//! **Pixel centres**: the centre of the top-left pixel is (0, 0), as in OpenCV; u to the right, v down.
//!
//! **Depth** is z-depth along the optical axis in metres, never the range.
//!
//! **Units** are SI inside and stand in every name (`_m`, `_rad_s`, `_px`, …); degrees only at the command line, in
//! scenario files (`_deg`) and in reports. Stored time is `t_ns: i64`, a filter's step is `dt_s: f64`.
//!
//! # Features
//!
//! All are on by default; each only brings rooms in, and none changes a number.
//!
//! | feature | brings | through |
//! |---|---|---|
//! | none | geometry, data sets, observations, navigation, evaluation | |
//! | `settings` | settings in files and as single changes | schemars, strsim |
//! | `scene` | scenarios, terrain, bodies, light; campaigns | anise, tobj, ply-rs-bw, stl_io |
//! | `render` | the renderer, with `scene` | wgpu: a Vulkan, Metal or DirectX 12 driver |
//! | `vision` | the image front end | OpenCV 4 |
//! | `report` | plots and the page | plotters, maud |
//! | `cli` | the program `opnav`, with the subcommands that the others make possible | clap, indicatif |
//!
//! As a library for filters alone: `opnav = { version = "0.1", default-features = false }`.
//!
//! # Where to begin
//!
//! The four programs in `examples/`, then the [`guide`] with its walks through the rooms, then the room in question.
#![warn(missing_docs)]

#[cfg(feature = "scene")]
pub mod campaign;
pub mod dataset;
pub mod evaluation;
pub mod geometry;
pub mod navigation;
pub mod observations;
pub mod pipeline;
#[cfg(feature = "render")]
pub mod render;
pub mod report;
#[cfg(feature = "scene")]
pub mod scene;
pub mod settings;
pub mod stats;
#[cfg(feature = "vision")]
pub mod vision;

#[cfg(all(feature = "render", feature = "vision", feature = "report"))]
#[doc = include_str!("guide.md")]
pub mod guide {}
