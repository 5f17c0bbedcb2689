//! `opnav montecarlo` as a user meets it.

use super::opnav;
use tempfile::TempDir;

/// Two selectors, a few flights: every file is there, and the same seed gives the same tables at any number of threads.
#[test]
fn a_campaign_is_written_and_reproduced() {
    let folder = TempDir::new().expect("a temporary folder");
    let fly = |name: &str, threads: &str| {
        let out = folder.path().join(name);
        let arguments = ["montecarlo", "landing", "--runs", "3", "--seed", "5", "--selector", "depth-error,none"];
        let run = opnav().args(arguments).arg("--out").arg(&out).env("RAYON_NUM_THREADS", threads).assert().success();
        let said = String::from_utf8_lossy(&run.get_output().stdout).to_string();
        assert!(said.contains("depth-error") && said.contains("3/3"), "{said}");
        out
    };
    let (first, second) = (fly("first", "1"), fly("second", "2"));
    for (file, lines) in [("table.csv", 3), ("epochs.csv", 1 + 2 * 199), ("flights.csv", 1 + 2 * 3)] {
        let text = std::fs::read_to_string(first.join(file)).expect("a table");
        assert_eq!(text.lines().count(), lines, "{file}");
        let columns = text.lines().next().expect("a header").split(',').count();
        assert!(text.lines().all(|line| line.split(',').count() == columns), "{file}");
        assert_eq!(text, std::fs::read_to_string(second.join(file)).expect("a table"), "{file}");
    }
    let page = std::fs::read_to_string(first.join("report.html")).expect("a page");
    for words in ["Errors at touchdown", "True states", "Depth error at 60 s", "Selector none", "Time per choice"] {
        assert!(page.contains(words), "{words}");
    }
    let summary = std::fs::read_to_string(first.join("summary.json")).expect("a summary");
    assert!(summary.contains("\"mission\": \"landing-campaign\"") && summary.contains("converged_none"), "{summary}");
}

#[test]
fn campaign_options_out_of_range_are_refused() {
    let folder = TempDir::new().expect("a temporary folder");
    let out = folder.path().join("result");
    for (option, value, word) in [("--runs", "0", "runs"), ("--outliers", "0.7", "outlier_share")] {
        let mut command = opnav();
        command.args(["montecarlo", "landing", option, value, "--out"]).arg(&out);
        let error = super::error_of(&mut command);
        assert!(error.contains(word), "{error}");
        assert!(!out.exists());
    }
    opnav().args(["montecarlo", "landing", "--selector", "best", "--out"]).arg(&out).assert().code(2);
}
