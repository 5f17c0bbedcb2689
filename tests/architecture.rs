//! The house rules: which room and which wing may use which, no circles of files, and who may name wgpu and OpenCV.
//!
//! The test reads the sources as text and follows every path through the front doors (`pub use` in `mod.rs`) to the file
//! that it leads to. The plan is [`table`]. The checker itself is tried on houses that break each rule.

mod house;
mod imports;
mod table;

use house::{House, Module};
use std::collections::{BTreeMap, BTreeSet};
use table::{HARMLESS_PAIRS, LIBRARIES, ROOMS, WINGS};

/// The room of a module; `None` for the crate's roots and for front doors above several rooms.
fn room_of(module: &[String]) -> Option<String> {
    match module {
        [first, second, ..] if first == "navigation" => Some(format!("navigation/{second}")),
        [first, second, ..] if first == "dataset" && second == "truth" => Some("dataset/truth".into()),
        [room, _, ..] => Some(room.clone()),
        _ => None,
    }
}

/// The wing of a file below its room, such as `pair/plane`; empty for a file on the room's top.
fn wing_of(module: &[String]) -> String {
    let room = if module[0] == "navigation" { 2 } else { 1 };
    module[room.min(module.len() - 1)..module.len() - 1].join("/")
}

fn is_within(inner: &str, outer: &str) -> bool {
    inner == outer || inner.starts_with(&format!("{outer}/"))
}

/// What one file does against the plan of rooms and wings by naming another.
fn forbidden(from: &Module, to: &Module) -> Option<String> {
    let (room, used) = (room_of(from)?, room_of(to)?);
    let file = format!("src/{}.rs", from.join("/"));
    let top = |name: &str| name.split('/').next().unwrap_or(name).to_string();
    if room != used && !(top(&room) == "dataset" && top(&used) == "dataset") {
        let allowed = ROOMS.iter().find(|(name, _)| *name == room).map_or(&[][..], |(_, uses)| *uses);
        let permitted = allowed.iter().any(|a| *a == used || (*a == "navigation" && is_within(&used, a)));
        return (!permitted).then(|| {
            format!("{file}: room `{room}` may not use `{used}` (`{}`); it may use {allowed:?}", to.join("::"))
        });
    }
    let (wing, other) = (wing_of(from), wing_of(to));
    if wing.is_empty() || other.is_empty() || is_within(&wing, &other) || is_within(&other, &wing) {
        return None;
    }
    let whole = format!("{}/{wing}", if top(&room) == "dataset" { "dataset" } else { &room });
    let allowed = WINGS.iter().find(|(name, _)| *name == whole).map_or(&[][..], |(_, uses)| *uses);
    (!allowed.iter().any(|a| is_within(&other, a))).then(|| {
        format!("{file}: wing `{wing}` may not use wing `{other}` (`{}`); it may use {allowed:?}", to.join("::"))
    })
}

/// Circles of files, each as the files on it; harmless pairs left out.
fn circles(imports: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<String> {
    let mut left: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (from, named) in imports {
        let from = from.join("/");
        let harmless =
            |to: &String| HARMLESS_PAIRS.iter().any(|[a, b]| (*a == from && *b == *to) || (*b == from && *a == *to));
        let named = named.iter().map(|to| to.join("/")).filter(|to| !harmless(to)).collect();
        left.insert(from, named);
    }
    // A file that names nobody who is left, or whom nobody names who is left, is on no circle.
    loop {
        let named: BTreeSet<String> = left.values().flatten().cloned().collect();
        let before = left.len();
        let here: BTreeSet<String> = left.keys().cloned().collect();
        left.retain(|file, uses| named.contains(file) && uses.iter().any(|to| here.contains(to)));
        if left.len() == before {
            break;
        }
    }
    let here: BTreeSet<&String> = left.keys().collect();
    let row = |(file, uses): (&String, &BTreeSet<String>)| {
        let on: Vec<&String> = uses.iter().filter(|to| here.contains(to)).collect();
        format!("src/{file}.rs names {on:?}, and they name it in the end")
    };
    left.iter().map(row).collect()
}

/// Everything in a house that is against the rules, in words.
fn violations(house: &House) -> Vec<String> {
    let imports = house.imports();
    let named = imports.iter().flat_map(|(from, named)| named.iter().filter_map(move |to| forbidden(from, to)));
    let mut found: Vec<String> = named.collect();
    found.extend(circles(&imports));
    for (module, code) in house.code() {
        for (library, owner) in LIBRARIES {
            if module.first().is_some_and(|room| room != owner) && names_crate(&code, library) {
                found.push(format!("src/{}.rs: only `{owner}` may name `{library}`", module.join("/")));
            }
        }
    }
    found
}

fn names_crate(code: &str, library: &str) -> bool {
    [format!("{library}::"), format!("use {library};"), format!("use {library} as")].iter().any(|needle| {
        code.match_indices(needle.as_str())
            .any(|(at, _)| !code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_'))
    })
}

const CURE: &str = "What to do: let the code stand in the room that owns the knowledge, hand plain data in, or ask through \
a closure or a trait of the lower room; two files that need each other are one file or lack a third that both use. Where \
the house itself has changed, change the plan in tests/architecture/table.rs and say why in the commit.";

#[test]
fn every_room_and_wing_keeps_to_the_plan() {
    let found = violations(&House::on_disk());
    assert!(found.is_empty(), "{}\n{CURE}", found.join("\n"));
}

#[test]
fn every_room_and_wing_is_in_the_plan() {
    let house = House::on_disk();
    for folder in house.folders().iter().filter(|f| **f != ["navigation"]) {
        let name = folder.join("/");
        let planned = ROOMS.iter().chain(WINGS).any(|(known, _)| *known == name);
        assert!(planned, "src/{name} is in no plan: add it to tests/architecture/table.rs with what it may use");
    }
    for (name, _) in WINGS {
        let folder: Module = name.split('/').map(String::from).collect();
        assert!(house.folders().contains(&folder), "the plan has a wing {name} that is not there: strike it");
    }
}

/// A small house of rooms that exist, with one file changed.
fn built(file: &str, source: &str) -> House {
    let given = [
        (
            "vision/mod.rs",
            "mod features;\nmod pair;\nmod sequence;\npub use features::Feature;\npub use pair::{plane::Ground, rotate};",
        ),
        ("vision/sequence.rs", "use super::features::Feature;\nuse super::pair::rotate;"),
        ("vision/features/mod.rs", "mod harris;\npub use harris::Feature;"),
        ("vision/features/harris.rs", ""),
        ("vision/pair/mod.rs", "mod rotate;\npub mod plane;\npub use rotate::rotate;"),
        ("vision/pair/rotate.rs", "use super::plane::Ground;"),
        ("vision/pair/plane/mod.rs", "mod model;\npub use model::Ground;"),
        ("vision/pair/plane/model.rs", ""),
        ("geometry/mod.rs", "pub mod so3;"),
        ("geometry/so3.rs", ""),
        ("stats/mod.rs", "mod estimate;\npub use estimate::Estimate;"),
        ("stats/estimate.rs", ""),
        ("dataset/mod.rs", "mod imu;\npub mod truth;\npub use imu::ImuSample;"),
        ("dataset/imu.rs", ""),
        ("dataset/truth/mod.rs", "mod lander;\npub use lander::LanderState;"),
        ("dataset/truth/lander.rs", ""),
        ("scene/mod.rs", "mod scenario;\npub use scenario::Scenario;"),
        ("scene/scenario.rs", ""),
        ("navigation/mod.rs", "pub mod filter;\npub mod landing;"),
        ("navigation/filter/mod.rs", "mod gate;\npub use gate::Gate;"),
        ("navigation/filter/gate.rs", ""),
        ("navigation/landing/mod.rs", "mod step;\npub use step::step;"),
        ("navigation/landing/step.rs", ""),
    ];
    let kept =
        given.iter().filter(|(name, _)| *name != file).map(|(name, source)| (name.to_string(), source.to_string()));
    House::new(kept.chain([(file.to_string(), source.to_string())]))
}

#[test]
fn forbidden_imports_are_found() {
    let cases = [
        ("navigation/landing/step.rs", "use crate::dataset::truth::LanderState;"),
        ("navigation/landing/step.rs", "use crate::{geometry::so3, dataset::{ImuSample, truth::LanderState}};"),
        ("navigation/landing/step.rs", "use crate::vision::Feature;"),
        ("navigation/landing/step.rs", "fn f() { crate::scene::Scenario::default(); }"),
        ("navigation/filter/gate.rs", "use crate::dataset::ImuSample;"),
        ("vision/sequence.rs", "use crate::dataset::truth;\nuse crate::dataset::truth::LanderState;"),
        ("vision/sequence.rs", "use wgpu::Device;"),
        ("render/device.rs", "use opencv::core::Mat;"),
        ("geometry/so3.rs", "use crate::stats::Estimate;"),
        ("cli/land.rs", "use opnav::navigation::landing::step;"),
    ];
    for (file, source) in cases {
        assert_eq!(violations(&built(file, source)).len(), 1, "{file}: {source}");
    }
}

#[test]
fn forbidden_wings_and_circles_are_found() {
    let wings = [
        ("vision/features/harris.rs", "use crate::vision::pair::rotate;"),
        ("vision/features/harris.rs", "use crate::vision::pair::plane::Ground;"),
        ("vision/features/harris.rs", "use crate::vision::Ground;"),
    ];
    for (file, source) in wings {
        let found = violations(&built(file, source));
        assert!(found.len() == 1 && found[0].contains("wing `features` may not use wing `pair"), "{file}: {found:?}");
    }
    let circle = violations(&built("vision/pair/plane/model.rs", "use crate::vision::pair::rotate;"));
    assert!(circle.len() == 2 && circle[0].contains("names"), "two files that name each other: {circle:?}");
    let wider = violations(&built("vision/features/harris.rs", "fn f() { super::super::sequence::run() }"));
    assert_eq!(wider.len(), 2, "through a front door: {wider:?}");
}

#[test]
fn permitted_imports_pass() {
    let cases = [
        ("navigation/landing/step.rs", "use crate::{geometry::so3, dataset::{ImuSample, InitialState}};"),
        ("navigation/landing/step.rs", "use crate::navigation::filter::Gate;"),
        ("scene/scenario.rs", "use crate::dataset::truth::LanderState; // crate::render"),
        ("render/device.rs", "use wgpu::Device;"),
        ("vision/sequence.rs", "use opencv::core::Mat;"),
        ("vision/pair/rotate.rs", "fn f() {}\n#[cfg(test)]\nmod tests { use crate::scene::Scenario; }"),
        ("evaluation/landing.rs", "use crate::dataset::{truth::LanderState, ImuSample};"),
    ];
    for (file, source) in cases {
        let found = violations(&built(file, source));
        assert!(found.is_empty(), "{file}: {found:?}");
    }
}
