//! Tests of the room `navigation::landing`.

#[path = "landing/descent.rs"]
mod descent;
#[path = "landing/flight.rs"]
mod flight;

use descent::{Case, END_S, Epoch, Mistake, REFERENCE, fly};
use opnav::navigation::landing::FilterKind;
use opnav::navigation::landmark::Selector;
use rayon::prelude::*;

fn fly_all(case: &Case, runs: u64) -> Vec<Vec<Epoch>> {
    (0..runs).into_par_iter().map(|run| fly(case, run)).collect()
}

fn rms(epochs: &[&Epoch], component: usize) -> f64 {
    (epochs.iter().map(|e| e.error[component].powi(2)).sum::<f64>() / epochs.len() as f64).sqrt()
}

fn print(name: &str, runs: &[Vec<Epoch>]) {
    let last: Vec<&Epoch> = runs.iter().map(|r| &r[r.len() - 1]).collect();
    let converged = last.iter().filter(|e| e.converged()).count();
    let p = |k: usize| 3.0 * (last.iter().map(|e| e.covariance[(k, k)]).sum::<f64>() / last.len() as f64).sqrt();
    let r: Vec<f64> = (0..9).map(|k| 3.0 * rms(&last, k)).collect();
    let mut nees: Vec<f64> = (30..=182)
        .map(|k| runs.iter().map(|r| r[k.min(r.len() - 1)].nees()).sum::<f64>() / runs.len() as f64)
        .collect();
    for k in [0, 1, 2, 5, 10, 20, 30, 60, 90, 120, 150, 170, 182, 190, 198] {
        let m =
            |f: &dyn Fn(&Epoch) -> f64| runs.iter().map(|r| f(&r[k.min(r.len() - 1)])).sum::<f64>() / runs.len() as f64;
        print!("{k}: {:.2} {:.2}; ", m(&|e| e.nees()), 0.0);
    }
    println!();
    let mean = nees.iter().sum::<f64>() / nees.len() as f64;
    nees.sort_by(f64::total_cmp);
    println!(
        "{name}: converged {converged}/{} x {:.3} y {:.3} ({:.3}) z {:.2} ({:.2}) v {:.3} {:.3} {:.3} roll {:.4} pitch {:.4} yaw {:.3} (P 1s {:.3}) NEES {:.3} [{:.3} {:.3}]",
        runs.len(),
        r[0],
        r[1],
        p(0),
        r[2],
        p(2),
        r[3],
        r[4],
        r[5],
        r[6].to_degrees(),
        r[7].to_degrees(),
        r[8].to_degrees(),
        p(8).to_degrees() / 3.0,
        mean,
        nees[0],
        nees[nees.len() - 1]
    );
}

#[test]
#[ignore]
fn table() {
    let runs = std::env::var("RUNS").map_or(100, |r| r.parse().unwrap());
    for selector in [Selector::DepthError, Selector::None] {
        print(&format!("hybrid {selector:?}"), &fly_all(&Case { selector, ..REFERENCE }, runs));
    }
    let _ = END_S;
}

#[test]
#[ignore]
fn sweep() {
    use flight::{FLIGHT, Flight};
    use opnav::navigation::landing::{LandingConfig, navigate};
    let runs: u64 = std::env::var("RUNS").map_or(20, |r| r.parse().unwrap());
    for relief in [1.0] {
        let inputs: Vec<_> = (0..runs).map(|run| flight::fly(&Flight { relief, ..FLIGHT }, run)).collect();
        for selector in [Selector::None, Selector::DepthError] {
            for landmarks in [1] {
                for reselect_after in [3, 8] {
                    let config = LandingConfig {
                        selector,
                        unknown_landmarks: landmarks,
                        reselect_after,
                        sigma_floor_px: 0.1,
                        ..LandingConfig::default()
                    };
                    let all: Vec<_> = inputs.par_iter().map(|i| navigate(i, &config, &|_| ())).collect();
                    let mut rows = vec![];
                    let mut gated = 0;
                    let mut used = 0;
                    for r in &all {
                        let r = r.as_ref().unwrap();
                        gated += r.gated;
                        used += r.used;
                        rows.push(
                            r.epochs
                                .iter()
                                .map(|e| {
                                    let t = flight::truth_at_ns(e.t_ns);
                                    Epoch {
                                        error: descent::pose_error(
                                            &t,
                                            &e.site_from_lander,
                                            &e.lander_velocity_in_site_m_s,
                                        ),
                                        covariance: e.covariance,
                                    }
                                })
                                .collect::<Vec<_>>(),
                        );
                    }
                    let at = |k: usize| {
                        let es: Vec<&Epoch> = rows.iter().map(|r| &r[k]).collect();
                        let n = es.iter().map(|e| e.nees()).sum::<f64>() / es.len() as f64;
                        let pz = (es.iter().map(|e| e.covariance[(2, 2)]).sum::<f64>() / es.len() as f64).sqrt();
                        let px = (es.iter().map(|e| e.covariance[(0, 0)] + e.covariance[(1, 1)]).sum::<f64>()
                            / es.len() as f64)
                            .sqrt();
                        let h = (rms(&es, 0).powi(2) + rms(&es, 1).powi(2)).sqrt();
                        format!(
                            "[h {h:.3} ({px:.3}) z {:.3} ({pz:.3}) v {:.3} {:.3} tilt {:.4} nees {n:.2}]",
                            rms(&es, 2),
                            rms(&es, 3).hypot(rms(&es, 4)),
                            rms(&es, 5),
                            rms(&es, 6).hypot(rms(&es, 7)).to_degrees()
                        )
                    };
                    println!(
                        "relief {relief} {selector:?} {landmarks} x {reselect_after}: used {used} gated {gated} f20 {} f40 {} f59 {} end {}",
                        at(20),
                        at(40),
                        at(59),
                        at(rows[0].len() - 1)
                    );
                    if selector == Selector::None {
                        break;
                    }
                }
                if selector == Selector::None {
                    break;
                }
            }
        }
    }
}
