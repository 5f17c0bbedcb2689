//! The map of a PDS image.

use super::file_raster::FileGeoreference;
use super::pds_label::Label;

/// Where the posts lie; `None` if the label describes no map.
///
/// The projection's origin lies `LINE_PROJECTION_OFFSET` lines below and `SAMPLE_PROJECTION_OFFSET` samples right of the
/// centre of the first pixel, as the PDS data dictionary says. Some data sets (MOLA's among them) count from a pixel above
/// and left of it instead; the label's own bounds tell which, for they are the outer edges or the centres of its pixels.
pub(super) fn georeference(label: &Label) -> Result<Option<FileGeoreference>, String> {
    let Some(projection) = label.text("MAP_PROJECTION_TYPE") else { return Ok(None) };
    let number =
        |key: &str| label.number(key).ok_or(format!("its label lacks {key}: state file.geometry in the scenario"));
    let origin = [number("SAMPLE_PROJECTION_OFFSET")?, number("LINE_PROJECTION_OFFSET")?];
    if label.number("MAP_PROJECTION_ROTATION").is_some_and(|turn| turn != 0.0) {
        return Err("its map is rotated: resample it north up".into());
    }
    match projection.to_uppercase().replace('_', " ").as_str() {
        name @ ("SIMPLE CYLINDRICAL" | "EQUIRECTANGULAR") => cylindrical(label, origin, name).map(Some),
        _ => {
            let step_m = metres_per_pixel(label)?;
            let first_m = [-origin[0] * step_m, origin[1] * step_m];
            Ok(Some(FileGeoreference::Metres { first_m, step_m: [step_m; 2] }))
        }
    }
}

fn cylindrical(label: &Label, mut origin: [f64; 2], name: &str) -> Result<FileGeoreference, String> {
    let radius_m = label.number("A_AXIS_RADIUS").map(|km| 1000.0 * km);
    let px_per_deg = match label.number("MAP_RESOLUTION") {
        Some(px_per_deg) => px_per_deg,
        None => {
            radius_m.ok_or("its label lacks MAP_RESOLUTION and A_AXIS_RADIUS: state file.geometry")?.to_radians()
                / metres_per_pixel(label)?
        }
    };
    if !px_per_deg.is_finite() || px_per_deg <= 0.0 {
        return Err(format!("MAP_RESOLUTION is {px_per_deg} in its label: state file.geometry in the scenario"));
    }
    let latitude_deg = label.number("CENTER_LATITUDE").unwrap_or(0.0);
    let is_equidistant = name == "EQUIRECTANGULAR";
    let shrink = if is_equidistant { latitude_deg.to_radians().cos() } else { 1.0 };
    let origin_latitude_deg = if is_equidistant { 0.0 } else { latitude_deg };
    let step_deg = 1.0 / px_per_deg;
    if let Some(top_deg) = label.number("MAXIMUM_LATITUDE") {
        let from_top = |shift: f64| (origin_latitude_deg + (origin[1] - shift) * step_deg - top_deg) * px_per_deg;
        // Half a pixel below the bound, or on it.
        let misfit = |shift: f64| (from_top(shift) + 0.5).abs().min(from_top(shift).abs() + 0.1);
        if misfit(1.0) + 0.2 < misfit(0.0) {
            origin = origin.map(|o| o - 1.0);
        }
    }
    let eastward = if label.text("POSITIVE_LONGITUDE_DIRECTION") == Some("WEST") { -1.0 } else { 1.0 };
    let step_deg = [step_deg / shrink, step_deg];
    let center_deg = eastward * label.number("CENTER_LONGITUDE").unwrap_or(0.0);
    let first_deg = [center_deg - origin[0] * step_deg[0], origin_latitude_deg + origin[1] * step_deg[1]];
    Ok(FileGeoreference::Degrees { first_deg, step_deg, radius_m })
}

fn metres_per_pixel(label: &Label) -> Result<f64, String> {
    let (scale, unit) =
        label.number_with_unit("MAP_SCALE").ok_or("its label lacks MAP_SCALE: state file.geometry in the scenario")?;
    let metres = if unit.starts_with("KM") || unit.starts_with("KILOMET") { 1000.0 * scale } else { scale };
    if metres.is_finite() && metres > 0.0 {
        Ok(metres)
    } else {
        Err(format!("MAP_SCALE is {scale} in its label: correct it"))
    }
}
