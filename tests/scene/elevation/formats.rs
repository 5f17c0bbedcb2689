//! Files of elevation models: every format against heights that are known, and every fault against its message.

use opnav::scene::{
    ElevationConfig, ElevationModel, Georeference, MapPlace, Raster, RasterFile, RasterGeometry, RawLayout, SampleKind,
    SceneError,
};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use tiff::encoder::{TiffEncoder, colortype};
use tiff::tags::Tag;

const COLUMNS: usize = 37;
const ROWS: usize = 21;

fn height(column: usize, row: usize) -> f32 {
    100.0 * column as f32 - 7.0 * row as f32 + ((column * row) % 5) as f32 - 800.0
}

fn heights() -> Vec<f32> {
    (0..ROWS * COLUMNS).map(|i| height(i % COLUMNS, i / COLUMNS)).collect()
}

/// Keys of a GeoTIFF file: key, value; and keys with a double.
#[derive(Clone, Default)]
struct Geo {
    shorts: Vec<[u16; 2]>,
    doubles: Vec<(u16, f64)>,
    scale: Option<[f64; 3]>,
    tie: Option<[f64; 6]>,
    no_data: Option<&'static str>,
}

impl Geo {
    fn projected() -> Geo {
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

fn write_tiff<C: colortype::ColorType>(path: &Path, geo: Option<&Geo>, values: &[C::Inner])
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

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn read(folder: &TempDir, file: RasterFile) -> Result<Raster, SceneError> {
    Raster::read(&file, folder.path())
}

/// What a reader says of a file, which has to name it.
fn fault(folder: &TempDir, file: RasterFile) -> String {
    let name = file.path.display().to_string();
    let message = read(folder, file).expect_err("refused").to_string();
    assert!(message.contains(&name), "the file is not named: {message}");
    message
}

fn metres_per_px(path: &str, metres_per_px: f64) -> RasterFile {
    let geometry = RasterGeometry::Metres { metres_per_px, first_x_m: 0.0, first_y_m: 0.0 };
    RasterFile { geometry, ..RasterFile::from_path(path) }
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
fn tiled_tiff(columns: usize) -> Vec<u8> {
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

#[test]
fn pictures_have_a_scale_from_the_scenario() {
    let folder = folder();
    let grey: Vec<u16> = heights().iter().map(|h| (10.0 * (h + 2000.0)) as u16).collect();
    image::ImageBuffer::<image::Luma<u16>, _>::from_raw(COLUMNS as u32, ROWS as u32, grey)
        .unwrap()
        .save(folder.path().join("a.png"))
        .unwrap();
    let file = RasterFile { scale: 0.1, offset: -2000.0, ..metres_per_px("a.png", 2.5) };
    let raster = read(&folder, file).unwrap();
    assert!(raster.values.iter().zip(heights()).all(|(a, b)| (a - b).abs() < 1e-3));
    assert_eq!(raster.georeference, Georeference::Metres { first_m: [0.0, 0.0], step_m: [2.5, 2.5] });
    write_tiff::<colortype::Gray32Float>(&folder.path().join("a.tif"), None, &heights());
    assert_eq!(read(&folder, metres_per_px("a.tif", 2.5)).unwrap().values, heights());
    let flat = image::GrayImage::from_pixel(24, 16, image::Luma([77]));
    flat.save(folder.path().join("a.jpg")).unwrap();
    assert!(read(&folder, metres_per_px("a.jpg", 1.0)).unwrap().values.iter().all(|v| (v - 77.0).abs() <= 1.0));
    for name in ["a.png", "a.tif"] {
        let message = fault(&folder, RasterFile::from_path(name));
        assert!(message.contains("file.geometry.metres"), "{message}");
    }
}

#[test]
fn bare_samples_have_their_layout_from_the_scenario() {
    let folder = folder();
    let bytes: Vec<u8> = heights().iter().flat_map(|h| (*h as i16).to_be_bytes()).collect();
    std::fs::write(folder.path().join("a.img"), &bytes).unwrap();
    let layout = RawLayout { columns: COLUMNS, rows: ROWS, sample: SampleKind::I16Big, skip_bytes: 0 };
    let bare = |layout| RasterFile { layout: Some(layout), ..metres_per_px("a.img", 1.0) };
    assert_eq!(read(&folder, bare(layout)).unwrap().values, heights());
    // Read with the other byte order they are something else.
    let swapped = RawLayout { sample: SampleKind::I16Little, ..layout };
    assert_ne!(read(&folder, bare(swapped)).unwrap().values, heights());
    let too_large = fault(&folder, bare(RawLayout { rows: ROWS + 1, ..layout }));
    assert!(too_large.contains("1554 bytes") && too_large.contains("1628"), "{too_large}");
    let unstated = fault(&folder, RasterFile::from_path("a.img"));
    assert!(unstated.contains("file.layout"), "{unstated}");
}

/// A label as MOLA's are, with the given pointer and lines inside its objects.
fn label(pointer: &str, image: &str, map: &str) -> String {
    format!(
        "PDS_VERSION_ID = PDS3\r\nRECORD_BYTES = 100\r\n^IMAGE = {pointer}\r\nOBJECT = IMAGE\r\n  LINES = {ROWS}\r\n  \
         LINE_SAMPLES = {COLUMNS}\r\n{image}\r\nEND_OBJECT = IMAGE\r\nOBJECT = IMAGE_MAP_PROJECTION\r\n  \
         MAP_PROJECTION_TYPE = \"SIMPLE CYLINDRICAL\"\r\n  A_AXIS_RADIUS = 3396.0 <KM>\r\n  CENTER_LATITUDE = 0.0 \
         <DEGREE>\r\n  CENTER_LONGITUDE = 180.0 <DEGREE>\r\n  MAP_RESOLUTION = 4.0 <PIXEL/DEGREE>\r\n  \
         POSITIVE_LONGITUDE_DIRECTION = \"EAST\"\r\n{map}\r\nEND_OBJECT = IMAGE_MAP_PROJECTION\r\nEND\r\n"
    )
}

const OFFSETS: &str = "LINE_PROJECTION_OFFSET = 40.5\r\nSAMPLE_PROJECTION_OFFSET = 12.5";

#[test]
fn pds_images_with_a_detached_label_are_read() {
    let folder = folder();
    let image = "  SAMPLE_TYPE = MSB_INTEGER\r\n  SAMPLE_BITS = 16\r\n  SCALING_FACTOR = 0.5\r\n  OFFSET = -3";
    std::fs::write(folder.path().join("a.lbl"), label("\"A.IMG\"", image, OFFSETS)).unwrap();
    let bytes: Vec<u8> = heights().iter().flat_map(|h| (*h as i16).to_be_bytes()).collect();
    std::fs::write(folder.path().join("a.img"), &bytes).unwrap();
    let expected: Vec<f32> = heights().iter().map(|h| 0.5 * h - 3.0).collect();
    for name in ["a.lbl", "a.img"] {
        assert_eq!(read(&folder, RasterFile::from_path(name)).unwrap().values, expected, "{name}");
    }
    std::fs::write(folder.path().join("a.img"), &bytes[..bytes.len() - 1]).unwrap();
    let message = read(&folder, RasterFile::from_path("a.lbl")).unwrap_err().to_string();
    assert!(message.contains("a.img") && message.contains("cut short"), "{message}");
    std::fs::remove_file(folder.path().join("a.img")).unwrap();
    let message = read(&folder, RasterFile::from_path("a.lbl")).unwrap_err().to_string();
    assert!(message.contains("A.IMG"), "{message}");
}

#[test]
fn pds_images_with_an_attached_label_are_read() {
    let folder = folder();
    let image = "  SAMPLE_TYPE = PC_REAL\r\n  SAMPLE_BITS = 32\r\n  MISSING_CONSTANT = 16#FF7FFFFB#\r\n  \
                 LINE_PREFIX_BYTES = 3\r\n  LINE_SUFFIX_BYTES = 5";
    let mut values = heights();
    values[40] = f32::from_bits(0xFF7F_FFFB);
    for (pointer, start) in [("13", 1200), ("1101 <BYTES>", 1100)] {
        let mut bytes = label(pointer, image, OFFSETS).into_bytes();
        assert!(bytes.len() < start);
        bytes.resize(start, b' ');
        for row in values.chunks(COLUMNS) {
            bytes.extend([1; 3]);
            row.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
            bytes.extend([2; 5]);
        }
        std::fs::write(folder.path().join("a.img"), bytes).unwrap();
        let raster = read(&folder, RasterFile::from_path("a.img")).unwrap();
        assert!(raster.values[40].is_nan());
        assert!(raster.values.iter().zip(heights()).enumerate().all(|(i, (a, b))| i == 40 || *a == b));
    }
}

#[test]
fn both_ways_of_counting_pixels_in_labels_are_told_apart() {
    let folder = folder();
    std::fs::write(folder.path().join("a.img"), vec![0_u8; COLUMNS * ROWS]).unwrap();
    // As the data dictionary says, and as MOLA's labels count: one more.
    for (offset, bounds) in [(40.5, ""), (39.5, "\r\nMAXIMUM_LATITUDE = 10.0"), (40.5, "\r\nMAXIMUM_LATITUDE = 10.0")] {
        let map = format!("LINE_PROJECTION_OFFSET = {offset}\r\nSAMPLE_PROJECTION_OFFSET = 12.5{bounds}");
        std::fs::write(folder.path().join("a.lbl"), label("\"a.img\"", "SAMPLE_BITS = 8", &map)).unwrap();
        let raster = read(&folder, RasterFile::from_path("a.lbl")).unwrap();
        let Georeference::Degrees { first_deg, step_deg, radius_m } = raster.georeference else { panic!("degrees") };
        let counts_from_one = offset == 40.5 && !bounds.is_empty();
        let expected = if counts_from_one { [177.125, 9.875] } else { [176.875, 0.25 * offset] };
        assert_eq!((first_deg, step_deg, radius_m), (expected, [0.25, 0.25], 3_396_000.0), "{offset} {bounds}");
    }
}

#[test]
fn faults_name_the_file_and_the_cure() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let geotiff = |geo: Geo| {
        write_tiff::<colortype::Gray32Float>(&path("a.tif"), Some(&geo), &heights());
        fault(&folder, RasterFile::from_path("a.tif"))
    };
    let says = |message: String, cure: &str| assert!(message.contains(cure), "{message}");
    says(geotiff(Geo { shorts: vec![[1024, 3]], ..Geo::projected() }), "model type 3");
    says(geotiff(Geo { shorts: vec![[1025, 1]], ..Geo::projected() }), "reference system is unknown");
    says(geotiff(Geo { shorts: vec![[1024, 1], [3076, 9002]], ..Geo::projected() }), "not in metres");
    says(geotiff(Geo { shorts: vec![[1024, 2], [2054, 9101]], ..Geo::projected() }), "not in degrees");
    says(geotiff(Geo { tie: None, ..Geo::projected() }), "tie point");
    says(geotiff(Geo { scale: Some([0.0, 1.0, 0.0]), ..Geo::projected() }), "pixel scale is 0");
    says(geotiff(Geo { no_data: Some("none"), ..Geo::projected() }), "tag 42113");
    write_tiff::<colortype::Gray32Float>(&path("a.tif"), Some(&Geo::projected()), &vec![f32::NAN; COLUMNS * ROWS]);
    says(fault(&folder, RasterFile::from_path("a.tif")), "all are no-data");
    write_tiff::<colortype::Gray32Float>(&path("a.tif"), Some(&Geo::projected()), &heights());
    let whole = std::fs::read(path("a.tif")).unwrap();
    for share in 1..8 {
        std::fs::write(path("a.tif"), &whole[..whole.len() * share / 8]).unwrap();
        says(fault(&folder, RasterFile::from_path("a.tif")), "cut short");
    }
    let colours = image::RgbImage::new(9, 9);
    colours.save(path("rgb.tif")).unwrap();
    says(fault(&folder, metres_per_px("rgb.tif", 1.0)), "one band");
    std::fs::write(path("huge.tif"), tiled_tiff(2_000_000_000)).unwrap();
    says(fault(&folder, metres_per_px("huge.tif", 1.0)), "inconsistent sizes");
    std::fs::write(path("a.png"), b"\x89PNG\r\n\x1a\nnothing").unwrap();
    says(fault(&folder, metres_per_px("a.png", 1.0)), "cut short");
    says(fault(&folder, RasterFile::from_path("none.tif")), "could not read the raster");
    std::fs::write(path("empty.img"), b"").unwrap();
    says(fault(&folder, RasterFile::from_path("empty.img")), "no TIFF, PNG, JPEG or PDS");
    for (image, cure) in [
        ("SAMPLE_BITS = 12", "12 bits"),
        ("SAMPLE_TYPE = VAX_REAL\r\nSAMPLE_BITS = 32", "VAX_REAL"),
        ("SAMPLE_BITS = 8\r\nBANDS = 3", "3 bands"),
    ] {
        std::fs::write(path("a.lbl"), label("\"a.img\"", image, OFFSETS)).unwrap();
        says(fault(&folder, RasterFile::from_path("a.lbl")), cure);
    }
    std::fs::write(path("a.lbl"), label("\"a.img\"", "SAMPLE_BITS = 8", "")).unwrap();
    std::fs::write(path("a.img"), vec![0; COLUMNS * ROWS]).unwrap();
    says(fault(&folder, RasterFile::from_path("a.lbl")), "SAMPLE_PROJECTION_OFFSET");
    std::fs::write(path("a.lbl"), label("\"a.img\"", "SAMPLE_BITS = 8\r\nLINE_SUFFIX_BYTES = 1e300", OFFSETS)).unwrap();
    says(read(&folder, RasterFile::from_path("a.lbl")).unwrap_err().to_string(), "cut short");
}

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

#[test]
fn settings_outside_their_range_are_named() {
    let refused = |change: &dyn Fn(&mut ElevationConfig)| {
        let mut config = ElevationConfig::from_path("a.tif");
        change(&mut config);
        config.validate().expect_err("refused").to_string()
    };
    assert!(refused(&|c| c.file.scale = 0.0).starts_with("file.scale is 0"));
    assert!(refused(&|c| c.file.offset = f64::NAN).starts_with("file.offset is NaN"));
    assert!(refused(&|c| c.file.radius_m = Some(-1.0)).starts_with("file.radius_m is -1"));
    let flat = RasterGeometry::Metres { metres_per_px: 0.0, first_x_m: 0.0, first_y_m: 0.0 };
    assert!(refused(&|c| c.file.geometry = flat).starts_with("file.geometry.metres.metres_per_px is 0"));
    let none = RawLayout { columns: 0, rows: 9, sample: SampleKind::U8, skip_bytes: 0 };
    assert!(refused(&|c| c.file.layout = Some(none)).starts_with("file.layout.columns is 0"));
    assert_eq!(ElevationConfig::from_path("a.tif").validate().map_err(|e| e.to_string()), Ok(()));
}
