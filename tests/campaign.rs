//! Tests of the room `campaign`.

mod landing;
