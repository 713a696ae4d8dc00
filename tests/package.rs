//! The package as C and C++ programs meet it: installed, found by CMake and pkg-config, linked
//! shared and static; bad arguments and real morphs, plain, under the address sanitizer and under
//! valgrind; and removed again without a trace.

use bladesmith::{brep, fe, morph};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

#[path = "consumer/installed.rs"]
mod installed;

use installed::{Build, configure, data, install, lossy, prefix, root, run, scratch, succeed, valgrind};

/// Programs that check themselves.
const CHECKS: [&str; 8] =
    ["abi_errors", "spline_errors", "tool_errors", "threads", "spline_threads", "owners", "splines", "tools"];
/// The examples of a morph.
const EXAMPLES: [&str; 2] = ["morph_c", "morph_cpp"];
/// The examples of the kernel, in C and in C++: they take no arguments and print the same.
const KERNEL: [&str; 2] = ["curves", "surfaces"];
/// Those in one language, each with lines that it prints.
const FAMILIES: [(&str, &str, &[&str]); 6] = [
    ("fitting", "c", &["interpolated  41 poles, points within 0.0000 mm", "least squares  5 poles"]),
    ("intersections", "c", &["itself at (5.000000, 4.000000)", "ray 1 hits the circle after 13.000000 mm"]),
    ("offsets", "c", &["centre (26.000000, 4.000000), angle 1.570796 rad", "offset by 6 mm: 38.0000 mm"]),
    (
        "reshaping",
        "cpp",
        &["cut and joined           degree 2,  7 poles, 50.000000000 mm", "nothing has moved"],
    ),
    ("nearest", "cpp", &["t = 0.750000: (0.000000, 2.000000), 2.000000 mm away", "t = 1.333333"]),
    (
        "sections",
        "cpp",
        &["offset wall of radius 9.0000 mm", "plane: 1 branch(es)", "its parameters lead to it"],
    ),
];

fn on_the_bar(command: &mut Command) -> &mut Command {
    command.arg(data("bar.brep")).arg(data("bar.frd.gz"))
}

/// Runs an example on the bar with factor -1; the report it prints and the text of the new part.
fn morph_bar(command: &mut Command, folder: &Path) -> (Value, String) {
    let cold = folder.join("cold.brep");
    let _ = fs::remove_file(&cold);
    let output = succeed(on_the_bar(command).arg("-1").arg(&cold));
    (
        serde_json::from_str(&lossy(&output.stdout)).expect("it prints the report as JSON"),
        fs::read_to_string(cold).expect("it wrote the part"),
    )
}

#[test]
fn programs_find_all_as_documented() {
    for program in CHECKS.iter().flat_map(|name| Build::Plain.programs(name)) {
        succeed(on_the_bar(&mut Command::new(program)));
    }
}

#[test]
fn programs_are_clean_under_the_address_sanitizer() {
    let folder = scratch("asan");
    for program in CHECKS.iter().flat_map(|name| Build::Sanitized.programs(name)) {
        succeed(on_the_bar(&mut Command::new(program)));
    }
    for program in EXAMPLES.iter().flat_map(|name| Build::Sanitized.programs(name)) {
        morph_bar(&mut Command::new(program), &folder);
    }
    for program in KERNEL.iter().flat_map(|name| both_languages(Build::Sanitized, name)) {
        succeed(&mut Command::new(program));
    }
    for program in FAMILIES.iter().flat_map(|family| of_family(Build::Sanitized, family)) {
        succeed(&mut Command::new(program));
    }
}

#[test]
fn programs_are_clean_under_valgrind() {
    let folder = scratch("valgrind");
    for [shared, _] in CHECKS.map(|name| Build::Plain.programs(name)) {
        succeed(on_the_bar(&mut valgrind(&shared)));
    }
    for [_, linked] in EXAMPLES.map(|name| Build::Plain.programs(name)) {
        morph_bar(&mut valgrind(&linked), &folder);
    }
    for [_, in_c, _, in_cpp] in KERNEL.map(|name| both_languages(Build::Plain, name)) {
        succeed(&mut valgrind(&in_c));
        succeed(&mut valgrind(&in_cpp));
    }
    for [_, linked] in FAMILIES.map(|family| of_family(Build::Plain, &family)) {
        succeed(&mut valgrind(&linked));
    }
}

/// An example of one language, with the library shared and static.
fn of_family(build: Build, (name, language, _): &(&str, &str, &[&str])) -> [PathBuf; 2] {
    build.programs(&format!("{name}_{language}"))
}

#[test]
fn the_examples_of_families_print_what_is_so() {
    for family in FAMILIES {
        for program in of_family(Build::Plain, &family) {
            let said = lossy(&succeed(&mut Command::new(program)).stdout);
            for line in family.2 {
                assert!(said.contains(line), "{} does not say '{line}' but\n{said}", family.0);
            }
        }
    }
}

/// An example in C and in C++, each with the library shared and static.
fn both_languages(build: Build, name: &str) -> [PathBuf; 4] {
    let [[a, b], [c, d]] = ["c", "cpp"].map(|language| build.programs(&format!("{name}_{language}")));
    [a, b, c, d]
}

#[test]
fn the_examples_of_the_kernel_print_the_same_in_c_and_cpp() {
    for (name, expected) in [("curves", "length 75.256472 mm"), ("surfaces", "1/mm\nnearest (")] {
        let said = both_languages(Build::Plain, name)
            .map(|program| lossy(&succeed(&mut Command::new(program)).stdout));
        assert!(said[0].contains(expected), "{name} says {}", said[0]);
        assert!(said.iter().all(|text| *text == said[0]), "{said:#?}");
    }
}

#[test]
fn clang_takes_headers_and_programs() {
    if Command::new("clang++").arg("--version").output().is_err() {
        println!("skipped: clang is not installed");
        return;
    }
    for program in CHECKS.iter().flat_map(|name| Build::Clang.programs(name)) {
        succeed(on_the_bar(&mut Command::new(program)));
    }
}

#[test]
fn the_examples_give_the_part_of_the_crate_with_any_number_of_threads() {
    let folder = scratch("examples");
    let text = fs::read_to_string(data("bar.brep")).expect("it is committed");
    let part = brep::parse("bar.brep", &text).expect("the bar is sound");
    let field = fe::read(&data("bar.frd.gz"), &fe::ReadOptions::default()).expect("so is its field");
    let options = morph::Options { factor: -1.0, ..morph::Options::default() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread starts");
    let expected =
        pool.install(|| morph::morph(&part, &field, &options, &|_, _| true)).expect("the bar morphs");
    for program in EXAMPLES.iter().flat_map(|name| Build::Plain.programs(name)) {
        let (report, cold) = morph_bar(&mut Command::new(&program), &folder);
        assert!(cold == expected.brep.write(), "the part of {} differs", program.display());
        assert_eq!(report["solid"]["closed"], true, "{report}");
        assert_eq!(report["input"]["factor"], -1.0);
        assert_eq!(report["faces"].as_array().map(Vec::len), Some(7));
        let deviation = report["deviation_mm"]["max"].as_f64().expect("a largest deviation");
        assert!(deviation > 0.0 && deviation < 1e-3, "largest deviation {deviation} mm");
    }
}

#[test]
fn the_examples_say_what_is_wrong_at_once_and_leave_nothing_behind() {
    let folder = scratch("wrong");
    let (part, field) = (data("bar.brep").display().to_string(), data("bar.frd.gz").display().to_string());
    let cases = [
        (vec![], "usage: morph"),
        (vec!["no such.brep", &field, "1", "cold.brep"], "no such.brep: cannot be read"),
        (vec![&part, "no such.frd", "1", "cold.brep"], "no such.frd"),
        (vec![&part, &field, "-1x", "cold.brep"], "-1x: FACTOR must be a number"),
        (vec![&part, &field, "", "cold.brep"], ": FACTOR must be a number"),
        (vec![&part, &field, "1", "no such folder/cold.brep"], "no such folder/cold.brep: cannot be written"),
    ];
    for program in EXAMPLES.iter().flat_map(|name| Build::Plain.programs(name)) {
        for (arguments, expected) in &cases {
            let output = run(Command::new(&program).args(arguments).current_dir(&folder));
            let said = lossy(&output.stderr);
            assert!(!output.status.success() && said.contains(expected), "{program:?}: {said}");
            assert!(!said.contains('%'), "{program:?} began the morph: {said}");
            assert_eq!(tree(&folder), BTreeSet::new(), "{program:?} {arguments:?}");
        }
    }
}

#[test]
fn the_examples_are_short_and_build_as_they_stand() {
    for language in ["c", "cpp"] {
        let project = root().join("examples").join(language);
        let families = FAMILIES.iter().filter(|family| family.1 == language).map(|family| &family.0);
        for name in ["morph"].iter().chain(&KERNEL).chain(families) {
            let file = format!("{name}.{language}");
            let source = fs::read_to_string(project.join(&file)).expect("it is committed");
            assert!(source.lines().count() < 100, "{file} has {} lines", source.lines().count());
        }
        let build = scratch(&format!("example-{language}"));
        succeed(&mut configure(&project, &build, prefix()));
        succeed(Command::new("cmake").arg("--build").arg(&build));
        morph_bar(&mut Command::new(build.join("morph")), &build);
    }
}

#[test]
fn a_field_from_arrays_grows_the_part_by_its_third_power() {
    let [shared, _] = Build::Plain.programs("scale_part");
    let output = succeed(on_the_bar(&mut Command::new(shared)));
    let report: Value = serde_json::from_str(&lossy(&output.stdout)).expect("it prints the report");
    let volume = |when: &str| report["solid"]["volume_mm3"][when].as_f64().expect("a volume");
    let ratio = volume("after") / volume("before");
    assert!((ratio / 1.001_f64.powi(3) - 1.0).abs() < 1e-7, "volume grows by {ratio}");
    assert_eq!(report["input"]["field"], "growth");
}

/// Configures a project that asks for a release; what CMake says.
fn asks_for(release: &str) -> (bool, String) {
    let folder = scratch(&format!("release-{release}"));
    let project = format!(
        "cmake_minimum_required(VERSION 3.16)\nproject(asks NONE)\n\
         find_package(bladesmith {release} CONFIG REQUIRED)\nmessage(STATUS \"found ${{bladesmith_VERSION}}\")\n"
    );
    fs::write(folder.join("CMakeLists.txt"), project).expect("the scratch folder is writable");
    let output = run(&mut configure(&folder, &folder.join("build"), prefix()));
    (output.status.success(), lossy(&output.stdout) + &lossy(&output.stderr))
}

#[test]
fn cmake_takes_the_series_that_is_installed_and_no_other() {
    let release = env!("CARGO_PKG_VERSION");
    let series = release.rsplit_once('.').expect("three numbers").0;
    for wanted in [release, series] {
        let (found, said) = asks_for(wanted);
        assert!(found && said.contains(&format!("found {release}")), "{wanted}: {said}");
    }
    for wanted in [&format!("{series}.99"), "0.99", "7.0"] {
        let (found, said) = asks_for(wanted);
        assert!(!found && said.contains(&format!("version: {release}")), "{wanted}: {said}");
    }
}

/// What pkg-config gives for a package below `prefix`, as a shell would split it.
fn pkg_config(prefix: &Path, question: &[&str]) -> String {
    let mut ask = Command::new("pkg-config");
    ask.env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig")).args(question);
    lossy(&succeed(&mut ask).stdout).trim().to_owned()
}

/// Compiles an example with the flags of pkg-config.
fn compile_by_pkg_config(prefix: &Path, question: &[&str], folder: &Path) -> PathBuf {
    let program = folder.join("morph");
    let source = root().join("examples/c/morph.c");
    let command = format!(
        "gcc -std=c99 -Wall -Wextra -pedantic -Werror '{}' -o '{}' {}",
        source.display(),
        program.display(),
        pkg_config(prefix, question)
    );
    succeed(Command::new("sh").args(["-c", &command]));
    program
}

#[test]
fn pkg_config_finds_the_shared_library() {
    assert_eq!(pkg_config(prefix(), &["--modversion", "bladesmith"]), env!("CARGO_PKG_VERSION"));
    let folder = scratch("pkg-config-shared");
    let shared = compile_by_pkg_config(prefix(), &["--cflags", "--libs", "bladesmith"], &folder);
    morph_bar(Command::new(shared).env("LD_LIBRARY_PATH", prefix().join("lib")), &folder);
}

#[test]
fn pkg_config_finds_the_static_library_beside_the_shared_one() {
    let package = "bladesmith-static";
    assert_eq!(pkg_config(prefix(), &["--modversion", package]), env!("CARGO_PKG_VERSION"));
    let folder = scratch("pkg-config-static");
    let linked = compile_by_pkg_config(prefix(), &["--cflags", "--libs", package], &folder);
    morph_bar(&mut Command::new(linked), &folder);
}

#[test]
fn pkg_config_links_the_archive_where_it_is_alone() {
    let folder = scratch("pkg-config-alone");
    let archive_only = folder.join("prefix");
    install(&archive_only);
    for name in ["libbladesmith.so", "libbladesmith.so.1"] {
        fs::remove_file(archive_only.join("lib").join(name)).expect("it was installed");
    }
    let question = ["--static", "--cflags", "--libs", "bladesmith"];
    let linked = compile_by_pkg_config(&archive_only, &question, &folder);
    morph_bar(&mut Command::new(linked), &folder);
}

#[test]
fn the_installed_libraries_hold_machine_code_and_little_else() {
    for (name, most) in [("libbladesmith.so", 10), ("libbladesmith.a", 30)] {
        let size = fs::metadata(prefix().join("lib").join(name)).expect("it is installed").len();
        assert!(size < most << 20, "{name} has {size} bytes");
    }
}

/// All files, links and folders below a folder, by their paths in it.
fn tree(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).expect("a folder that can be read") {
            let path = entry.expect("its entries").path();
            if path.is_dir() && !path.is_symlink() {
                open.push(path.clone());
            }
            found.insert(path.strip_prefix(folder).expect("it lies below").to_owned());
        }
    }
    found
}

#[test]
fn uninstall_removes_what_install_put_there_and_nothing_else() {
    let target = scratch("uninstall");
    fs::create_dir_all(target.join("lib/pkgconfig")).expect("the scratch folder is writable");
    fs::create_dir_all(target.join("share")).expect("the scratch folder is writable");
    fs::write(target.join("lib/libother.so"), "").expect("the scratch folder is writable");
    let before = tree(&target);
    install(&target);
    let installed = tree(&target);
    install(&target);
    assert_eq!(tree(&target), installed, "a second installation leaves the same files");
    let compiled = target.join("share/bladesmith/freecad/bladesmith/__pycache__");
    fs::create_dir_all(&compiled).expect("Python may compile there");
    fs::write(compiled.join("api.pyc"), "").expect("Python may compile there");
    let uninstall = || run(Command::new(root().join("cmake/uninstall.sh")).arg(&target));
    let output = uninstall();
    assert!(output.status.success(), "{}", lossy(&output.stderr));
    assert_eq!(tree(&target), before);
    let again = uninstall();
    assert!(!again.status.success() && lossy(&again.stderr).contains("is not installed there"));
}
