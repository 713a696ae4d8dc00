//! The architecture, read from the sources: rooms use only rooms before them, unsafe code stays in
//! one room, files stay readable.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms of the crate with their rank; a room may use itself and rooms of a lower rank.
const ROOMS: [(&str, usize); 11] = [
    ("error", 0),
    ("tolerance", 0),
    ("linalg", 1),
    ("nurbs", 2),
    ("ops", 3),
    ("brep", 4),
    ("fe", 4),
    ("morph", 5),
    ("blade", 5),
    ("cooling", 6),
    ("ffi", 7),
];

/// Packages of the add-on with their rank; those of one rank stand beside each other and may be
/// used by one another.
const PACKAGES: [(&str, usize); 14] = [
    ("log", 0),
    ("native", 0),
    ("model", 1),
    ("occ", 2),
    ("operations", 3),
    ("colours", 3),
    ("features", 4),
    ("viewproviders", 5),
    ("report", 6),
    ("taskpanels", 7),
    ("commands", 7),
    ("cli", 7),
    ("__main__", 8),
    ("init_gui", 8),
];

const MOST_LINES: usize = 500;

fn rank(table: &[(&str, usize)], name: &str) -> Option<usize> {
    table.iter().find(|(known, _)| *known == name).map(|(_, rank)| *rank)
}

/// Files below `folder` with this extension, by their path from there.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap_or_else(|e| panic!("{}: {e}", next.display())) {
            let path = entry.expect("a readable folder").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ext| ext == extension) {
                found.push(path.strip_prefix(folder).expect("it lies below").to_owned());
            }
        }
    }
    found.sort();
    found
}

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The first part of a path without extension: the room or package a file belongs to.
fn first_part(path: &Path) -> String {
    let first = path.iter().next().unwrap_or_default();
    Path::new(first).with_extension("").to_string_lossy().into_owned()
}

fn tokens(text: &str) -> Vec<TokenTree> {
    let stream: TokenStream = text.parse().expect("a source that compiles has tokens");
    stream.into_iter().collect()
}

/// Identifiers of a source in order, with `::` and braces in between; texts and comments left out.
fn words(trees: &[TokenTree], out: &mut Vec<String>) {
    for tree in trees {
        match tree {
            TokenTree::Ident(ident) => out.push(ident.to_string()),
            TokenTree::Punct(punct) => out.push(punct.as_char().to_string()),
            TokenTree::Literal(_) => out.push("literal".into()),
            TokenTree::Group(group) => {
                out.push("(".into());
                words(&group.stream().into_iter().collect::<Vec<_>>(), out);
                out.push(")".into());
            }
        }
    }
}

/// Rooms that a source names after `crate::` or by climbing up with `super::super::`.
fn rooms_used(text: &str) -> BTreeSet<String> {
    let mut all = Vec::new();
    words(&tokens(text), &mut all);
    let mut used = BTreeSet::new();
    for (i, word) in all.iter().enumerate() {
        let climbs = word == "super" && i >= 3 && all[i - 3] == "super" && all[i - 1] == ":";
        if (word != "crate" && !climbs) || all.get(i + 1).is_none_or(|next| next != ":") {
            continue;
        }
        let rest = &all[i + 3..];
        match rest.first().map(String::as_str) {
            Some("(") => used.extend(names_of_group(&rest[1..])),
            Some(name) => drop(used.insert(name.to_owned())),
            None => {}
        }
    }
    used.retain(|name| rank(&ROOMS, name).is_some());
    used
}

/// First names of the entries of `{a::b, c, d::{e, f}}`, given what follows the opening brace.
fn names_of_group(words: &[String]) -> Vec<String> {
    let (mut depth, mut names, mut at_start) = (0, Vec::new(), true);
    for word in words {
        match word.as_str() {
            "(" => depth += 1,
            ")" if depth == 0 => break,
            ")" => depth -= 1,
            "," if depth == 0 => {
                at_start = true;
                continue;
            }
            name if at_start => names.push(name.to_owned()),
            _ => {}
        }
        at_start = false;
    }
    names
}

#[test]
fn imports_are_found_however_they_are_written() {
    let source = r#"
        //! [`crate::ffi`] in a comment counts for nothing.
        use crate::{brep::{Brep, parse}, error::Result};
        use super::super::morph;
        pub(crate) fn f() -> crate::nurbs::KnotVector { g("crate::blade", 'x') }
    "#;
    let used: Vec<_> = rooms_used(source).into_iter().collect();
    assert_eq!(used, ["brep", "error", "morph", "nurbs"]);
}

#[test]
fn rooms_use_only_rooms_before_them() {
    let mut wrong = Vec::new();
    for file in files(&sources(), "rs") {
        let room = first_part(&file);
        if room == "lib" {
            continue;
        }
        let own = rank(&ROOMS, &room)
            .unwrap_or_else(|| panic!("src/{}: room '{room}' has no place in ROOMS", file.display()));
        let text = fs::read_to_string(sources().join(&file)).expect("a readable source");
        for used in rooms_used(&text) {
            if used != room && rank(&ROOMS, &used).is_some_and(|rank| rank >= own && own > 0) {
                wrong.push(format!("src/{}: '{room}' uses '{used}'", file.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "a room may only use rooms before it:\n{}", wrong.join("\n"));
}

/// The one file outside of ffi with unsafe code: processor instructions chosen at run time.
const UNSAFE_FILE: &str = "nurbs/wide.rs";

#[test]
fn unsafe_code_is_in_ffi_and_one_file_only() {
    let mut wrong = Vec::new();
    let safe = |file: &&PathBuf| first_part(file) != "ffi" && file.as_path() != Path::new(UNSAFE_FILE);
    for file in files(&sources(), "rs").iter().filter(safe) {
        let text = fs::read_to_string(sources().join(file)).expect("a readable source");
        let mut all = Vec::new();
        words(&tokens(&text), &mut all);
        if all.iter().any(|word| word == "unsafe") {
            wrong.push(format!("src/{}", file.display()));
        }
    }
    assert!(wrong.is_empty(), "unsafe code belongs into src/ffi or src/{UNSAFE_FILE}:\n{}", wrong.join("\n"));
}

#[test]
fn no_source_is_longer_than_500_lines() {
    let mut wrong = Vec::new();
    for file in files(&sources(), "rs") {
        let lines = fs::read_to_string(sources().join(&file)).expect("a readable source").lines().count();
        if lines > MOST_LINES {
            wrong.push(format!("src/{}: {lines} lines", file.display()));
        }
    }
    assert!(wrong.is_empty(), "split these:\n{}", wrong.join("\n"));
}

#[test]
fn every_test_is_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |name: &str| fs::read_to_string(root.join(name)).expect("a readable source");
    let listed = read("tests/rooms.rs") + &read("Cargo.toml");
    for entry in fs::read_dir(root.join("tests")).expect("a readable folder") {
        let path = entry.expect("a readable folder").path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let line = match path.extension() {
            Some(extension) if extension == "rs" && name != "rooms" => format!("\nmod {name};\n"),
            _ if path.join("main.rs").exists() => format!("{name}/main.rs\""),
            _ => continue,
        };
        assert!(listed.contains(&line), "tests/{name} is missing in tests/rooms.rs");
    }
}

/// What a line of Python imports: dots of a relative import, and the dotted names.
fn python_imports(line: &str) -> Vec<(usize, String)> {
    let line = line.split('#').next().unwrap_or_default().trim();
    if let Some(rest) = line.strip_prefix("from ") {
        let Some((module, names)) = rest.split_once(" import ") else { return Vec::new() };
        let path = module.trim_start_matches('.');
        let dots = module.len() - path.len();
        let names = names.trim_matches(['(', ')', ' ']).split(',');
        let join = |name: &str| {
            let name = name.split_whitespace().next().unwrap_or_default();
            [path, name].iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(".")
        };
        return names.map(|name| (dots, join(name))).collect();
    }
    let Some(rest) = line.strip_prefix("import ") else { return Vec::new() };
    rest.split(',').map(|name| (0, name.split_whitespace().next().unwrap_or_default().to_owned())).collect()
}

/// The package of the add-on that an import reaches from a file `depth` folders below its root.
fn package_used(dots: usize, name: &str, depth: usize) -> Option<String> {
    let below = match dots {
        0 => name.strip_prefix("freecad.bladesmith.")?,
        _ if dots == depth + 1 => name,
        _ => return None,
    };
    below.split('.').next().map(str::to_owned)
}

/// Modules that only some packages may import: how they start, and which packages those are.
const RESERVED: [(&[&str], &[&str]); 2] = [
    (&["ctypes"], &["native"]),
    (&["FreeCADGui", "PySide", "pivy"], &["viewproviders", "taskpanels", "commands", "init_gui"]),
];

/// What a Python source of `package`, `depth` folders below the root, imports against the order.
fn python_faults(package: &str, depth: usize, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    // A list of names in parentheses counts as one line.
    let text = text.replace("(\n", "(").replace(",\n", ",");
    for (dots, name) in text.lines().flat_map(python_imports) {
        let used = package_used(dots, &name, depth).filter(|used| used != package);
        if let (Some(own), Some(other)) =
            (rank(&PACKAGES, package), used.as_deref().and_then(|used| rank(&PACKAGES, used)))
            && other > own
        {
            faults.push(format!("'{package}' uses '{}'", used.unwrap_or_default()));
        }
        for (modules, owners) in RESERVED {
            let reserved = dots == 0 && modules.iter().any(|module| name.starts_with(module));
            if reserved && rank(&PACKAGES, package).is_some() && !owners.contains(&package) {
                faults.push(format!("'{package}' imports {name}, which belongs to {owners:?}"));
            }
        }
    }
    faults
}

#[test]
fn python_imports_are_found_however_they_are_written() {
    let faults = |text: &str| python_faults("features", 1, text);
    assert!(faults("from ..occ import step\nfrom . import morph\nimport Part\n").is_empty());
    assert_eq!(faults("    from ..taskpanels import morph\n"), ["'features' uses 'taskpanels'"]);
    assert_eq!(faults("from .. import occ, cli  # both\n"), ["'features' uses 'cli'"]);
    assert_eq!(faults("from .. import (\n    occ,\n    cli,\n)\n"), ["'features' uses 'cli'"]);
    assert_eq!(faults("from freecad.bladesmith import commands\n"), ["'features' uses 'commands'"]);
    assert_eq!(faults("import freecad.bladesmith.cli.main as cli\n"), ["'features' uses 'cli'"]);
    assert_eq!(faults("import ctypes\n").len(), 1);
    assert_eq!(faults("from PySide import QtCore\n").len(), 1);
}

#[test]
fn packages_of_the_add_on_use_only_packages_before_them() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("freecad_workbench/freecad/bladesmith");
    if !root.is_dir() {
        println!("no add-on in this checkout: nothing to check");
        return;
    }
    let mut wrong = Vec::new();
    for file in files(&root, "py") {
        let text = fs::read_to_string(root.join(&file)).expect("a readable source");
        let depth = file.iter().count() - 1;
        let faults = python_faults(&first_part(&file), depth, &text);
        wrong.extend(faults.iter().map(|fault| format!("{}: {fault}", file.display())));
    }
    assert!(wrong.is_empty(), "a package may only use packages before it:\n{}", wrong.join("\n"));
}
