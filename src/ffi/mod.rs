//! The C ABI: opaque handles, status numbers, texts and whole arrays; the only unsafe code.
//!
//! Doc comments of the exported functions are written for C: they become `bladesmith.h`, which
//! also states the conventions (`cbindgen.toml`). Plumbing (`guard`, `handle`, `status`, `slice`,
//! `text`, `progress`) apart, there is one file per noun.
//!
//! All pointers are the caller's promise: those that can be checked (NULL, alignment, length) are
//! checked, the rest (that the memory is there, that a handle is alive) cannot be.

// In C's comments `[n][3]` is the shape of an array.
#![allow(rustdoc::broken_intra_doc_links)]
// The header states, once for all functions, what a caller must hold.
#![allow(clippy::missing_safety_doc)]

pub mod check;
pub mod field;
mod guard;
mod handle;
pub mod library;
pub mod morph;
pub mod options;
pub mod part;
mod part_info;
pub mod progress;
mod slice;
pub mod spline;
pub mod status;
mod text;

pub use field::Field;
pub use morph::Morphed;
pub use options::MorphOptions;
pub use part::Part;
pub use progress::Progress;
pub use status::Status;
