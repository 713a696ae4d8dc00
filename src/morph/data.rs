//! What each patch has to follow: displacements at feet, with the local node spacing.

use super::associate::Match;
use super::hot::Hot;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use rstar::{RTree, primitives::GeomWithData};

/// Which neighbour's distance stands for the spacing: in a triangular net six are equally near.
const NEIGHBOUR: usize = 3;

/// Feet closer than this are one place, mm.
const COINCIDENT_MM: f64 = 1e-9;

/// One datum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// Where on the patch.
    pub uv: DVec2,
    /// The displacement wanted there, mm.
    pub target: DVec3,
    /// Distance between nodes around here, mm.
    pub spacing: f64,
    /// Weight of the square; 1 at first.
    pub weight: f64,
}

/// The data of one patch.
#[derive(Debug, Clone, Default)]
pub struct PatchData {
    /// Data, in the order of the matches.
    pub data: Vec<Datum>,
    /// Median spacing, mm; that of the whole solid without data.
    pub spacing: f64,
}

/// Distance from each match's foot to its third neighbour on the same face, mm; among the nodes of
/// the whole solid where the face has too few of its own.
pub fn spacings(hot: &Hot, matches: &[Match]) -> Vec<f64> {
    let tree_of = |own: &[Match]| {
        RTree::bulk_load(own.iter().map(|m| GeomWithData::new(m.foot.point.to_array(), ())).collect())
    };
    let all = std::sync::OnceLock::new();
    let per_face: Vec<Vec<f64>> = (0..hot.faces.len() as u32)
        .into_par_iter()
        .map(|face| {
            let range =
                matches.partition_point(|m| m.face < face)..matches.partition_point(|m| m.face <= face);
            let own = &matches[range];
            let tree = tree_of(own);
            let nth = |m: &Match| {
                third_neighbour(&tree, m).or_else(|| third_neighbour(all.get_or_init(|| tree_of(matches)), m))
            };
            own.par_iter().map(|m| nth(m).unwrap_or(0.0)).collect()
        })
        .collect();
    per_face.concat()
}

/// Distance to the third of the nearest nodes, mm. Those that coincide with the match, itself the
/// first, tell nothing.
fn third_neighbour(tree: &RTree<GeomWithData<[f64; 3], ()>>, m: &Match) -> Option<f64> {
    let neighbours = tree.nearest_neighbor_iter_with_distance_2(&m.foot.point.to_array());
    let mut apart = neighbours.map(|n| n.1).filter(|d| *d > COINCIDENT_MM * COINCIDENT_MM);
    apart.nth(NEIGHBOUR - 1).map(f64::sqrt)
}

/// Collects the data of every patch; `target` gives the displacement wanted at a match, or none
/// where the match is not to be used.
pub fn collect(
    hot: &Hot,
    matches: &[Match],
    spacings: &[f64],
    target: impl Fn(&Match) -> Option<DVec3>,
) -> Vec<PatchData> {
    let mut out = vec![PatchData::default(); hot.patches.len()];
    for (m, &spacing) in matches.iter().zip(spacings) {
        if let Some(target) = target(m) {
            out[hot.faces[m.face as usize].patch].data.push(Datum {
                uv: m.foot.uv,
                target,
                spacing,
                weight: 1.0,
            });
        }
    }
    let of_all = median(spacings.iter().copied()).unwrap_or(1.0);
    for patch in &mut out {
        patch.spacing = median(patch.data.iter().map(|d| d.spacing)).unwrap_or(of_all);
    }
    out
}

/// The median of the positive values.
fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.filter(|s| *s > 0.0).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}
