//! What this build leaves out: subcommands that are known, and the features that bring them.

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// A subcommand, the features that bring it, and whether it is here.
const SUBCOMMANDS: [(&str, &str, bool); 10] = [
    ("render", "render", cfg!(feature = "render")),
    ("map", "render", cfg!(feature = "render")),
    ("bench", "render", cfg!(feature = "render")),
    ("track", "vision", cfg!(feature = "vision")),
    ("land", "vision", cfg!(feature = "vision")),
    ("tumble", "vision", cfg!(feature = "vision")),
    ("report", "report", cfg!(feature = "report")),
    ("montecarlo", "scene,report", cfg!(all(feature = "scene", feature = "report"))),
    ("demo", "render,vision,report", cfg!(all(feature = "render", feature = "vision", feature = "report"))),
    ("reference", "scene", cfg!(any(feature = "scene", feature = "vision"))),
];

/// What to build instead, if the error is about a subcommand that only this build lacks.
pub fn cure(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    let (name, features, _) = SUBCOMMANDS.iter().find(|(known, _, here)| known == name && !here)?;
    let is_subcommand = error.kind() == ErrorKind::InvalidSubcommand;
    is_subcommand.then(|| format!("this build has no '{name}': build opnav with --features cli,{features}"))
}
