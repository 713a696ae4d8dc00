//! How a field lies on a part, before anything is fitted.

use super::associate::Match;
use super::measure::spread;
use super::options::Options;
use super::progress::Progress;
use super::report::Spread;
use super::run::{Task, place};
use super::warnings::Warnings;
use crate::brep::Brep;
use crate::error::Result;
use crate::fe::Field;
use serde::Serialize;
use std::collections::BTreeSet;

/// How the nodes lie on the part, under the names of the JSON. Lengths in mm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Placement {
    /// Nodes that were looked for on the faces.
    pub nodes: usize,
    /// Those that lie on faces.
    pub nodes_on_faces: usize,
    /// Nodes of the mesh's surface that lie on no face.
    pub unmatched_nodes: usize,
    /// Distance of the nodes to their faces.
    pub foot_mm: Spread,
    /// How far a node may lie off.
    pub match_tolerance_mm: f64,
    /// Faces, from 1, without a node.
    pub faces_without_nodes: Vec<usize>,
    /// What a morph would warn of before it fits.
    pub warnings: Vec<String>,
}

/// Goes through the first part of a [`morph`](super::morph), until field and part are known to
/// belong together.
///
/// # Errors
/// Those that a morph would end with so far.
pub fn check(brep: &Brep, field: &Field, options: &Options, progress: Progress<'_>) -> Result<Placement> {
    let mut warnings = Warnings::of_field(&field.warnings);
    let (selected, fixed) = place(brep, field, options, &mut warnings, progress)?;
    let matches = Task::new(&selected, fixed, options, &mut warnings)?.matches;
    let nodes: BTreeSet<u32> = matches.iter().map(|m| m.node).collect();
    let faces: BTreeSet<u32> = matches.iter().map(|m| m.face).collect();
    Ok(Placement {
        nodes: selected.nodes.usable.len(),
        nodes_on_faces: nodes.len(),
        unmatched_nodes: selected.association.unmatched.len(),
        foot_mm: spread(matches.iter().map(|m: &Match| m.foot.distance)),
        match_tolerance_mm: selected.nodes.match_tolerance_mm,
        faces_without_nodes: (0..selected.hot.faces.len())
            .filter(|f| !faces.contains(&(*f as u32)))
            .map(|f| f + 1)
            .collect(),
        warnings: warnings.into_texts(),
    })
}
