//! What there is to draw: ground or body, with its light.

use crate::scene::{SmallBody, Terrain};

/// What images are taken of.
#[derive(Debug, Clone, Copy)]
pub enum World<'a> {
    /// Terrain; the views' reference frame is the site.
    Terrain(&'a Terrain),
    /// A small body; the views' reference frame is the asteroid.
    Body(&'a SmallBody),
}
