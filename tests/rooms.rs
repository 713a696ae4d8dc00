//! Every test that has a file of its own in this folder, as one program: linked once, which takes
//! as long as all other work of building them.

mod brep;
mod brep_malformed;
mod ffi;
mod header;
mod invert;
mod layering;
mod p5_files;
mod package;
