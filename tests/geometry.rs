//! Tests of the room `geometry`.

mod camera;
mod so3;
