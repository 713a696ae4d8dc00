//! The library as `make install` puts it, and the programs of this folder and of `examples` built
//! against it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// The checkout.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A file of the test data.
pub fn data(name: &str) -> PathBuf {
    root().join("tests/consumer/data").join(name)
}

/// An empty folder of its own for one test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("package").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the scratch folder is writable");
    folder
}

/// Output of a program as text.
pub fn lossy(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs a program to its end.
pub fn run(command: &mut Command) -> Output {
    command.output().unwrap_or_else(|error| panic!("{command:?} does not start: {error}"))
}

/// Runs a program to its end and fails with all that it said if that is not a good one.
pub fn succeed(command: &mut Command) -> Output {
    let output = run(command);
    assert!(
        output.status.success(),
        "{command:?} ended with {}\n{}{}",
        output.status,
        lossy(&output.stdout),
        lossy(&output.stderr)
    );
    output
}

/// Installs the library of the running test, which cargo puts beside it, below `prefix`.
pub fn install(prefix: &Path) {
    let test = std::env::current_exe().expect("a test knows its path");
    let built = test.parent().expect("it lies in a folder");
    succeed(Command::new(root().join("cmake/install.sh")).arg(prefix).arg(built));
}

/// Where the library is installed for all tests; its place has a space in its name and it was
/// moved there, as both must do no harm.
pub fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let folder = scratch("installed");
        install(&folder.join("first place"));
        fs::rename(folder.join("first place"), folder.join("moved prefix")).expect("it can be moved");
        folder.join("moved prefix")
    })
}

/// How the programs are built.
#[derive(Clone, Copy)]
pub enum Build {
    /// By the system's compilers.
    Plain,
    /// As plain, with the address sanitizer.
    Sanitized,
    /// By clang.
    Clang,
}

impl Build {
    fn options(self) -> (&'static str, &'static [&'static str]) {
        const SANITIZER: &str = "-fsanitize=address -fno-omit-frame-pointer";
        match self {
            Build::Plain => ("plain", &[]),
            Build::Sanitized => ("sanitized", &["CMAKE_C_FLAGS", SANITIZER, "CMAKE_CXX_FLAGS", SANITIZER]),
            Build::Clang => ("clang", &["CMAKE_C_COMPILER", "clang", "CMAKE_CXX_COMPILER", "clang++"]),
        }
    }

    /// The folder with the programs, built once.
    fn folder(self) -> &'static Path {
        static FOLDERS: [OnceLock<PathBuf>; 3] = [const { OnceLock::new() }; 3];
        FOLDERS[self as usize].get_or_init(|| {
            let (name, options) = self.options();
            let folder = scratch(name);
            let mut configure = configure(&root().join("tests/consumer/cmake"), &folder, prefix());
            for pair in options.chunks(2) {
                configure.arg(format!("-D{}={}", pair[0], pair[1]));
            }
            succeed(&mut configure);
            succeed(Command::new("cmake").arg("--build").arg(&folder));
            folder
        })
    }

    /// A program of `tests/consumer/cmake/CMakeLists.txt`, with the library shared and static.
    pub fn programs(self, name: &str) -> [PathBuf; 2] {
        ["shared", "static"].map(|linkage| self.folder().join(format!("{name}_{linkage}")))
    }
}

/// The command that configures a CMake project against an installed library.
pub fn configure(project: &Path, build: &Path, prefix: &Path) -> Command {
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(project).arg("-B").arg(build);
    cmake.arg(format!("-DCMAKE_PREFIX_PATH={}", prefix.display()));
    cmake
}

/// A program under valgrind.
pub fn valgrind(program: &Path) -> Command {
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--error-exitcode=99", "--leak-check=full", "--num-callers=30"]);
    command.args(["--errors-for-leak-kinds=definite", "--show-leak-kinds=definite"]).arg(program);
    command
}
