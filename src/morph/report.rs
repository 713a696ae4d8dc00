//! The figures of a morph, under the names that users and checks rely on. Lengths in mm, angles
//! in degrees.

use serde::Serialize;

/// Mean and largest value of a quantity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub max: f64,
}

/// A quantity on the input and on the output solid.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Change<T> {
    /// On the input.
    pub before: T,
    /// On the output.
    pub after: T,
}

/// Program name and version.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tool {
    /// `bladesmith`.
    pub name: String,
    /// Release.
    pub version: String,
}

/// What went in.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Input {
    /// The solid.
    pub solid: String,
    /// The field file.
    pub field: String,
    /// Result step used, from 1.
    pub step: usize,
    /// Factor on the displacement.
    pub factor: f64,
    /// Nodes of the field.
    pub nodes: usize,
}

/// One face.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct FaceReport {
    /// Number, from 1.
    pub index: usize,
    /// Name, `Face7` where it has none.
    pub name: String,
    /// Degrees in u and v.
    pub degree: [usize; 2],
    /// Poles in u and v.
    pub poles: [usize; 2],
    /// Whether weights differ.
    pub rational: bool,
    /// Associated nodes.
    pub nodes: usize,
    /// Distance of the nodes to the hot face.
    pub foot_mm: Spread,
    /// |S' − (S + factor·U)| at the feet.
    pub deviation_mm: Spread,
    /// Distance of the target points to the new face, re-projected.
    pub distance_mm: Spread,
    /// Deviation at nodes kept out of a second fit.
    pub holdout_mm: Option<Spread>,
    /// Non-empty knot spans.
    pub spans: usize,
    /// Spans without a node, which the regularisation filled.
    pub spans_filled: usize,
    /// Singular values cut; 0 for regularised fits.
    pub rank_cut: usize,
    /// Knots inserted in both directions.
    pub knots_inserted: usize,
    /// Whether the field or the user holds this face still.
    pub held: bool,
}

/// One edge between two faces (or one face and itself, at a seam).
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct EdgeReport {
    /// Number, from 1.
    pub index: usize,
    /// The two faces, from 1.
    pub faces: [usize; 2],
    /// Largest distance among curve and traces.
    pub gap_mm: Change<f64>,
    /// Largest angle between the normals.
    pub angle_deg: Change<f64>,
    /// Whether the joint was tangent.
    pub tangent: bool,
    /// Whether a held face meets here.
    pub held: bool,
}

/// The solid as a whole.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct SolidReport {
    /// Open CASCADE's verdict; `None` where nobody asked it.
    pub valid: Option<bool>,
    /// Every edge has two uses.
    pub closed: bool,
    /// Number of faces.
    pub faces: usize,
    /// Samples where a normal turned against the input's.
    pub folded: usize,
    /// Volume.
    pub volume_mm3: Change<f64>,
    /// Area.
    pub area_mm2: Change<f64>,
    /// Centroid.
    pub centroid_mm: Change<[f64; 3]>,
    /// Largest tolerance of an edge or vertex.
    pub tolerance_mm: Change<f64>,
}

/// Wall-clock time by stage.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Reading solid and field.
    pub read: f64,
    /// Nodes to faces.
    pub associate: f64,
    /// The fit.
    pub fit: f64,
    /// The new B-rep and the checks on it.
    pub rebuild: f64,
    /// Writing.
    pub write: f64,
    /// All together.
    pub total: f64,
}

/// Everything said about a morph.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Program.
    pub tool: Tool,
    /// Input.
    pub input: Input,
    /// Faces in the solid's order.
    pub faces: Vec<FaceReport>,
    /// Edges in the solid's order.
    pub edges: Vec<EdgeReport>,
    /// Deviation over all nodes.
    pub deviation_mm: Spread,
    /// Hold-out error over all nodes kept out.
    pub holdout_mm: Option<Spread>,
    /// Surface nodes that lie on no face.
    pub unmatched_nodes: usize,
    /// The solid.
    pub solid: SolidReport,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Times.
    pub seconds: Seconds,
}
