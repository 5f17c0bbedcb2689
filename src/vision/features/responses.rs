//! Room for an image's corner response.

use opencv::core::Mat;
use opencv::prelude::*;
use std::cell::Cell;

/// A smoothed image (grey levels / 255) and its smoothed corner response, 32-bit floating point, of the image's size.
#[derive(Default)]
pub struct Responses {
    pub(super) smooth: Mat,
    pub(super) response: Mat,
    pub(super) between: Mat,
}

/// Rooms larger than this are not kept for the next image, px.
const MOST_KEPT: usize = 1 << 24;

thread_local! {
    /// Room of the thread's last image: fresh memory costs about as much as the filters do.
    static ROOM: Cell<Responses> = Cell::default();
}

impl Responses {
    /// Room for an image, with whatever was there before.
    pub(super) fn take() -> Self {
        ROOM.take()
    }

    /// Gives the room back for the thread's next image.
    pub(super) fn put_back(self) {
        if self.smooth.total() <= MOST_KEPT {
            ROOM.set(self);
        }
    }
}
