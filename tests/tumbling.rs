//! Tests of the room `tumbling`.
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use opnav::navigation::tumbling::*;

const PAPER: InertiaRatios = InertiaRatios([0.85, 1.37, 0.13, 0.17, -0.11]);
fn paper_rate() -> Vector3<f64> {
    Vector3::new(5.0, 2.3, 3.5) * 1f64.to_radians()
}

#[test]
fn explore() {
    for arc_s in [60.0, 120.0, 300.0, 600.0] {
        for (kf, lp) in
            [(None, None), (Some(30f64.to_radians()), None), (Some(30f64.to_radians()), Some(25f64.to_radians()))]
        {
            let design = ArcDesign {
                arc_s,
                interval_s: 1.0,
                sigma_rad: 0.05f64.to_radians(),
                keyframe_turn_rad: kf,
                loop_turn_rad: lp,
            };
            let b = arc_bound(&paper_rate(), &PAPER, &design, 10.0).unwrap();
            println!(
                "{arc_s} {:?} {} {:.4?} {:.5?} {:.4?} {}",
                kf.is_some(),
                b.pairs,
                b.rate_sigma_rad_s.unwrap().map(f64::to_degrees),
                b.inertia_sigma.unwrap(),
                b.information,
                b.undetermined.len()
            );
        }
    }
    for nut in [0.0, 1.0f64, 5.0] {
        let n = nut.to_radians();
        for ax in 0..3 {
            let mut w = [0.0; 3];
            w[ax] = 5.0 * n.cos();
            w[(ax + 1) % 3] = 5.0 * n.sin();
            let design = ArcDesign {
                arc_s: 60.0,
                interval_s: 1.0,
                sigma_rad: 0.05f64.to_radians(),
                keyframe_turn_rad: None,
                loop_turn_rad: None,
            };
            let b = arc_bound(
                &(Vector3::from(w) * 1f64.to_radians()),
                &InertiaRatios([0.85, 1.37, 0., 0., 0.]),
                &design,
                10.0,
            )
            .unwrap();
            println!("{nut} {ax} {:.4?} {:?}", b.information, b.undetermined);
        }
    }
    let s = SpinState { asteroid_from_inertial: UnitQuaternion::identity(), rate_in_asteroid_rad_s: paper_rate() };
    let p = propagate(&s, &PAPER, &[0.0, 60.0, 600.0].map(|x: f64| x)).unwrap();
    for x in &p {
        println!("{:?} {:?}", x.state.asteroid_from_inertial, x.state.rate_in_asteroid_rad_s * 1f64.to_degrees());
    }
    let _ = Quaternion::new(1.0, 0., 0., 0.);
}
