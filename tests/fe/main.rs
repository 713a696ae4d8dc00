//! Reading fields: the small case with all its awkward variants, and hard files of every kind.

mod decks;
mod files;
mod formats;
mod mutation;
#[path = "../common/p5.rs"]
mod p5;
mod small_case;
mod tables;

use bladesmith::Error;
use bladesmith::fe::{self, Field, ReadOptions};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes a file that only one test uses.
fn file(name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fe");
    std::fs::create_dir_all(&folder).expect("a folder for test files");
    let path = folder.join(name);
    std::fs::write(&path, content).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
    path
}

/// A packed file of `tests/data`.
fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn packed(content: impl AsRef<[u8]>) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content.as_ref()).and_then(|()| encoder.finish()).expect("packing in memory")
}

fn read(path: &Path) -> Field {
    fe::read(path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn read_text(name: &str, content: impl AsRef<[u8]>) -> Field {
    read(&file(name, content))
}

fn read_with(path: &Path, mesh: &Path) -> bladesmith::Result<Field> {
    fe::read(path, &ReadOptions { mesh: Some(mesh.to_path_buf()), step: None })
}

fn read_step(path: &Path, step: usize) -> bladesmith::Result<Field> {
    fe::read(path, &ReadOptions { mesh: None, step: Some(step) })
}

/// The message with which a file is refused; it names the file.
fn refused(name: &str, content: impl AsRef<[u8]>) -> String {
    refusal(name, fe::read(&file(name, content), &ReadOptions::default()))
}

fn refusal(name: &str, result: bladesmith::Result<Field>) -> String {
    match result {
        Err(error @ Error::Field { .. }) => {
            let message = error.to_string();
            assert!(message.contains(name), "'{message}' does not name {name}");
            message
        }
        other => panic!("{name}: expected a refusal, got {:?}", other.map(|field| field.warnings)),
    }
}

/// Asserts that a message says all these things.
fn assert_says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "'{message}' does not say '{word}'");
    }
}

/// The only warning; panics if there are more or none.
fn the_warning(field: &Field) -> &str {
    let [warning] = field.warnings.as_slice() else {
        panic!("expected one warning, got {:?}", field.warnings)
    };
    warning
}

/// Asserts that two fields have the same nodes and displacements to the last bit.
fn assert_same(a: &Field, b: &Field) {
    assert_eq!(a.ids, b.ids);
    assert_eq!(a.points, b.points);
    let bits = |field: &Field| -> Vec<[u64; 3]> {
        field.displacements.iter().map(|u| u.to_array().map(f64::to_bits)).collect()
    };
    assert!(bits(a) == bits(b), "other displacements");
}
