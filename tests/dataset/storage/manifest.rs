//! The list of every file of a data set.

use crate::dataset::{folder, put};
use opnav::dataset::*;

#[test]
fn the_manifest_knows_every_file_but_itself() {
    let dir = folder();
    put(dir.path(), "cam0/data.csv", "abc");
    put(dir.path(), "scenario.toml", "");
    for _ in 0..2 {
        let manifest = Manifest::new("llvmpipe", 3, &[CameraId::single(0)]);
        write_manifest(dir.path(), manifest, &Checksums::new()).expect("write");
        let manifest = read_manifest(dir.path()).expect("read");
        assert_eq!((manifest.frame_count, manifest.adapter.as_str()), (3, "llvmpipe"));
        assert_eq!(manifest.cameras, ["cam0"]);
        assert_eq!(manifest.sha256.keys().collect::<Vec<_>>(), ["cam0/data.csv", "scenario.toml"]);
        // FIPS 180-2, the first example
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(manifest.sha256["cam0/data.csv"], abc);
    }
}
