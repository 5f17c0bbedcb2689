//! The ground truth of a data set, `truth/`: everything that an estimator may not see.

use super::{DatasetError, read_timed_table, write_text, write_timed_table};
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector2, Vector3};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// True state of the lander, EuRoC's `state_groundtruth`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LanderState {
    /// Time in ns.
    pub t_ns: i64,
    /// Pose of the lander in the site frame, m.
    pub site_from_lander: Isometry3<f64>,
    /// Velocity of the lander in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// Gyroscope bias in lander axes, rad/s.
    pub gyro_bias_rad_s: Vector3<f64>,
    /// Accelerometer bias in lander axes, m/s².
    pub accelerometer_bias_m_s2: Vector3<f64>,
}

/// True attitude and rate of a small body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsteroidState {
    /// Time in ns.
    pub t_ns: i64,
    /// Attitude: takes inertial axes to asteroid axes.
    pub asteroid_from_inertial: UnitQuaternion<f64>,
    /// Angular rate in asteroid axes, rad/s.
    pub rate_in_asteroid_rad_s: Vector3<f64>,
}

/// True inertia of a small body, `asteroid.json`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AsteroidInertia {
    /// Inertia tensor in asteroid axes (rows), to scale only.
    pub inertia: [[f64; 3]; 3],
}

impl AsteroidInertia {
    /// The tensor as a matrix.
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|row, column| self.inertia[row][column])
    }
}

/// A point on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landmark {
    /// Number, from 0.
    pub id: u32,
    /// Position in the reference frame (site or asteroid), m.
    pub position_m: Vector3<f64>,
}

/// Where a landmark falls in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LandmarkObservation {
    /// Time of the frame in ns.
    pub t_ns: i64,
    /// Number of the camera.
    pub camera: u32,
    /// The landmark.
    pub id: u32,
    /// Exact pixel.
    pub pixel_px: Vector2<f64>,
    /// Inside the picture and not hidden by the surface.
    pub visible: bool,
}

const STATE_HEADER: &str = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], \
q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], \
b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]";

/// Writes `truth/state.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_lander_states(root: &Path, states: &[LanderState]) -> Result<(), DatasetError> {
    let rows: Vec<(i64, [f64; 16])> = states.iter().map(|s| (s.t_ns, lander_columns(s))).collect();
    write_timed_table(&root.join("truth/state.csv"), STATE_HEADER, rows.iter().map(|(t, v)| (*t, v.as_slice())))
}

fn lander_columns(s: &LanderState) -> [f64; 16] {
    let (p, q) = (s.site_from_lander.translation, s.site_from_lander.rotation);
    let (v, g, a) = (s.lander_velocity_in_site_m_s, s.gyro_bias_rad_s, s.accelerometer_bias_m_s2);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, g.x, g.y, g.z, a.x, a.y, a.z]
}

/// Reads `truth/state.csv` under a data set's root.
///
/// # Errors
/// Names the file and line at fault.
pub fn read_lander_states(root: &Path) -> Result<Vec<LanderState>, DatasetError> {
    let path = root.join("truth/state.csv");
    let table = read_timed_table(&path, 16)?;
    let state = |(index, row): (usize, &super::TimedRow)| {
        let v = &row.values;
        let rotation = table.rotation(&path, index, 3)?;
        Ok(LanderState {
            t_ns: row.t_ns,
            site_from_lander: Isometry3::from_parts(Translation3::new(v[0], v[1], v[2]), rotation),
            lander_velocity_in_site_m_s: Vector3::from_column_slice(&v[7..10]),
            gyro_bias_rad_s: Vector3::from_column_slice(&v[10..13]),
            accelerometer_bias_m_s2: Vector3::from_column_slice(&v[13..16]),
        })
    };
    table.rows.iter().enumerate().map(state).collect()
}

/// Writes `truth/asteroid.csv` and `truth/asteroid.json` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_asteroid(root: &Path, states: &[AsteroidState], inertia: &AsteroidInertia) -> Result<(), DatasetError> {
    let rows: Vec<(i64, [f64; 7])> = states
        .iter()
        .map(|s| {
            let (q, w) = (s.asteroid_from_inertial, s.rate_in_asteroid_rad_s);
            (s.t_ns, [q.w, q.i, q.j, q.k, w.x, w.y, w.z])
        })
        .collect();
    let header = "t_ns,qw,qx,qy,qz,wx_rad_s,wy_rad_s,wz_rad_s";
    write_timed_table(&root.join("truth/asteroid.csv"), header, rows.iter().map(|(t, v)| (*t, v.as_slice())))?;
    let text = serde_json::to_string_pretty(inertia).expect("an inertia tensor is plain data");
    write_text(&root.join("truth/asteroid.json"), &text)
}

/// Reads `truth/asteroid.csv` and `truth/asteroid.json` under a data set's root.
///
/// # Errors
/// Names the file and line at fault.
pub fn read_asteroid(root: &Path) -> Result<(Vec<AsteroidState>, AsteroidInertia), DatasetError> {
    let path = root.join("truth/asteroid.csv");
    let table = read_timed_table(&path, 7)?;
    let state = |(index, row): (usize, &super::TimedRow)| {
        Ok(AsteroidState {
            t_ns: row.t_ns,
            asteroid_from_inertial: table.rotation(&path, index, 0)?,
            rate_in_asteroid_rad_s: Vector3::from_column_slice(&row.values[4..7]),
        })
    };
    let states = table.rows.iter().enumerate().map(state).collect::<Result<_, _>>()?;
    Ok((states, read_inertia(&root.join("truth/asteroid.json"))?))
}

fn read_inertia(path: &Path) -> Result<AsteroidInertia, DatasetError> {
    let text = super::table::read_text(path)?;
    let unusable = |problem: String| DatasetError::Unusable { path: path.into(), problem };
    let inertia: AsteroidInertia = serde_json::from_str(&text).map_err(|e| unusable(e.to_string()))?;
    let matrix = inertia.matrix();
    let symmetric = (matrix - matrix.transpose()).abs().max() <= 1e-9 * matrix.abs().max();
    if !symmetric || matrix.cholesky().is_none() {
        return Err(unusable("the inertia is not a symmetric positive definite tensor".into()));
    }
    Ok(inertia)
}

/// Writes `truth/landmarks.csv` and `truth/observations.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_landmarks(
    root: &Path,
    landmarks: &[Landmark],
    observations: &[LandmarkObservation],
) -> Result<(), DatasetError> {
    super::write_atomically(&root.join("truth/landmarks.csv"), |w| {
        writeln!(w, "id,x_m,y_m,z_m")?;
        for l in landmarks {
            writeln!(w, "{},{},{},{}", l.id, l.position_m.x, l.position_m.y, l.position_m.z)?;
        }
        Ok(())
    })?;
    super::write_atomically(&root.join("truth/observations.csv"), |w| {
        writeln!(w, "t_ns,cam,id,u_px,v_px,visible")?;
        for o in observations {
            let visible = u8::from(o.visible);
            writeln!(w, "{},{},{},{},{},{visible}", o.t_ns, o.camera, o.id, o.pixel_px.x, o.pixel_px.y)?;
        }
        Ok(())
    })
}
