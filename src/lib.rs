//! Bladesmith: geometry for turbomachinery blades.
//!
//! The main job is *hot to cold*: given a CAD solid and a displacement field from a finite-element
//! run on it, move the control points of every face so that the whole solid follows the field,
//! stays watertight, and keeps its tangent joints.
//!
//! Conventions: lengths are millimetres and angles radians, unless a name says otherwise
//! (`angle_deg`). Faces, edges and vertices are numbered from 1 where a user sees them and from 0
//! inside. Surfaces run over `u` first, then `v`; poles are stored with `v` fastest.
//!
//! Rooms, lowest first; each uses only those before it:
//! [`error`], [`tolerance`], [`linalg`], [`nurbs`], [`ops`], [`brep`] and [`fe`], [`morph`], [`ffi`].

#![deny(unsafe_code)]

pub mod brep;
pub mod error;
pub mod fe;
#[allow(unsafe_code)]
pub mod ffi;
pub mod linalg;
pub mod morph;
pub mod nurbs;
pub mod ops;
pub mod tolerance;

pub use error::{Error, Result};
