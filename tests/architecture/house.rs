//! The sources as a house: files as modules, and the file that a path leads to through the front doors on its way.

use super::imports::{named_paths, own_code};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A module's path below the crate's root, such as `vision`, `pair`, `plane`.
pub type Module = Vec<String>;

/// Every source of the library.
pub struct House {
    /// Sources by module; a folder's `mod.rs` is the folder's module.
    sources: BTreeMap<Module, String>,
    /// What each folder's front door hands on, by name: the child that it comes from.
    handed_on: BTreeMap<Module, BTreeMap<String, Vec<String>>>,
    folders: BTreeSet<Module>,
}

impl House {
    /// The house of sources given by their paths below `src/`.
    pub fn new(files: impl IntoIterator<Item = (String, String)>) -> Self {
        let mut house = House { sources: BTreeMap::new(), handed_on: BTreeMap::new(), folders: BTreeSet::new() };
        for (file, source) in files {
            let mut module: Module = file.trim_end_matches(".rs").split('/').map(String::from).collect();
            if module.last().is_some_and(|last| last == "mod") {
                module.pop();
                house.handed_on.insert(module.clone(), front_door(&source));
                house.folders.insert(module.clone());
            }
            house.sources.insert(module, source);
        }
        house
    }

    /// The house as it stands on disk.
    pub fn on_disk() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut paths = Vec::new();
        rust_files(&root, &mut paths);
        assert!(paths.len() > 20, "the sources were not found");
        House::new(paths.iter().map(|path| {
            let name = path.strip_prefix(&root).expect("under the root").to_string_lossy().replace('\\', "/");
            (name, std::fs::read_to_string(path).expect("a readable source"))
        }))
    }

    /// Files that hold code, not front doors, with what each names: the files that its paths lead to.
    pub fn imports(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let files = self.sources.iter().filter(|(module, _)| !self.folders.contains(*module));
        files.map(|(module, source)| (module.clone(), self.named_files(module, source))).collect()
    }

    /// Every source with its own code, front doors included.
    pub fn code(&self) -> impl Iterator<Item = (&Module, String)> {
        self.sources.iter().map(|(module, source)| (module, own_code(source)))
    }

    /// Folders below a room.
    pub fn folders(&self) -> &BTreeSet<Module> {
        &self.folders
    }

    fn named_files(&self, module: &[String], source: &str) -> BTreeSet<Module> {
        let found = named_paths(source).into_iter().filter_map(|path| self.file_of(module, &path));
        found.filter(|file| file != module).collect()
    }

    /// The file that a path leads to from a module; `None` if it leads out of the library.
    fn file_of(&self, from: &[String], path: &[String]) -> Option<Module> {
        let (mut at, mut rest) = match path.first()?.as_str() {
            "crate" | "opnav" => (Vec::new(), &path[1..]),
            "self" => (from.to_vec(), &path[1..]),
            _ => (from.to_vec(), path),
        };
        while rest.first().is_some_and(|word| word == "super") {
            at.pop();
            rest = &rest[1..];
        }
        let mut ahead: Vec<String> = rest.to_vec();
        loop {
            if self.sources.contains_key(&at) && !self.folders.contains(&at) {
                return Some(at);
            }
            let word = ahead.first().cloned()?;
            let child: Module = at.iter().cloned().chain([word.clone()]).collect();
            let handed_on = self.handed_on.get(&at).and_then(|door| door.get(&word));
            let is_module = self.sources.contains_key(&child) || self.folders.contains(&child);
            match handed_on {
                // A name that is a module's too is the item where it is the path's last word.
                Some(inner) if !is_module || ahead.len() == 1 => {
                    ahead.splice(..1, inner.iter().cloned());
                    at.push(ahead.remove(0));
                }
                _ if is_module => {
                    at = child;
                    ahead.remove(0);
                }
                _ => return None,
            }
        }
    }
}

/// What a `mod.rs` hands on from its children: name to path within the folder.
fn front_door(source: &str) -> BTreeMap<String, Vec<String>> {
    let code = own_code(source);
    let statements = code.split("pub use ").skip(1).filter_map(|after| after.split(';').next());
    let own = statements.filter(|statement| !statement.starts_with("crate::"));
    own.flat_map(|statement| named_paths(&format!("self::{statement}")))
        .filter_map(|path| Some((path.last()?.clone(), path[1..].to_vec())))
        .collect()
}

fn rust_files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the folder of sources can be listed") {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            rust_files(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            into.push(path);
        }
    }
}
