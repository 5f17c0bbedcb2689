//! Results that cannot be judged are refused with the file, the line and the cure.

use super::bench::{Bench, SECOND_NS, landing_bench, landing_csv, perfect_landing};
use opnav::evaluation::*;
use std::fs;

fn complaint(bench: &Bench, words: &[&str]) {
    let error = bench.evaluate().expect_err("this should be refused").to_string();
    for word in words {
        assert!(error.contains(word), "'{word}' not in: {error}");
    }
}

#[test]
fn unusable_results_are_refused_with_file_and_line() {
    let bench = landing_bench();
    complaint(&bench, &["estimate.csv is missing"]);
    let good = landing_csv(&perfect_landing());
    bench.put("estimate.csv", &good.replace("vy_m_s,", "v_m_s,"));
    complaint(&bench, &["estimate.csv", "no column 'vy_m_s'", "vx_m_s"]);
    let spoil = |line: usize, change: &dyn Fn(&str) -> String| {
        let lines: Vec<String> =
            good.lines().enumerate().map(|(k, l)| if k + 1 == line { change(l) } else { l.to_string() }).collect();
        bench.put("estimate.csv", &lines.join("\n"));
    };
    spoil(5, &|l| l.replacen(",1,2,3,", ",1,2,nan,", 1));
    complaint(&bench, &["estimate.csv, line 5", "sigma_z_m 'nan' is not a finite number"]);
    spoil(4, &|l| l.rsplit_once(',').expect("columns").0.to_string());
    complaint(&bench, &["estimate.csv", "line: 4"]);
    spoil(7, &|l| format!("5000000000{}", &l[l.find(',').expect("columns")..]).replacen("5000000000", "4000000000", 1));
    complaint(&bench, &["estimate.csv, line 7", "does not come after"]);
    bench.put("estimate.csv", &good);
    bench.put("covariance.csv", "0,1,2,3\n");
    complaint(&bench, &["covariance.csv, line 1", "46 expected"]);
}

#[test]
fn results_of_another_data_set_are_refused() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.t_ns += 1000 * SECOND_NS;
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    complaint(&bench, &["no time of", "another data set"]);
}

#[test]
fn missing_summaries_and_truth_come_with_the_cure() {
    let bench = Bench::new("swimming");
    complaint(&bench, &["summary.json", "\"swimming\"", "landing"]);
    fs::write(bench.result().join("summary.json"), "{").expect("write");
    complaint(&bench, &["summary.json", "line 1"]);
    fs::remove_file(bench.result().join("summary.json")).expect("removed");
    complaint(&bench, &["summary.json is missing", "opnav land"]);
    let bench = Bench::new("tracking");
    complaint(&bench, &["sensor.yaml is missing"]);
    fs::remove_dir_all(bench.root().join("truth")).expect("removed");
    complaint(&bench, &["no folder 'truth'"]);
    assert!(Metrics::read(&bench.result()).expect_err("none").to_string().contains("opnav evaluate"));
}
