//! Scenarios, star catalogues, elevation models.

use super::campaign::Target;
use super::fuzzed;
use opnav::scene::{Raster, RasterFile, Scenario, Star};
use std::path::Path;

fn scenario() -> Target {
    let whole = [
        include_str!("../../datasets/mars_descent_small.toml"),
        include_str!("../../datasets/tumbling_small.toml"),
        include_str!("../../datasets/attachment_three_nodes.toml"),
    ];
    Target {
        name: "scenario",
        file: "scenario.toml",
        beside: vec![],
        whole: whole.map(|text| text.as_bytes().to_vec()).into(),
        read: |folder| {
            let path = folder.join("scenario.toml");
            let scenario = Scenario::read(&path, &[]).map_err(|e| e.to_string())?;
            // What is accepted comes back as it was.
            let text = scenario.to_toml();
            assert_eq!(Scenario::parse(&text, &path, &[]).expect("read back").to_toml(), text);
            Ok(())
        },
    }
}

fn stars() -> Target {
    Target {
        name: "stars",
        file: "stars.csv",
        beside: vec![],
        whole: vec![b"# bright\nra_deg,dec_deg,magnitude\n101.287,-16.716,-1.46\n95.988,-52.696,-0.74\n".to_vec()],
        read: |folder| Star::read_csv(&folder.join("stars.csv")).map(drop).map_err(|e| e.to_string()),
    }
}

fn raster(name: &str, folder: &Path) -> Result<(), String> {
    let raster = Raster::read(&RasterFile::from_path(name), folder).map_err(|e| e.to_string())?;
    assert_eq!(raster.values.len(), raster.rows() * raster.columns);
    Ok(())
}

const LABEL: &str = include_str!("../../datasets/mola/coprates.lbl");
const IMAGE: &[u8] = include_bytes!("../../datasets/mola/coprates.img");

fn label() -> Target {
    Target {
        name: "pds_label",
        file: "coprates.lbl",
        beside: vec![("coprates.img", IMAGE.to_vec())],
        whole: vec![LABEL.into()],
        read: |folder| raster("coprates.lbl", folder),
    }
}

/// A GeoTIFF of 4 × 3 posts in metres.
pub fn geotiff_bytes() -> Vec<u8> {
    use tiff::encoder::{TiffEncoder, colortype::Gray32Float};
    use tiff::tags::Tag;
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).expect("a file");
    let mut image = encoder.new_image::<Gray32Float>(4, 3).expect("a picture");
    let tags = image.encoder();
    tags.write_tag(Tag::Unknown(33_550), &[2.0, 2.0, 0.0][..]).expect("the scale");
    tags.write_tag(Tag::Unknown(33_922), &[0.0, 0.0, 0.0, 100.0, 200.0, 0.0][..]).expect("a tie point");
    let keys: [u16; 12] = [1, 1, 0, 2, 1024, 0, 1, 1, 1025, 0, 1, 1];
    tags.write_tag(Tag::Unknown(34_735), &keys[..]).expect("the keys");
    image.write_data(&[1.5; 12]).expect("heights");
    bytes.into_inner()
}

fn geotiff() -> Target {
    Target {
        name: "geotiff",
        file: "map.tif",
        beside: vec![],
        whole: vec![geotiff_bytes()],
        read: |folder| raster("map.tif", folder),
    }
}

fuzzed! {
    scenario_files: scenario();
    star_catalogues: stars();
    pds_labels: label();
    geotiffs: geotiff();
}
