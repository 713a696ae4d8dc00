//! The tests of this folder as one program: linking a program takes longer than compiling its tests.
//! What is neither here nor in Cargo.toml is not run; a test of `layering.rs` looks for it.

#[path = "accuracy/main.rs"]
mod accuracy;
mod brep;
mod brep_malformed;
mod ffi;
mod fillet;
mod header;
#[path = "intersect/main.rs"]
mod intersect;
mod invert;
mod layering;
mod offset;
mod p5_files;
mod package;
mod ray;
mod section;
