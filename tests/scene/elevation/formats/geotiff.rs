//! GeoTIFF: where a file says that its posts lie, in every kind of sample, in strips and in tiles.

use super::{COLUMNS, ROWS, folder, height, heights, metres_per_px, read};
use opnav::scene::{ElevationModel, Georeference, MapPlace, RasterFile};
use std::path::Path;
use tiff::encoder::{TiffEncoder, colortype};
use tiff::tags::Tag;

/// Keys of a GeoTIFF file: key, value; and keys with a double.
#[derive(Clone, Default)]
pub struct Geo {
    pub shorts: Vec<[u16; 2]>,
    pub doubles: Vec<(u16, f64)>,
    pub scale: Option<[f64; 3]>,
    pub tie: Option<[f64; 6]>,
    pub no_data: Option<&'static str>,
}

impl Geo {
    pub fn projected() -> Geo {
        Geo {
            shorts: vec![[1024, 1], [1025, 1], [3076, 9001]],
            scale: Some([20.0, 10.0, 0.0]),
            tie: Some([0.0, 0.0, 0.0, 5000.0, -300.0, 0.0]),
            ..Geo::default()
        }
    }

    fn degrees(raster_type: u16) -> Geo {
        Geo {
            shorts: vec![[1024, 2], [1025, raster_type], [2054, 9102]],
            doubles: vec![(2057, 3_396_000.0)],
            scale: Some([0.25, 0.25, 0.0]),
            tie: Some([0.0, 0.0, 0.0, 140.0, 12.0, 0.0]),
            ..Geo::default()
        }
    }

    fn directory(&self) -> Vec<u16> {
        let count = (self.shorts.len() + self.doubles.len()) as u16;
        let shorts = self.shorts.iter().map(|[key, value]| [*key, 0, 1, *value]);
        let doubles = self.doubles.iter().zip(0..).map(|((key, _), i)| [*key, 34736, 1, i]);
        [[1, 1, 1, count]].into_iter().chain(shorts).chain(doubles).flatten().collect()
    }
}

pub fn write_tiff<C: colortype::ColorType>(path: &Path, geo: Option<&Geo>, values: &[C::Inner])
where
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut encoder = TiffEncoder::new(std::fs::File::create(path).unwrap()).unwrap();
    let mut image = encoder.new_image::<C>(COLUMNS as u32, ROWS as u32).unwrap();
    image.rows_per_strip(4).unwrap();
    if let Some(geo) = geo {
        let directory = image.encoder();
        directory.write_tag(Tag::GeoKeyDirectoryTag, &geo.directory()[..]).unwrap();
        let doubles: Vec<f64> = geo.doubles.iter().map(|(_, value)| *value).collect();
        if !doubles.is_empty() {
            directory.write_tag(Tag::GeoDoubleParamsTag, &doubles[..]).unwrap();
        }
        if let Some(scale) = geo.scale {
            directory.write_tag(Tag::ModelPixelScaleTag, &scale[..]).unwrap();
        }
        if let Some(tie) = geo.tie {
            directory.write_tag(Tag::ModelTiepointTag, &tie[..]).unwrap();
        }
        if let Some(no_data) = geo.no_data {
            directory.write_tag(Tag::GdalNodata, no_data).unwrap();
        }
    }
    image.write_data(values).unwrap();
}

#[test]
fn projected_geotiff_files_of_every_sample_kind_are_read() {
    let folder = folder();
    let path = folder.path().join("a.tif");
    let check = |expected: &[f32]| {
        let raster = read(&folder, RasterFile::from_path("a.tif")).unwrap();
        assert_eq!((raster.columns, raster.rows()), (COLUMNS, ROWS));
        assert_eq!(raster.values, expected);
        let expected = Georeference::Metres { first_m: [5010.0, -305.0], step_m: [20.0, 10.0] };
        assert_eq!(raster.georeference, expected, "the tie point is a pixel's corner");
    };
    write_tiff::<colortype::Gray32Float>(&path, Some(&Geo::projected()), &heights());
    check(&heights());
    let whole: Vec<i16> = heights().iter().map(|h| *h as i16).collect();
    write_tiff::<colortype::GrayI16>(&path, Some(&Geo::projected()), &whole);
    check(&heights());
    let positive: Vec<u16> = whole.iter().map(|h| (h + 2000) as u16).collect();
    write_tiff::<colortype::Gray16>(&path, Some(&Geo::projected()), &positive);
    check(&positive.iter().map(|h| f32::from(*h)).collect::<Vec<_>>());
}

#[test]
fn a_pixel_is_an_area_or_a_point() {
    let folder = folder();
    let path = folder.path().join("a.tif");
    let mut found = Vec::new();
    for raster_type in [1, 2] {
        write_tiff::<colortype::Gray32Float>(&path, Some(&Geo::degrees(raster_type)), &heights());
        let raster = read(&folder, RasterFile::from_path("a.tif")).unwrap();
        let half_deg = if raster_type == 1 { 0.125 } else { 0.0 };
        let (latitude_deg, longitude_deg) = (12.0 - 0.25 * 8.0 - half_deg, 140.0 + 0.25 * 30.0 + half_deg);
        let site = MapPlace::Degrees { latitude_deg, longitude_deg };
        let model = ElevationModel::new(raster, Some(&site)).unwrap();
        assert!((model.summary().site_height_m - f64::from(height(30, 8))).abs() < 1e-6);
        found.push(model.summary().post_m);
        // Taken the other way it is half a pixel off, which shows: 50 m eastward.
        let wrong = MapPlace::Degrees { latitude_deg, longitude_deg: longitude_deg + 0.125 };
        let raster = read(&folder, RasterFile::from_path("a.tif")).unwrap();
        let off = ElevationModel::new(raster, Some(&wrong)).unwrap().summary().site_height_m;
        assert!((off - f64::from(height(30, 8))).abs() > 40.0);
    }
    let expected_m = 0.25_f64.to_radians() * 3_396_000.0;
    assert!((found[0][1] / expected_m - 1.0).abs() < 1e-3, "the keys' radius counts: {found:?}");
}

#[test]
fn equirectangular_metres_become_degrees() {
    let folder = folder();
    let degree_m = 3_396_190.0_f64.to_radians();
    let geo = Geo {
        shorts: vec![[1024, 1], [1025, 1], [3075, 17], [3076, 9001]],
        doubles: vec![(2057, 3_396_190.0), (3078, 60.0), (3088, 180.0)],
        scale: Some([0.5 * degree_m, degree_m, 0.0]),
        tie: Some([0.0, 0.0, 0.0, -20.0 * 0.5 * degree_m, 30.0 * degree_m, 0.0]),
        no_data: None,
    };
    write_tiff::<colortype::Gray32Float>(&folder.path().join("a.tif"), Some(&geo), &heights());
    let raster = read(&folder, RasterFile::from_path("a.tif")).unwrap();
    let Georeference::Degrees { first_deg, step_deg, radius_m } = raster.georeference else { panic!("degrees") };
    let near = |a: [f64; 2], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(near(first_deg, [160.5, 29.5]) && near(step_deg, [1.0, 1.0]), "{first_deg:?} {step_deg:?}");
    assert_eq!(radius_m, 3_396_190.0);
}

#[test]
fn no_data_of_a_geotiff_file_is_unknown() {
    let folder = folder();
    let mut values = heights();
    values[5] = -3.402_823_4e38;
    values[6] = f32::NAN;
    values[7] = -9999.0;
    let geo = Geo { no_data: Some("-3.40282346e+38"), ..Geo::projected() };
    write_tiff::<colortype::Gray32Float>(&folder.path().join("a.tif"), Some(&geo), &values);
    let file = RasterFile { no_data: vec![-9999.0], ..RasterFile::from_path("a.tif") };
    let raster = read(&folder, file).unwrap();
    let unknown: Vec<usize> = (0..values.len()).filter(|i| raster.values[*i].is_nan()).collect();
    assert_eq!(unknown, [5, 6, 7]);
    let model = ElevationModel::new(raster, None).unwrap();
    assert_eq!(model.summary().filled_posts, 3);
}

/// A TIFF file of 16 × 16 tiles, written out by hand; its header says that it has `columns` columns.
pub fn tiled_tiff(columns: usize) -> Vec<u8> {
    let (across, down) = (COLUMNS.div_ceil(16), ROWS.div_ceil(16));
    let tiles = across * down;
    let data_at = 8 + 2 + 10 * 12 + 4;
    let (offsets_at, counts_at) = (data_at, data_at + 4 * tiles);
    let tiles_at = counts_at + 4 * tiles;
    let mut bytes = b"II*\0\x08\0\0\0\x0a\0".to_vec();
    let mut entry = |tag: u16, kind: u16, count: usize, value: usize| {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend((count as u32).to_le_bytes());
        bytes.extend((value as u32).to_le_bytes());
    };
    entry(256, 4, 1, columns);
    entry(257, 4, 1, ROWS);
    entry(258, 4, 1, 16);
    entry(259, 4, 1, 1);
    entry(262, 4, 1, 1);
    entry(322, 4, 1, 16);
    entry(323, 4, 1, 16);
    entry(324, 4, tiles, offsets_at);
    entry(325, 4, tiles, counts_at);
    entry(339, 4, 1, 2);
    bytes.extend([0; 4]);
    (0..tiles).for_each(|t| bytes.extend(((tiles_at + 512 * t) as u32).to_le_bytes()));
    (0..tiles).for_each(|_| bytes.extend(512_u32.to_le_bytes()));
    for (tile, k) in (0..tiles).flat_map(|t| (0..256).map(move |k| (t, k))) {
        let (column, row) = ((tile % across) * 16 + k % 16, (tile / across) * 16 + k / 16);
        let value = if column < COLUMNS && row < ROWS { height(column, row) as i16 } else { 0 };
        bytes.extend(value.to_le_bytes());
    }
    bytes
}

#[test]
fn tiles_are_read_as_strips_are() {
    let folder = folder();
    std::fs::write(folder.path().join("tiled.tif"), tiled_tiff(COLUMNS)).unwrap();
    let raster = read(&folder, metres_per_px("tiled.tif", 2.0)).unwrap();
    assert_eq!(raster.values, heights());
}
