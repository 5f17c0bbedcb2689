//! Tests of the room `navigation::landing`.

#[path = "landing/descent.rs"]
mod descent;

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
        print!("{k}: {:.2} {:.2}; ", m(&|e| e.nees()), m(&|e| e.own));
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
