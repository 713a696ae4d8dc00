//! Building the C programs of this folder against the library of the running test, and running
//! them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The checkout.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A file of the test data.
pub fn data(name: &str) -> PathBuf {
    root().join("tests/consumer/data").join(name)
}

/// Where cargo puts the libraries that belong to this test: beside it.
pub fn library_folder() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows its path");
    test.parent().expect("it lies in a folder").to_owned()
}

/// A folder of its own for one test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ffi").join(name);
    fs::create_dir_all(&folder).expect("the scratch folder is writable");
    folder
}

/// How a program gets the library.
#[derive(Clone, Copy, PartialEq)]
pub enum Linkage {
    /// At run time, by its so-name.
    Shared,
    /// Into the program.
    Static,
}

/// Compiles `tests/consumer/c/{name}.c` into `folder`; what the compiler says where it cannot.
fn compile(name: &str, linkage: Linkage, flags: &[&str], folder: &Path) -> Result<PathBuf, String> {
    let program = folder.join(name);
    let library = library_folder();
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-D_POSIX_C_SOURCE=200809L", "-g", "-Wall", "-Wextra", "-pedantic", "-Werror"]);
    gcc.args(flags).arg("-I").arg(root().join("include"));
    gcc.arg(root().join(format!("tests/consumer/c/{name}.c"))).arg("-o").arg(&program);
    match linkage {
        Linkage::Shared => {
            let soname = folder.join("libbladesmith.so.1");
            let _ = fs::remove_file(&soname);
            std::os::unix::fs::symlink(library.join("libbladesmith.so"), &soname)
                .expect("the library can be linked to");
            gcc.arg(soname).arg(format!("-Wl,-rpath,{}", folder.display()));
        }
        Linkage::Static => {
            gcc.arg(library.join("libbladesmith.a")).args(["-lpthread", "-ldl", "-lm", "-lgcc_s"]);
        }
    }
    let output = gcc.output().unwrap_or_else(|error| panic!("gcc is needed for this test: {error}"));
    if output.status.success() { Ok(program) } else { Err(lossy(&output.stderr)) }
}

/// As [`compile`], for a program that must compile.
pub fn build(name: &str, linkage: Linkage, folder: &Path) -> PathBuf {
    compile(name, linkage, &[], folder).unwrap_or_else(|why| panic!("{name}.c does not compile:\n{why}"))
}

/// Output of a program as text.
pub fn lossy(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs a program to its end and fails with all that it said if that is not a good one.
pub fn succeed(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?} ended with {}\n{}{}",
        output.status,
        lossy(&output.stdout),
        lossy(&output.stderr)
    );
    output
}

/// The program with its arguments under valgrind; `None` where that is not installed.
pub fn valgrind(program: &Path) -> Option<Command> {
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("skipped: valgrind is not installed");
        return None;
    }
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--error-exitcode=99", "--leak-check=full"]);
    command
        .args(["--errors-for-leak-kinds=definite", "--show-leak-kinds=definite", "--num-callers=30"])
        .arg(program);
    Some(command)
}

/// The program built with the address sanitizer; `None` where gcc has none.
pub fn sanitized(name: &str, folder: &Path) -> Option<Command> {
    match compile(name, Linkage::Static, &["-fsanitize=address", "-fno-omit-frame-pointer"], folder) {
        Ok(program) => Some(Command::new(program)),
        Err(why) if why.contains("asan") => {
            println!("skipped: gcc has no address sanitizer here");
            None
        }
        Err(why) => panic!("{name}.c does not compile:\n{why}"),
    }
}
