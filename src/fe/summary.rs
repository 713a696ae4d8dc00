//! What is in a field, in engineering terms.

use super::{Block, ElementCount, Field, Format, Step};
use crate::error::counted;
use glam::DVec3;
use serde::Serialize;

/// Displacements below this fraction of the model's size are suspiciously small: metres on a model
/// in millimetres, for example.
const SMALL: f64 = 1e-5;

/// A model whose diagonal is below this is taken to be in metres: no part that is worth a
/// finite-element run is so small in millimetres, and few are so large in metres.
const LARGEST_IN_METRES: f64 = 2.0;

/// Nodes that a morph needs at least: fewer do not even fix an affine motion.
const FEWEST: usize = 4;

/// Nodes within this fraction of their extent from a line lie in it.
const IN_LINE: f64 = 1e-4;

/// Why nodes with displacements at `points` are too few for a morph; none where they are enough.
pub(crate) fn shortage(points: impl Iterator<Item = DVec3>) -> Option<String> {
    let points: Vec<DVec3> = points.collect();
    let needed = format!("a morph needs at least {FEWEST} that do not lie in one line");
    if points.is_empty() {
        return Some("no node has a displacement".into());
    }
    if points.len() < FEWEST {
        return Some(format!("only {} with a displacement: {needed}", counted(points.len(), "node")));
    }
    let from_first = |p: &&DVec3| p.distance_squared(points[0]);
    let axis = points.iter().max_by(|a, b| from_first(a).total_cmp(&from_first(b)))? - points[0];
    let (length, axis) = (axis.length(), axis.normalize_or_zero());
    let beside = |p: &DVec3| (*p - points[0]).reject_from_normalized(axis).length() > IN_LINE * length;
    let lie = format!("the {} nodes with a displacement lie in one line: {needed}", points.len());
    (length == 0.0 || !points.iter().any(beside)).then_some(lie)
}

fn unit_guess(size: f64) -> Option<&'static str> {
    (size > 0.0).then_some(if size < LARGEST_IN_METRES { "m" } else { "mm" })
}

/// The largest displacement and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LargestDisplacement {
    /// Its length, in the file's unit.
    pub value: f64,
    /// The node.
    pub node: i64,
    /// The node's position.
    pub at: [f64; 3],
}

/// What is in a field; lengths in the file's unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldSummary {
    /// Where it came from.
    pub name: String,
    /// Kind of file.
    pub format: Format,
    /// Whether it is gzipped.
    pub compressed: bool,
    /// The deck that gave the coordinates.
    pub mesh: Option<String>,
    /// Blocks in the file's order.
    pub blocks: Vec<Block>,
    /// Steps with displacements, in the file's order.
    pub steps: Vec<Step>,
    /// Step used, from 1.
    pub step: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of nodes with a displacement.
    pub nodes_with_result: usize,
    /// Number of nodes on the mesh's surface, where elements tell.
    pub surface_nodes: Option<usize>,
    /// Number of elements of each kind.
    pub elements: Vec<ElementCount>,
    /// Smallest and largest coordinates.
    pub bounds: [[f64; 3]; 2],
    /// Unit that the size of the model suggests: `mm` or `m`; none where all nodes are in one place.
    pub unit_guess: Option<&'static str>,
    /// The largest displacement.
    pub largest_displacement: LargestDisplacement,
    /// What the user should know.
    pub warnings: Vec<String>,
}

impl Field {
    /// What is in the field, with the warnings of reading and of [`Field::magnitude_warnings`].
    pub fn summary(&self) -> FieldSummary {
        let [low, high] = self.bounds();
        let mut warnings = self.warnings.clone();
        warnings.extend(self.magnitude_warnings(1.0));
        let with_result = self.points.iter().zip(&self.displacements).filter(|(_, u)| !u.is_nan());
        warnings.extend(shortage(with_result.map(|(p, _)| *p)));
        FieldSummary {
            name: self.name.clone(),
            format: self.source.format,
            compressed: self.source.compressed,
            mesh: self.source.mesh.clone(),
            blocks: self.source.blocks.clone(),
            steps: self.source.steps.clone(),
            step: self.step,
            nodes: self.ids.len(),
            nodes_with_result: self.displacements.iter().filter(|u| !u.is_nan()).count(),
            surface_nodes: self.surface_nodes.as_ref().map(Vec::len),
            elements: self.source.elements.clone(),
            bounds: [low.into(), high.into()],
            unit_guess: unit_guess(low.distance(high)),
            largest_displacement: self.largest_displacement(),
            warnings,
        }
    }

    /// Smallest and largest coordinates of the nodes, in the file's unit.
    pub fn bounds(&self) -> [DVec3; 2] {
        let first = self.points.first().copied().unwrap_or_default();
        self.points.iter().fold([first; 2], |[low, high], &point| [low.min(point), high.max(point)])
    }

    /// The largest displacement in the file's unit; the first node of several equals.
    pub fn largest_displacement(&self) -> LargestDisplacement {
        let mut largest = LargestDisplacement { value: -1.0, node: 0, at: [0.0; 3] };
        for ((&node, &point), u) in self.ids.iter().zip(&self.points).zip(&self.displacements) {
            if u.length() > largest.value {
                largest = LargestDisplacement { value: u.length(), node, at: point.into() };
            }
        }
        LargestDisplacement { value: largest.value.max(0.0), ..largest }
    }

    /// What is suspicious about the size of the displacements, which `scale` multiplies, beside the
    /// size of the model: all zero, far too small, or larger than the model itself.
    pub fn magnitude_warnings(&self, scale: f64) -> Vec<String> {
        let [low, high] = self.bounds();
        let size = low.distance(high);
        let largest = self.largest_displacement();
        let moved = largest.value * scale.abs();
        let what = if moved == 0.0 {
            "all displacements are zero".to_string()
        } else if moved < SMALL * size {
            format!(
                "the displacements are very small, at most {moved:.3e} on a model of size {size:.3e}: \
                 perhaps they are in another unit than the coordinates"
            )
        } else if moved > size && size > 0.0 {
            format!(
                "the displacements are larger than the model: up to {moved:.3e} at node {} on a size of {size:.3e}; \
                 the morphed solid would be folded",
                largest.node
            )
        } else {
            return Vec::new();
        };
        vec![what]
    }
}
