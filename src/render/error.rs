//! Everything that can stop an image from being rendered.

use crate::geometry::CameraError;
use crate::settings::OutOfRange;
use thiserror::Error;

/// Why no image could be rendered.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The machine offers no graphics adapter at all.
    #[error(
        "no graphics adapter was found: install a Vulkan driver (on Debian or Ubuntu without a GPU: `apt-get install \
         mesa-vulkan-drivers libvulkan1`)"
    )]
    NoAdapter,
    /// The adapter asked for is not there.
    #[error("no graphics adapter matches '{wanted}': choose a part of one of these names: {available}")]
    AdapterNotFound {
        /// Name asked for.
        wanted: String,
        /// Names available.
        available: String,
    },
    /// The adapter refused to work.
    #[error("the graphics adapter '{adapter}' could not {action}: {problem}")]
    Device {
        /// Name of the adapter.
        adapter: String,
        /// What was being done.
        action: &'static str,
        /// The driver's reason.
        problem: String,
    },
    /// A camera that cannot be rendered.
    #[error("cannot render with this camera: {0}")]
    Camera(#[from] CameraError),
    /// A lens that sees too much.
    #[error(
        "the camera's undistorted field reaches beyond 80° off the axis, and no plane picture holds that: crop the \
         picture or check the distortion coefficients"
    )]
    LensTooWide,
    /// An image larger than the adapter's textures.
    #[error(
        "a picture of {width_px}x{height_px} px with supersampling {supersampling} needs textures larger than this \
         adapter's {limit_px} px: lower the resolution or render.supersampling"
    )]
    ImageTooLarge {
        /// Image width in px.
        width_px: u32,
        /// Image height in px.
        height_px: u32,
        /// Samples a pixel and axis.
        supersampling: u32,
        /// The adapter's largest texture in px.
        limit_px: u32,
    },
    /// A mesh that cannot be drawn.
    #[error("the small body's mesh cannot be rendered: {problem}")]
    UnusableMesh {
        /// What is wrong with it.
        problem: String,
    },
    /// A setting outside its range.
    #[error("render.{0}")]
    Config(#[from] OutOfRange),
    /// The camera's pose or the Sun's direction is not a number.
    #[error("the view at {t_ns} ns holds a value that is not a finite number: check the trajectory")]
    ViewNotFinite {
        /// Time of the view.
        t_ns: i64,
    },
    /// The camera is inside the body.
    #[error("at {t_ns} ns the camera is inside the small body: move it out, or check the scale of the mesh")]
    CameraInsideBody {
        /// Time of the view.
        t_ns: i64,
    },
    /// The camera is below the ground or touches it.
    #[error(
        "at {t_ns} ns the camera is {clearance_m:.3} m above the ground, and {least_m} m is the least: end the sequence \
         earlier"
    )]
    CameraBelowGround {
        /// Time of the view.
        t_ns: i64,
        /// Height above the ground in m.
        clearance_m: f64,
        /// Least height in m.
        least_m: f64,
    },
    /// It is night.
    #[error(
        "at {t_ns} ns the Sun is below the horizon of the site, and the picture would be black: raise its elevation"
    )]
    SunBelowHorizon {
        /// Time of the view.
        t_ns: i64,
    },
}
