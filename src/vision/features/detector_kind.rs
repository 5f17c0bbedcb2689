//! The list of all detectors.

use super::detector::Detector;
use super::harris::Harris;
use super::shi_tomasi::ShiTomasi;
use crate::vision::registry::registry;

registry! {
    /// What finds features.
    DetectorKind of Detector:
    Harris "harris" = Harris, "Determinant and trace of the structure tensor (Harris and Stephens 1988).";
    ShiTomasi "shi-tomasi" = ShiTomasi, "Least eigenvalue of the structure tensor (Shi and Tomasi 1994).";
}
