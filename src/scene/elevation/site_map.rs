//! From the site frame to the posts of a raster.

use super::georeference::{Georeference, nearest_turn};
use super::map_site::MapPlace;
use nalgebra::{Matrix3, Rotation3, RowVector3, Vector3};

/// Maps places in the site frame to columns and rows of a raster and to heights above its datum.
///
/// On a plane map the site frame is the map, moved: x east, y north. On a sphere it is the tangent frame at the site, x
/// east, y north, z up, with the planet's curvature: a place in the frame has the latitude and longitude of its direction
/// from the planet's centre, and its height is its distance from the centre less the radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SiteMap {
    kind: Kind,
    columns: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Plane { site_column_row: [f64; 2], step_m: [f64; 2], site_height_m: f64 },
    Sphere(Sphere),
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Sphere {
    site_column_row: [f64; 2],
    step_rad: [f64; 2],
    site_latitude_rad: f64,
    radius_m: f64,
    site_height_m: f64,
    /// From the site frame to axes at the planet's centre: toward the equator at the site's meridian, east, pole.
    meridian_from_site: Rotation3<f64>,
}

/// A place on the raster.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Located {
    pub column: f64,
    pub row: f64,
    /// Height above the datum, m.
    pub height_m: f64,
    /// Derivatives of column, row and height (one a row) by the place.
    pub by_place: Matrix3<f64>,
}

impl SiteMap {
    /// Map with the site at a column and row, whose ground lies `site_height_m` above the datum.
    pub(super) fn new(
        georeference: &Georeference,
        columns: usize,
        site_column_row: [f64; 2],
        site_height_m: f64,
    ) -> Self {
        let kind = match (*georeference, georeference.place(site_column_row)) {
            (Georeference::Degrees { step_deg, radius_m, .. }, MapPlace::Degrees { latitude_deg, .. }) => {
                let site_latitude_rad = latitude_deg.to_radians();
                let (sin, cos) = site_latitude_rad.sin_cos();
                #[rustfmt::skip]
                let matrix = Matrix3::new(
                    0.0, -sin, cos,
                    1.0, 0.0, 0.0,
                    0.0, cos, sin,
                );
                Kind::Sphere(Sphere {
                    site_column_row,
                    step_rad: step_deg.map(f64::to_radians),
                    site_latitude_rad,
                    radius_m,
                    site_height_m,
                    meridian_from_site: Rotation3::from_matrix_unchecked(matrix),
                })
            }
            (Georeference::Metres { step_m, .. }, _) => Kind::Plane { site_column_row, step_m, site_height_m },
            (Georeference::Degrees { .. }, MapPlace::Metres { .. }) => unreachable!("a place is of its map's kind"),
        };
        SiteMap { kind, columns }
    }

    /// Where a place in the site frame (m) lies.
    pub(super) fn locate(&self, place_m: &Vector3<f64>) -> Located {
        match &self.kind {
            Kind::Plane { site_column_row: [column, row], step_m, site_height_m } => Located {
                column: column + place_m.x / step_m[0],
                row: row - place_m.y / step_m[1],
                height_m: site_height_m + place_m.z,
                by_place: Matrix3::from_diagonal(&Vector3::new(1.0 / step_m[0], -1.0 / step_m[1], 1.0)),
            },
            Kind::Sphere(sphere) => {
                let mut located = sphere.locate(place_m);
                located.column = nearest_turn(located.column, self.columns, sphere.step_rad[0].to_degrees());
                located
            }
        }
    }

    /// Height in the site frame at which the sphere through the site passes over (x, y), m; 0 on a plane.
    pub(super) fn curvature_m(&self, x_m: f64, y_m: f64) -> f64 {
        match &self.kind {
            Kind::Plane { .. } => 0.0,
            Kind::Sphere(sphere) => {
                let radius_m = sphere.radius_m + sphere.site_height_m;
                let away = x_m * x_m + y_m * y_m;
                -away / (radius_m + (radius_m * radius_m - away).max(0.0).sqrt())
            }
        }
    }

    /// Slope of that sphere at a distance from the site.
    pub(super) fn curvature_slope(&self, distance_m: f64) -> f64 {
        match &self.kind {
            Kind::Plane { .. } => 0.0,
            Kind::Sphere(sphere) => {
                let radius_m = sphere.radius_m + sphere.site_height_m;
                let sine = (distance_m / radius_m).min(0.7);
                sine / (1.0 - sine * sine).sqrt()
            }
        }
    }

    /// How much closer posts of a row come within 530 km of the site than at the site: meridians meet at the poles.
    pub(super) fn narrowing(&self) -> f64 {
        match &self.kind {
            Kind::Plane { .. } => 1.0,
            Kind::Sphere(sphere) => {
                let farthest_rad = (sphere.site_latitude_rad.abs() + 530e3 / sphere.radius_m).min(1.55);
                sphere.site_latitude_rad.cos() / farthest_rad.cos()
            }
        }
    }

    /// Whether column and row depend on the height above the ground.
    pub(super) fn is_plane(&self) -> bool {
        matches!(self.kind, Kind::Plane { .. })
    }

    /// Ground from a post to the next along a row and from row to row at the site, m.
    pub(super) fn post_m(&self) -> [f64; 2] {
        match &self.kind {
            Kind::Plane { step_m, .. } => step_m.map(f64::abs),
            Kind::Sphere(sphere) => {
                let radius_m = sphere.radius_m + sphere.site_height_m;
                let across = sphere.site_latitude_rad.cos().max(1e-3);
                [sphere.step_rad[0].abs() * radius_m * across, sphere.step_rad[1].abs() * radius_m]
            }
        }
    }
}

impl Sphere {
    fn locate(&self, place_m: &Vector3<f64>) -> Located {
        let from_center_m = place_m + Vector3::z() * (self.radius_m + self.site_height_m);
        let p = self.meridian_from_site * from_center_m;
        let across_m = p.x.hypot(p.y).max(1e-3);
        let range_m = across_m.hypot(p.z);
        let east = p.y.atan2(p.x);
        let north = p.z.atan2(across_m) - self.site_latitude_rad;
        let [column_rad, row_rad] = self.step_rad;
        let by_longitude = RowVector3::new(-p.y, p.x, 0.0) / (across_m * across_m);
        let by_latitude = RowVector3::new(-p.z * p.x / across_m, -p.z * p.y / across_m, across_m) / (range_m * range_m);
        let rows = [by_longitude / column_rad, -by_latitude / row_rad, p.transpose() / range_m];
        Located {
            column: self.site_column_row[0] + east / column_rad,
            row: self.site_column_row[1] - north / row_rad,
            height_m: range_m - self.radius_m,
            by_place: Matrix3::from_rows(&rows) * self.meridian_from_site.matrix(),
        }
    }
}
