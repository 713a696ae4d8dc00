//! Morphing solids: exact affine fields, smooth fields, the awkward small cases, refusals,
//! determinism, and parts of unusual size, place and mesh.

mod affine;
mod cancel;
mod check;
mod determinism;
mod errors;
mod fields;
mod held;
mod judge;
#[path = "../common/p5.rs"]
mod p5;
mod p5_cases;
mod robustness;
mod smooth;
mod solids;

use bladesmith::Error;
use bladesmith::brep::Brep;
use bladesmith::fe::Field;
use bladesmith::morph::{Morphed, Options, morph};

/// Morphs and panics with the message where that is refused.
fn run(brep: &Brep, field: &Field, options: &Options) -> Morphed {
    morph(brep, field, options, &|_, _| true).unwrap_or_else(|error| panic!("{error}"))
}

/// The error with which a morph is refused.
fn refusal(brep: &Brep, field: &Field, options: &Options) -> Error {
    match morph(brep, field, options, &|_, _| true) {
        Err(error) => error,
        Ok(done) => panic!("not refused; warnings {:?}", done.report.warnings),
    }
}

/// Asserts that a message says all these things.
fn assert_says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "'{message}' does not say '{word}'");
    }
}

/// Asserts that one of the warnings says all these things.
fn assert_warns(done: &Morphed, words: &[&str]) {
    let says = |w: &&String| words.iter().all(|word| w.contains(word));
    let warnings = &done.report.warnings;
    assert!(warnings.iter().find(says).is_some(), "no warning says {words:?}: {warnings:#?}");
}
