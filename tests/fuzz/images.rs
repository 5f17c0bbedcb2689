//! Folders of pictures: lists of frames, and the pictures themselves.

use super::campaign::Target;
use super::fuzzed;
use image::{DynamicImage, GrayImage, ImageBuffer, ImageFormat, Luma};
use opnav::dataset::truth::{OpticalFlow, encode_flow, read_flow};
use opnav::dataset::*;
use std::path::Path;

const FOV: CameraSource = CameraSource::HorizontalFov(1.0);

fn grey() -> DynamicImage {
    DynamicImage::ImageLuma8(GrayImage::from_fn(16, 12, |x, y| Luma([(x * 13 + y * 5) as u8])))
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).expect("a picture");
    bytes.into_inner()
}

fn list() -> Target {
    let names = ["x.png", "y.png", "z.png"];
    Target {
        name: "list_of_frames",
        file: "data.csv",
        beside: names.map(|name| (name, encoded(&grey(), ImageFormat::Png))).into(),
        whole: vec![
            b"#timestamp [ns],filename\n-5,x.png\n7,y.png\n8,z.png\n".to_vec(),
            b"0.000000005 z.png\n1305031102.175304 x.png\n".to_vec(),
        ],
        read: |folder| {
            let sequence = ImageSequence::open(folder, &FOV).map_err(|e| e.to_string())?;
            assert!(sequence.frames.windows(2).all(|w| w[0].t_ns < w[1].t_ns) && !sequence.frames.is_empty());
            Ok(())
        },
    }
}

/// A damaged picture beside a whole one: the folder opens, and the damaged one is named or has the camera's size.
fn picture(name: &'static str, whole: Vec<Vec<u8>>) -> Target {
    let beside = vec![("a2.png", encoded(&grey(), ImageFormat::Png)), ("a3.png", encoded(&grey(), ImageFormat::Png))];
    let read = |folder: &Path| {
        let sequence = ImageSequence::open(folder, &FOV).map_err(|e| e.to_string())?;
        let picture = sequence.load(&sequence.frames[0]).map_err(|e| e.to_string())?;
        assert_eq!(picture.dimensions(), sequence.sensor.camera.size_px());
        sequence.load(&sequence.frames[1]).map(drop).map_err(|e| e.to_string())
    };
    Target { name, file: "a1.png", beside, whole, read }
}

fn common(name: &'static str, format: ImageFormat) -> Target {
    let colour = DynamicImage::ImageRgb8(grey().to_rgb8());
    let mut whole = vec![encoded(&grey(), format), encoded(&colour, format)];
    if format != ImageFormat::Jpeg && format != ImageFormat::Bmp {
        whole.push(encoded(&DynamicImage::ImageLuma16(grey().to_luma16()), format));
    }
    picture(name, whole)
}

fn real() -> Target {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let values: Vec<f32> = (0..16 * 12).map(|i| if i == 5 { f32::NAN } else { i as f32 * 0.01 }).collect();
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).expect("a file");
    encoder.write_image::<tiff::encoder::colortype::Gray32Float>(16, 12, &values).expect("a picture");
    picture("real_tiff", vec![bytes.into_inner()])
}

fn depth() -> Target {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("7.tiff");
    write_depth_tiff(&path, 4, 3, &[1.5; 12]).expect("written");
    Target {
        name: "depth",
        file: "7.tiff",
        beside: vec![],
        whole: vec![std::fs::read(path).expect("read")],
        read: |folder| read_depth_tiff(&folder.join("7.tiff")).map(drop).map_err(|e| e.to_string()),
    }
}

fn mask() -> Target {
    let mask = ImageBuffer::from_fn(5, 4, |x, y| Luma([(x + 5 * y) as u8]));
    Target {
        name: "mask",
        file: "7.png",
        beside: vec![],
        whole: vec![encoded(&DynamicImage::ImageLuma8(mask), ImageFormat::Png)],
        read: |folder| read_mask_png(&folder.join("7.png")).map(drop).map_err(|e| e.to_string()),
    }
}

fn flow() -> Target {
    let flow = OpticalFlow { width_px: 3, height_px: 2, motion_px: vec![nalgebra::Vector2::new(0.5, -1.0); 6] };
    Target {
        name: "flow",
        file: "7.flo",
        beside: vec![],
        whole: vec![encode_flow(&flow)],
        read: |folder| read_flow(&folder.join("7.flo")).map(drop).map_err(|e| e.to_string()),
    }
}

fuzzed! {
    lists_of_frames: list();
    png: common("png", ImageFormat::Png);
    jpeg: common("jpeg", ImageFormat::Jpeg);
    tiff_whole: common("tiff", ImageFormat::Tiff);
    tiff_real: real();
    bmp: common("bmp", ImageFormat::Bmp);
    pnm: common("pnm", ImageFormat::Pnm);
    depth_images: depth();
    masks: mask();
    flow_fields: flow();
}
