//! Tests of the choice of a graphics adapter.

use opnav::render::{Gpu, list_adapters};

#[test]
fn adapters_are_listed_and_chosen_by_name() {
    let found = list_adapters();
    assert!(!found.is_empty(), "install mesa-vulkan-drivers");
    let part = found[0].name[..4].to_uppercase();
    assert_eq!(Gpu::new(Some(&part)).expect("the first adapter").adapter_name(), found[0].name);
    let message = Gpu::new(Some("no such adapter")).expect_err("refused").to_string();
    assert!(message.contains("no such adapter") && message.contains(&found[0].name), "{message}");
}
