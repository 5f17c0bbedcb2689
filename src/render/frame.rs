//! What rendering yields.

/// A noise-free image with its truth; rows from the top, pixel centres at integers.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderedFrame {
    /// Width in px.
    pub width_px: u32,
    /// Height in px.
    pub height_px: u32,
    /// Radiance as I/F, averaged over each pixel.
    pub radiance: Vec<f32>,
    /// z-depth along the optical axis in m at each pixel's centre, NaN where nothing is hit.
    pub depth_m: Vec<f32>,
    /// Bits at each pixel's centre: [`RenderedFrame::BODY`], [`RenderedFrame::LIT`], [`RenderedFrame::TERMINATOR`].
    pub mask: Vec<u8>,
    /// On request, at each pixel's centre: unit normal in the reference axes, detail finer than the mesh included, and
    /// albedo; zeros where nothing is hit.
    pub surface: Option<Vec<[f32; 4]>>,
}

impl RenderedFrame {
    /// The ray of the pixel's centre hits the surface.
    pub const BODY: u8 = 1;
    /// The Sun shines there: it is above the smooth surface's horizon, and no shadow is cast.
    pub const LIT: u8 = 2;
    /// The incidence on the smooth surface is between 80° and 100°.
    pub const TERMINATOR: u8 = 4;

    /// Index of a pixel in the vectors.
    pub fn index(&self, u_px: u32, v_px: u32) -> usize {
        v_px as usize * self.width_px as usize + u_px as usize
    }
}
