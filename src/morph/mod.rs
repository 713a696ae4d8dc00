//! Morphing a whole solid by a displacement field: `x_out = x_in + factor · u(x_in)`.
//!
//! Nodes are brought to the faces they lie on; the best affine motion is taken off; what remains
//! is fitted on all faces at once by least squares with a thin-plate regularisation, tied along
//! the edges; control points move by the sum. Based on Gaun, Huppertz and Bestle's
//! *Heiß-Kalt-Geometrietransformation* (least squares for control-point displacements), carried
//! from single surfaces to trimmed, watertight solids.

pub mod affine;
pub mod associate;
pub mod check;
pub mod coverage;
pub mod data;
pub mod fit;
pub mod hot;
pub mod links;
pub mod locate;
pub mod mass;
pub mod measure;
pub mod nodes;
pub mod options;
pub mod pieces;
pub mod planar;
pub mod progress;
pub mod rebuild;
pub mod refine;
pub mod report;
pub mod represent;
mod run;
pub mod select;
pub mod space;
mod summary;
pub mod surface_fit;
pub mod system;
pub mod trim;
mod warnings;

pub use check::check;
pub use options::Options;
pub use progress::Progress;
pub use report::Report;
pub use run::morph;

use crate::brep::Brep;
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
