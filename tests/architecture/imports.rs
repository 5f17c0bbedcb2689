//! Which paths a source names: `crate::…`, `super::…`, `self::…` and, in the command line, `opnav::…`, groups taken apart.

/// Paths that a file's own code names, its tests and comments left out.
pub fn named_paths(source: &str) -> Vec<Vec<String>> {
    let code = own_code(source);
    let mut paths = Vec::new();
    for root in ["crate::", "opnav::", "super::", "self::"] {
        for (at, _) in code.match_indices(root) {
            let before = code[..at].chars().next_back();
            if !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$' || c == ':') {
                expand(&code[at..], &[], &mut paths);
            }
        }
    }
    paths
}

/// A source without comments, and without what follows its first test module: tests may look at everything.
pub fn own_code(source: &str) -> String {
    let without_tests = source.split("#[cfg(test)]\nmod ").next().unwrap_or(source);
    without_tests.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// Follows a path such as `a::{b::c, d}` and notes each of its leaves.
fn expand(rest: &str, prefix: &[String], paths: &mut Vec<Vec<String>>) {
    let rest = rest.trim_start();
    if let Some(group) = rest.strip_prefix('{') {
        items(group).iter().for_each(|item| expand(item, prefix, paths));
        return;
    }
    let word: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    let mut path = prefix.to_vec();
    if !word.is_empty() && word != "self" || prefix.is_empty() {
        path.push(word.clone());
    }
    match rest[word.len()..].trim_start().strip_prefix("::") {
        Some(next) => expand(next, &path, paths),
        None => paths.push(path),
    }
}

/// The items of a group whose opening brace has been read, groups inside it whole.
fn items(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (1, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if (c == ',' && depth == 1) || depth == 0 {
            found.push(&group[start..at]);
            start = at + 1;
        }
        if depth == 0 {
            break;
        }
    }
    found.retain(|item| !item.trim().is_empty());
    found
}
