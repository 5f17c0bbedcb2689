//! Known places of the map of Mars that is shipped.

use opnav::scene::{ElevationModel, MapPlace, Raster, RasterFile, RasterGeometry, RawLayout, SampleKind};
use std::path::{Path, PathBuf};

#[test]
fn known_heights_of_mars_lie_where_they_should() {
    let mola = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/datasets/mola"));
    let raster = Raster::read(&RasterFile::from_path("coprates.lbl"), mola).unwrap();
    let mut most_m = 0.0_f64;
    // From the global map: the highest and the lowest post of the piece, and one on a wall.
    let posts = [(-8.125, 296.125, 6121.0), (-13.875, 301.625 - 360.0, -5185.0), (-12.875, 299.875, 1210.0)];
    for (latitude_deg, longitude_deg, height_m) in posts {
        let height_at = |latitude_deg: f64| {
            let site = MapPlace::Degrees { latitude_deg, longitude_deg };
            ElevationModel::new(raster.clone(), Some(&site)).unwrap().summary().site_height_m
        };
        assert!((height_at(latitude_deg) - height_m).abs() < 1e-6);
        most_m = most_m.max((height_at(latitude_deg - 0.125) - height_m).abs());
    }
    assert!(most_m > 20.0, "half a pixel off is another height");
    let model = ElevationModel::new(raster, None).unwrap();
    assert_eq!(model.summary().height_range_m, [-5185.0, 6121.0]);
    assert_eq!(model.summary().filled_posts, 0);
    assert!((model.post_m() / 14_817.0 - 1.0).abs() < 2e-3);
}

/// Extremes of the whole planet; `OPNAV_MOLA` names the file `megt90n000cb.img`.
#[test]
fn the_highest_and_the_lowest_place_of_mars_lie_where_they_should() {
    let Some(path) = std::env::var_os("OPNAV_MOLA").map(PathBuf::from) else { return };
    let layout = RawLayout { columns: 1440, rows: 720, sample: SampleKind::I16Big, skip_bytes: 0 };
    let geometry = RasterGeometry::Degrees { px_per_deg: 4.0, first_longitude_deg: 0.125, first_latitude_deg: 89.875 };
    let file = RasterFile { layout: Some(layout), geometry, ..RasterFile::from_path(path) };
    let raster = Raster::read(&file, Path::new("")).unwrap();
    for (latitude_deg, longitude_deg, height_m) in [(17.375, -133.125, 21_134.0), (-32.875, 62.125, -8_068.0)] {
        let site = MapPlace::Degrees { latitude_deg, longitude_deg };
        let model = ElevationModel::new(raster.clone(), Some(&site)).unwrap();
        assert!((model.summary().site_height_m - height_m).abs() < 1e-6);
        assert_eq!(model.summary().height_range_m, [-8068.0, 21_134.0]);
    }
}
