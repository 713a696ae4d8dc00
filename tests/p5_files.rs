//! Writes the awkward field files of `common/p5.rs` for the tests of the command line, which are not
//! in Rust: into `p5/` of the build's folder for such files (`target/tmp`).

#[path = "common/p5.rs"]
mod p5;

use std::path::Path;

#[test]
fn every_variant_is_written_for_the_command_line_tests() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("p5");
    std::fs::create_dir_all(&folder).expect("a folder in target/tmp");
    for name in p5::VARIANTS {
        let path = folder.join(format!("{name}.frd"));
        let text = p5::variant(name);
        std::fs::write(&path, &text).expect("room for the file");
        let written = std::fs::read_to_string(&path).expect("the file just written");
        assert!(written == text, "{}: not what was written", path.display());
    }
}
