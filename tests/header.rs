//! The committed C header is what the sources say, documents itself, and any C99 or C++17 compiler
//! takes it alone.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use bladesmith::ffi::MorphOptions;

/// Sources of the header in the order in which it presents them.
const SOURCES: [&str; 24] = [
    "status",
    "library",
    "progress",
    "field",
    "part",
    "options",
    "check",
    "morph",
    "spline/curve",
    "spline/table",
    "spline/curves",
    "spline/curve_reshape",
    "spline/curve_make",
    "spline/curve_fit",
    "spline/surface",
    "spline/surfaces",
    "spline/surface_reshape",
    "spline/surface_make",
    "spline/nearest",
    "spline/intersect",
    "spline/ray",
    "spline/offset",
    "spline/fillet",
    "spline/section",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn header_path() -> PathBuf {
    root().join("include/bladesmith/bladesmith.h")
}

fn generated() -> String {
    let config =
        cbindgen::Config::from_file(root().join("cbindgen.toml")).expect("cbindgen.toml is readable");
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(root().join(format!("src/ffi/{source}.rs")));
    }
    let mut text = Vec::new();
    builder.generate().expect("cbindgen understands src/ffi").write(&mut text);
    String::from_utf8(text).expect("the header is UTF-8")
}

/// Runs a compiler on a source given as text; returns what it says against it.
fn compile(compiler: &str, flags: &[&str], name: &str, source: &str) -> Result<(), String> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&file, source).expect("the scratch folder is writable");
    let output = Command::new(compiler)
        .args(["-Wall", "-Wextra", "-Wundef", "-pedantic", "-Werror", "-fsyntax-only"])
        .args(flags)
        .arg("-I")
        .arg(root().join("include"))
        .arg(&file)
        .output()
        .unwrap_or_else(|error| panic!("{compiler} is needed for this test: {error}"));
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

#[test]
fn the_header_is_that_of_the_sources() {
    let expected = generated();
    if std::env::var_os("BLADESMITH_UPDATE_HEADER").is_some_and(|value| value == "1") {
        fs::write(header_path(), &expected).expect("the header can be written");
    }
    let committed = fs::read_to_string(header_path()).unwrap_or_default();
    let differs = expected.lines().zip(committed.lines()).position(|(a, b)| a != b);
    assert!(
        expected == committed,
        "include/bladesmith/bladesmith.h is not that of src/ffi (first difference at line {}): \
         run BLADESMITH_UPDATE_HEADER=1 cargo test --test rooms header",
        differs.unwrap_or_else(|| expected.lines().count().min(committed.lines().count())) + 1
    );
}

fn installed(compiler: &str) -> bool {
    Command::new(compiler).arg("--version").output().is_ok()
}

#[test]
fn c99_and_cpp17_take_the_headers_alone_and_twice() {
    for (header, extension, standard, compilers) in [
        ("bladesmith.h", "c", "-std=c99", ["gcc", "clang"]),
        ("bladesmith.h", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("bladesmith.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("bladesmith.hpp", "cpp", "-std=c++20", ["g++", "clang++"]),
        ("core.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("results.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("curve.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("fillet.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("section.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
        ("surface.hpp", "cpp", "-std=c++17", ["g++", "clang++"]),
    ] {
        let twice = format!("#include <bladesmith/{header}>\n").repeat(2) + "int unused;\n";
        for (number, compiler) in compilers.into_iter().enumerate() {
            if number > 0 && !installed(compiler) {
                println!("skipped: {compiler} is not installed");
                continue;
            }
            compile(compiler, &[standard], &format!("alone_{header}_{compiler}.{extension}"), &twice)
                .unwrap_or_else(|why| panic!("{compiler} {standard} does not take {header}:\n{why}"));
        }
    }
}

#[test]
fn the_options_have_one_layout_in_c_and_rust_and_none_is_left_out_in_cpp() {
    macro_rules! checks {
        ($($field:ident),* $(,)?) => {
            [$((stringify!($field), std::mem::offset_of!(MorphOptions, $field))),*]
        };
    }
    let fields = checks!(
        size,
        factor,
        tolerance_mm,
        match_tolerance_mm,
        field_unit_mm,
        displacement_scale,
        solid,
        extrapolate,
        holdout,
        threads,
        moving_faces,
        moving_count,
        fixed_faces,
        fixed_count,
        face_names,
        face_names_count,
        solid_name,
    );
    let cpp = fs::read_to_string(root().join("include/bladesmith/bladesmith.hpp")).expect("it is committed");
    let mut source = String::from("#include <bladesmith/bladesmith.h>\n");
    for (field, offset) in fields {
        let passed = field == "size" || cpp.contains(&format!(" c.{field} = "));
        assert!(passed, "bladesmith.hpp does not pass {field} on");
        source += &format!(
            "_Static_assert(offsetof(bladesmith_morph_options, {field}) == {offset}, \"{field}\");\n"
        );
    }
    let size = size_of::<MorphOptions>();
    source += &format!("_Static_assert(sizeof(bladesmith_morph_options) == {size}, \"size\");\n");
    compile("gcc", &["-std=c11"], "layout.c", &source).expect("C and Rust agree on the options");
}

/// Comment and declaration of every function of the header.
fn documented_functions(header: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for block in header.split("/**").skip(1) {
        let Some((comment, rest)) = block.split_once("*/") else { continue };
        let Some((declaration, _)) = rest.trim_start().split_once(';') else { continue };
        let is_function = declaration.contains("bladesmith_") && declaration.contains('(');
        if is_function && !declaration.contains(['{', '#']) && !declaration.starts_with("typedef") {
            found.push((comment.to_owned(), declaration.to_owned()));
        }
    }
    found
}

#[test]
fn the_cpp_headers_cover_every_function() {
    let folder = root().join("include/bladesmith");
    let read = |name: &str| fs::read_to_string(folder.join(format!("{name}.hpp"))).expect("it is committed");
    let cpp = ["bladesmith", "core", "results", "curve", "fillet", "section", "surface"].map(read).concat();
    for (_, declaration) in documented_functions(&generated()) {
        let name = declaration.split('(').next().unwrap_or_default().rsplit([' ', '*']).next();
        assert!(name.is_some_and(|name| cpp.contains(name)), "the headers for C++ do not use {name:?}");
    }
}

#[test]
fn every_function_states_errors_and_where_it_applies_ownership_units_and_shapes() {
    let functions = documented_functions(&generated());
    assert_eq!(functions.len(), 104, "functions with a comment: {functions:#?}");
    for (comment, declaration) in functions {
        let pointers = declaration.contains('*');
        let arrays = declaration.contains("double *");
        for (needed, label) in [(true, "Errors:"), (pointers, "Owner:"), (arrays, "Units:"), (arrays, "[")] {
            assert!(
                !needed || comment.contains(label),
                "'{label}' is missing in the comment of {declaration}"
            );
        }
    }
}
