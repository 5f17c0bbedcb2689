//! Pictures with their tracks drawn over them.

use image::{GrayImage, Rgb};
use nalgebra::Vector2;
use opnav::observations::TrackObservation;
use opnav::report::{contact_sheet, draw_tracks};
use std::collections::HashMap;

fn observation(track_id: u64, u_px: f64, v_px: f64) -> TrackObservation {
    TrackObservation { t_ns: 0, track_id, pixel_px: Vector2::new(u_px, v_px), sigma_px: 0.1, response: 1e-7 }
}

#[test]
fn overlays_show_tracks_and_the_designated_point() {
    let picture = GrayImage::new(64, 48);
    let here = observation(5, 30.0, 20.0);
    let point = observation(0, 50.0, 30.0);
    let previous = HashMap::from([(5, Vector2::new(10.0, 20.0))]);
    let canvas = draw_tracks(&picture, &[here, point], &previous, Some(&point));
    assert_eq!(canvas.dimensions(), (64, 48));
    assert_ne!(*canvas.get_pixel(20, 20), Rgb([0, 0, 0]), "the flow line");
    assert_eq!(*canvas.get_pixel(50, 30), Rgb([255, 60, 60]), "the cross");
    assert_eq!(*canvas.get_pixel(3, 3), Rgb([0, 0, 0]));
    let sheet = contact_sheet(&[canvas.clone(), canvas.clone(), canvas], 2, 32);
    assert_eq!(sheet.dimensions(), (68, 52));
}
