//! Areas of the part where the field has no nodes.

use super::associate::Match;
use super::hot::Hot;
use glam::DVec2;
use rayon::prelude::*;
use rstar::{RTree, primitives::GeomWithData};

/// Samples of a face's box along each direction.
const SAMPLES: usize = 24;
/// How far the field may be extended, in node spacings.
const REACH: f64 = 3.0;
/// Nodes looked at to find one on the face or beside it.
const CANDIDATES: usize = 40;

/// What of a face has no nodes nearby.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Uncovered {
    /// The face.
    pub face: usize,
    /// Area without nodes, mm².
    pub area_mm2: f64,
    /// Fraction of the face's area.
    pub fraction: f64,
}

/// The faces with areas farther than three node spacings from any node on them or on a
/// neighbour.
pub fn uncovered(hot: &Hot, matches: &[Match], spacings: &[f64]) -> Vec<Uncovered> {
    let neighbours = neighbours(hot);
    let entries: Vec<_> = matches
        .iter()
        .zip(spacings)
        .map(|(m, s)| GeomWithData::new(m.foot.point.to_array(), (m.face, *s)))
        .collect();
    let tree = RTree::bulk_load(entries);
    let one = |face: usize| {
        let (mut bare, mut total) = (0.0, 0.0);
        for (uv, area) in samples(hot, face) {
            let p = hot.patches[hot.faces[face].patch].hot.point(uv.x, uv.y);
            // Nodes crowd around small features: one farther off, in the coarser mesh, may cover more.
            let covered = tree
                .nearest_neighbor_iter_with_distance_2(&p.to_array())
                .take(CANDIDATES)
                .filter(|(e, _)| neighbours[face].contains(&(e.data.0 as usize)))
                .any(|(e, d)| d.sqrt() <= REACH * e.data.1.max(1e-9));
            total += area;
            bare += if covered { 0.0 } else { area };
        }
        Uncovered { face, area_mm2: bare, fraction: if total > 0.0 { bare / total } else { 0.0 } }
    };
    (0..hot.faces.len()).into_par_iter().map(one).filter(|u| u.area_mm2 > 0.0).collect()
}

/// Each face with those it shares an edge with.
fn neighbours(hot: &Hot) -> Vec<Vec<usize>> {
    let mut out: Vec<Vec<usize>> = (0..hot.faces.len()).map(|f| vec![f]).collect();
    for joint in &hot.joints {
        if let [a, b] = &joint.sides[..] {
            out[a.face].push(b.face);
            out[b.face].push(a.face);
        }
    }
    out
}

/// Points inside a face with the area each stands for, mm².
pub fn samples(hot: &Hot, face: usize) -> Vec<(DVec2, f64)> {
    let f = &hot.faces[face];
    let (low, high) = (f.trim.low(), f.trim.high());
    let step = (high - low) / SAMPLES as f64;
    let mut out = Vec::new();
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let uv = low + step * DVec2::new(i as f64 + 0.5, j as f64 + 0.5);
            if f.trim.contains(uv) {
                let [_, du, dv] = hot.patches[f.patch].hot.first_derivatives(uv.x, uv.y);
                out.push((uv, du.cross(dv).length() * step.x * step.y));
            }
        }
    }
    out
}
