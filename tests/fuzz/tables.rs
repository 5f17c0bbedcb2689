//! Tables of numbers.

use super::campaign::Target;
use super::fuzzed;
use opnav::dataset::truth::*;
use opnav::dataset::*;
use std::path::Path;

fn text(error: DatasetError) -> String {
    error.to_string()
}

fn table(name: &'static str, file: &'static str, whole: &[&str], read: fn(&Path) -> Result<(), String>) -> Target {
    let whole = whole.iter().map(|text| text.as_bytes().to_vec()).collect();
    Target { name, file, beside: vec![], whole, read }
}

fn timed() -> Target {
    let whole = ["#t_ns,a,b\n-5,1.5,-2e-3\n7,0.25,1e300\n", "1,2,3\r\n2,3,4\r\n"];
    table("timed_table", "a.csv", &whole, |folder| {
        let table = read_timed_table(&folder.join("a.csv"), 2).map_err(text)?;
        assert!(table.rows.windows(2).all(|w| w[0].t_ns < w[1].t_ns));
        let back = folder.join("back.csv");
        let rows = table.rows.iter().map(|row| (row.t_ns, row.values.as_slice()));
        write_timed_table(&back, "t_ns,a,b", rows).expect("written");
        assert_eq!(read_timed_table(&back, 2).expect("read back").rows, table.rows);
        Ok(())
    })
}

fn trajectory() -> Target {
    let whole =
        ["# t x y z qx qy qz qw\n-1.500000001 1 2 3 0 0 0 1\n0.25 -1e3 2 3 0.5 0.5 -0.5 0.5\n1e3 0 0 0 0 0 1 0\n"];
    table("trajectory", "a.tum", &whole, |folder| {
        let poses = read_tum(&folder.join("a.tum")).map_err(text)?;
        assert!(poses.windows(2).all(|w| w[0].t_ns < w[1].t_ns));
        let back = folder.join("back.tum");
        write_tum(&back, &poses).expect("written");
        let back = read_tum(&back).expect("read back");
        assert!(back.iter().zip(&poses).all(|(a, b)| a.t_ns == b.t_ns) && back.len() == poses.len());
        Ok(())
    })
}

const IMU_NOISE: &str = "sensor_type: imu\nrate_hz: 100.0\ngyroscope_noise_density: 4.8e-7\n\
                         accelerometer_noise_density: 5e-4\ngyroscope_random_walk: 1e-9\naccelerometer_random_walk: 1e-6\n";
const IMU_DATA: &str = "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n0,0.1,0.2,-0.3,1,2,3.7\n10000000,0,0,0,-1e-3,0,3.7\n";

fn inertial_data() -> Target {
    let target = table("inertial_data", "imu0/data.csv", &[IMU_DATA], |root| read_imu(root).map(drop).map_err(text));
    Target { beside: vec![("imu0/sensor.yaml", IMU_NOISE.into())], ..target }
}

fn inertial_noise() -> Target {
    let read = |root: &Path| read_imu(root).map(drop).map_err(text);
    let target = table("inertial_noise", "imu0/sensor.yaml", &[IMU_NOISE], read);
    Target { beside: vec![("imu0/data.csv", IMU_DATA.into())], ..target }
}

fn designated_point() -> Target {
    let whole = ["t_ns,u_px,v_px,var_u_px2,cov_uv_px2,var_v_px2\n12,511.25,400.5,0.25,0.01,0.3\n"];
    table("designated_point", "designated.csv", &whole, |root| read_designated(root).map(drop).map_err(text))
}

fn initial_state() -> Target {
    let whole = ["t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx,vy,vz,sp,sv,sa\n-3,3300,1,2,1,0,0,0,-56,-66,-90,577,5.77,0.02\n"];
    table("initial_state", "initial_state.csv", &whole, |root| read_initial_state(root).map(drop).map_err(text))
}

fn true_states() -> Target {
    let whole = ["#timestamp,p,p,p,q,q,q,q,v,v,v,b,b,b,b,b,b\n0,1,2,3,1,0,0,0,4,5,6,0,0,0,0,0,0\n\
                  5,1,2,3,0.6,0.8,0,0,4,5,6,1e-6,0,0,0,1e-4,0\n"];
    table("true_states", "truth/state.csv", &whole, |root| read_lander_states(root).map(drop).map_err(text))
}

const ASTEROID: &str = "t_ns,qw,qx,qy,qz,wx,wy,wz\n0,1,0,0,0,0.087,0.04,0.061\n1000000000,0.6,0.8,0,0,0.1,0,-0.1\n";
const INERTIA: &str = r#"{"inertia": [[0.85, 0.13, 0.17], [0.13, 1.37, -0.11], [0.17, -0.11, 1.0]]}"#;

fn asteroid_motion() -> Target {
    let read = |root: &Path| read_asteroid(root).map(drop).map_err(text);
    let target = table("asteroid_motion", "truth/asteroid.csv", &[ASTEROID], read);
    Target { beside: vec![("truth/asteroid.json", INERTIA.into())], ..target }
}

fn asteroid_inertia() -> Target {
    let read = |root: &Path| read_asteroid(root).map(drop).map_err(text);
    let target = table("asteroid_inertia", "truth/asteroid.json", &[INERTIA], read);
    Target { beside: vec![("truth/asteroid.csv", ASTEROID.into())], ..target }
}

fn landmarks() -> Target {
    let whole = ["id,x_m,y_m,z_m\n4,1,2.5,-3\n5,1e3,0,0\n"];
    table("landmarks", "truth/landmarks.csv", &whole, |root| read_landmarks(root).map(drop).map_err(text))
}

fn observations() -> Target {
    let whole = ["t_ns,cam,id,u_px,v_px,visible\n9,0,4,10.5,20.25,1\n9,0,5,10.5,20.25,0\n"];
    table("observations", "truth/observations.csv", &whole, |root| {
        read_observations(root, None).map(drop).map_err(text)
    })
}

const MAP: &str = "format = 1\n[[levels]]\npicture = \"o.png\"\nheights = \"h.tiff\"\nmetres_per_px = 0.5\nfirst_x_m = -1\n\
                   first_y_m = 1.5\nsigma_horizontal_m = 0.1\nsigma_vertical_m = 0.0\n";

fn ground_map() -> Target {
    let read = |root: &Path| {
        let map = read_ground_map(root).map_err(text)?;
        assert!(map.levels.iter().all(|l| l.metres_per_px > 0.0 && l.size_px() == (3, 2)) && !map.levels.is_empty());
        Ok(())
    };
    let mut picture = std::io::Cursor::new(Vec::new());
    image::GrayImage::new(3, 2).write_to(&mut picture, image::ImageFormat::Png).expect("a picture");
    let heights = encode_scalar_tiff(Path::new("h.tiff"), (3, 2), &[1.0; 6]).expect("heights");
    let beside = vec![("o.png", picture.into_inner()), ("h.tiff", heights)];
    Target { beside, ..table("ground_map", "map.toml", &[MAP], read) }
}

fuzzed! {
    timed_tables: timed();
    trajectories: trajectory();
    inertial_samples: inertial_data();
    inertial_units: inertial_noise();
    designated_points: designated_point();
    initial_states: initial_state();
    lander_states: true_states();
    asteroid_states: asteroid_motion();
    asteroid_tensors: asteroid_inertia();
    landmark_places: landmarks();
    landmark_sightings: observations();
    ground_maps: ground_map();
}
