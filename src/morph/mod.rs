//! Morphing a whole solid by a displacement field: `x_out = x_in + factor · u(x_in)`.

pub mod options;
pub mod report;
pub mod space;
pub mod system;

pub use options::{Options, Progress};
pub use report::Report;

use crate::brep::Brep;
use crate::error::{Error, Result};
use crate::fe::Field;
use glam::DVec3;

/// A morphed solid and what is to be said about it.
#[derive(Debug, Clone)]
pub struct Morphed {
    /// The B-rep with new surfaces, curves, vertices and tolerances, same topology.
    pub brep: Brep,
    /// Figures, with the names users and checks rely on.
    pub report: Report,
    /// One entry per associated node and face, for colour maps.
    pub nodes: Vec<NodeResult>,
}

/// What became of one FE node on one face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeResult {
    /// The node's number in the FE model.
    pub id: i64,
    /// Face, from 1.
    pub face: u32,
    /// Foot point on the input solid, mm.
    pub foot: DVec3,
    /// Displacement applied there (`factor · u`), mm.
    pub displacement: DVec3,
    /// What the output surface misses there: `S' − (S + factor · u)`, mm.
    pub deviation: DVec3,
}

/// Morphs one solid of `brep` by `field`.
///
/// # Errors
/// See [`Error`]; nothing is returned that does not hold together.
pub fn morph(brep: &Brep, field: &Field, options: &Options, progress: Progress<'_>) -> Result<Morphed> {
    let _ = (brep, field, options, progress);
    Err(Error::Internal { why: "not there yet".into() })
}
