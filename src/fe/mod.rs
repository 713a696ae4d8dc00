//! Finite-element meshes and displacement fields.

use glam::DVec3;

/// A displacement field on the nodes of an FE mesh, as read (no unit applied).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Field {
    /// Where it came from, for messages.
    pub name: String,
    /// Node numbers, ascending.
    pub ids: Vec<i64>,
    /// Node coordinates in the file's unit, as many as `ids`.
    pub points: Vec<DVec3>,
    /// Displacements in the file's unit, as many as `ids`; NaN where a node has no result.
    pub displacements: Vec<DVec3>,
    /// Nodes on the mesh's surface as indices into `ids`, ascending; `None` without elements.
    pub surface_nodes: Option<Vec<u32>>,
    /// Corner nodes of each mid-side node on the surface: (mid-side, corner, corner), as indices.
    pub mid_sides: Vec<[u32; 3]>,
    /// Result step used, from 1, and how many the file has.
    pub step: usize,
    /// Number of steps with displacements.
    pub steps: usize,
    /// What the user should know.
    pub warnings: Vec<String>,
}
