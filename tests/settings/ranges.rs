//! The ranges that the reference states are those that are checked.

use super::{Key, all_keys, changes};
use opnav::pipeline::settings_reference;
use std::collections::{BTreeMap, BTreeSet};

/// The stated range of every key of every table, by its path.
fn stated_ranges() -> BTreeMap<String, String> {
    let mut ranges = BTreeMap::new();
    let mut tables: Vec<String> = Vec::new();
    let page = settings_reference();
    for line in page.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            let paths = heading.split('`').skip(1).step_by(2).filter(|path| path.starts_with('['));
            tables = paths.map(|path| path.trim_matches(['[', ']']).to_string()).collect();
        } else if line.starts_with("| `") {
            let cells: Vec<&str> = line.split(" | ").collect();
            let key = cells[0].trim_start_matches("| ").trim_matches('`');
            ranges.extend(tables.iter().map(|table| (format!("{table}.{key}"), cells[3].trim().to_string())));
        }
    }
    ranges
}

/// Numbers at the ends of a stated range: those that are allowed, and those that are not.
fn ends(range: &str, whole: bool) -> (Vec<f64>, Vec<f64>) {
    let number = |word: &str| word.parse::<f64>().unwrap_or_else(|_| panic!("{range}"));
    let less = |n: f64| n - if whole { 1.0 } else { 1e-3 * n.abs().max(1.0) };
    let more = |n: f64| n + if whole { 1.0 } else { 1e-3 * n.abs().max(1.0) };
    match range.split(' ').collect::<Vec<_>>().as_slice() {
        [low, "to", "2⁶³-1"] => (vec![number(low), 1e15], vec![-1.0]),
        [low, "to", high] => (vec![number(low), number(high)], vec![less(number(low)), more(number(high))]),
        ["above", low, "to", high] => (vec![number(high)], vec![number(low), more(number(high))]),
        ["above", low] => (vec![more(number(low))], vec![number(low), less(number(low))]),
        ["between", low, "and", high] => (vec![more(number(low)), less(number(high))], vec![number(low), number(high)]),
        // Where only odd numbers are allowed, the next one is.
        [low, "or", "more"] => (vec![number(low), 2.0 + number(low)], vec![less(number(low))]),
        ["its", "norm", "below", most] => (vec![0.5 * number(most)], vec![number(most)]),
        ["no", "less" | "fewer", "than", _] => (vec![1e3], vec![0.0]),
        _ => panic!("an unknown range: {range}"),
    }
}

fn set(key: &Key, number: f64) -> Result<bool, String> {
    let number = if key.is_whole() { format!("{number:.0}") } else { format!("{number:e}") };
    changes(key.command, &[&key.change(&number)])
}

#[test]
fn the_stated_ranges_hold() {
    let ranges = stated_ranges();
    let mut judged = 0;
    for key in all_keys().iter().filter(|key| key.is_numeric() && key.command != "demo") {
        let Some(range) = ranges.get(&key.path).filter(|range| !range.is_empty()) else { continue };
        let (allowed, refused) = ends(range, key.is_whole());
        for number in allowed {
            // Where another key, or the path as a whole, is at fault, the range is not.
            let error = set(key, number).err().unwrap_or_default();
            let own = error.contains(&format!("{} is", key.path)) && !key.path.ends_with("guidance.duration_s");
            assert!(!own, "{}: {number} of \"{range}\": {error}", key.path);
        }
        for number in refused {
            let error = set(key, number).expect_err(&format!("{}: {number} of \"{range}\"", key.path));
            assert!(error.contains(&key.path), "{error}");
        }
        judged += 1;
    }
    assert!(judged > 150, "{judged} ranges");
}

#[test]
fn every_number_has_a_range_or_is_any_finite_one() {
    let ranges = stated_ranges();
    let free: BTreeSet<String> = all_keys()
        .iter()
        .filter(|key| key.is_numeric() && key.command != "demo")
        .filter(|key| ranges.get(&key.path).is_none_or(String::is_empty))
        .map(|key| key.path.clone())
        .collect();
    let any = [
        "campaign.guidance.final_acceleration_m_s2",
        "campaign.guidance.initial_position_m",
        "campaign.guidance.initial_velocity_m_s",
        "campaign.planet_rate_in_site_rad_s",
        "tumbling.paper.initial_inertia",
        "tumbling.paper.initial_rate_deg_s",
    ];
    assert_eq!(free, any.map(String::from).into());
}

#[test]
fn what_is_no_number_is_refused_everywhere() {
    for key in all_keys().iter().filter(|key| key.is_numeric() && !key.is_whole()) {
        for number in ["nan", "inf", "-inf"] {
            let error = changes(key.command, &[&key.change(number)]).expect_err(&key.path);
            assert!(error.contains(&format!("{} is", key.path)), "{error}");
        }
    }
}
