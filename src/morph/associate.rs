//! Which node lies on which face, and where.

use super::hot::Hot;
use super::locate::Cells;
use super::trim::Metric;
use crate::ops::closest::{Foot, foot};
use glam::DVec3;
use rayon::prelude::*;

/// Edges of real solids gape by this much: a node this close to an edge lies on both its faces.
const EDGE_MM: f64 = 1e-4;
/// A mid-side node of a straight element side lies off a curved face by at most this fraction of
/// the side (a side over a quarter circle has 0.21).
const SAGITTA: f64 = 0.15;
/// Nodes looked at to say how far a foreign mesh is away.
const PROBES: usize = 200;

/// A node on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match {
    /// Index of the node.
    pub node: u32,
    /// The face.
    pub face: u32,
    /// Parameters and place of the foot on the face's patch.
    pub foot: Foot,
}

/// All matches, by face and then by node, and the nodes without one.
#[derive(Debug, Clone, Default)]
pub struct Association {
    /// Nodes on faces; a node on an edge appears on each face there.
    pub matches: Vec<Match>,
    /// Nodes of the mesh's surface that lie on no face.
    pub unmatched: Vec<u32>,
}

/// A foot that may count, with its distance outside the face's outline.
struct Candidate {
    node: u32,
    face: u32,
    foot: Foot,
    outside: f64,
}

/// Finds the faces of `nodes` (indices into `points`, mm) within `tolerance_mm`. Of `mid_sides`
/// (mid-side node and its two corners) those off the faces are taken to the faces of their
/// corners.
pub fn associate(
    hot: &Hot,
    points: &[DVec3],
    nodes: &[u32],
    mid_sides: &[[u32; 3]],
    tolerance_mm: f64,
) -> Association {
    let cells = cells(hot);
    let candidates: Vec<Vec<Candidate>> =
        nodes.par_iter().map(|&n| candidates(hot, &cells, n, points[n as usize], tolerance_mm)).collect();
    let near = near_mm(&candidates).min(tolerance_mm);
    let mut faces_of: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    let mut association = Association::default();
    for (node, found) in nodes.iter().zip(candidates) {
        let kept = keep(found, near);
        if kept.is_empty() {
            association.unmatched.push(*node);
        }
        faces_of[*node as usize] = kept.iter().map(|m| m.face).collect();
        association.matches.extend(kept);
    }
    rescue_mid_sides(hot, &cells, points, mid_sides, &faces_of, near, &mut association);
    association.matches.sort_by_key(|m| (m.face, m.node));
    association
}

fn cells(hot: &Hot) -> Cells {
    let windows: Vec<_> = hot.patches.iter().map(|p| (&p.hot, p.window[0], p.window[1])).collect();
    Cells::new(&windows)
}

/// Feet on every patch near the node, for each face on it.
fn candidates(hot: &Hot, cells: &Cells, node: u32, p: DVec3, reach: f64) -> Vec<Candidate> {
    let mut feet: Vec<(usize, Foot)> = Vec::new();
    for cell in cells.near(p, reach) {
        let known = |f: &&(usize, Foot)| {
            f.0 == cell.patch && (f.1.uv - cell.middle).abs().cmple(1.2 * cell.half).all()
        };
        if feet.iter().find(known).is_some() {
            continue;
        }
        let found = foot(&hot.patches[cell.patch].hot, p, cell.middle);
        let same = |f: &(usize, Foot)| f.0 == cell.patch && (f.1.point - found.point).length() < 1e-6;
        if found.distance <= reach && !feet.iter().any(same) {
            feet.push((cell.patch, found));
        }
    }
    let mut out = Vec::new();
    for (patch, foot) in feet {
        for &face in &hot.patches[patch].faces {
            let outside = outside(hot, face, &foot);
            if outside <= reach {
                out.push(Candidate { node, face: face as u32, foot, outside });
            }
        }
    }
    out
}

/// Distance of a foot outside its face, mm; 0 inside.
fn outside(hot: &Hot, face: usize, foot: &Foot) -> f64 {
    let face = &hot.faces[face];
    if face.trim.contains(foot.uv) {
        return 0.0;
    }
    let d = hot.patches[face.patch].hot.derivatives(foot.uv.x, foot.uv.y);
    face.trim.outline_distance(foot.uv, &Metric { uu: d.u.dot(d.u), uv: d.u.dot(d.v), vv: d.v.dot(d.v) })
}

/// How close counts as *on*: the gape of edges or the rounding of the node coordinates, seen as
/// four times the median distance.
fn near_mm(candidates: &[Vec<Candidate>]) -> f64 {
    let best = |c: &Vec<Candidate>| c.iter().map(|c| c.foot.distance).reduce(f64::min);
    let mut distances: Vec<f64> = candidates.iter().filter_map(best).collect();
    if distances.is_empty() {
        return EDGE_MM;
    }
    let middle = distances.len() / 2;
    let (_, median, _) = distances.select_nth_unstable_by(middle, f64::total_cmp);
    EDGE_MM.max(4.0 * *median)
}

/// The nearest face and those as near; one foot a face.
fn keep(mut found: Vec<Candidate>, near: f64) -> Vec<Match> {
    // Where an edge gapes wider than usual, the nearest face within reach still counts.
    let miss = |c: &Candidate| c.outside.max(c.foot.distance);
    let nearest = found.iter().map(miss).fold(f64::MAX, f64::min);
    found.retain(|c| c.outside <= near.max(nearest));
    let best = found.iter().map(|c| c.foot.distance).fold(f64::MAX, f64::min);
    found.retain(|c| c.foot.distance <= best + near);
    found.sort_by(|a, b| a.face.cmp(&b.face).then(a.foot.distance.total_cmp(&b.foot.distance)));
    found.dedup_by_key(|c| c.face);
    found.into_iter().map(|c| Match { node: c.node, face: c.face, foot: c.foot }).collect()
}

fn rescue_mid_sides(
    hot: &Hot,
    cells: &Cells,
    points: &[DVec3],
    mid_sides: &[[u32; 3]],
    faces_of: &[Vec<u32>],
    near: f64,
    association: &mut Association,
) {
    let mut lost: Vec<u32> = std::mem::take(&mut association.unmatched);
    lost.sort_unstable();
    let mut rescued = vec![false; points.len()];
    for &[middle, a, b] in mid_sides {
        if lost.binary_search(&middle).is_err() || rescued[middle as usize] {
            continue;
        }
        let common = |f: u32| faces_of[a as usize].contains(&f) && faces_of[b as usize].contains(&f);
        let reach = SAGITTA * (points[a as usize] - points[b as usize]).length();
        let mut found = candidates(hot, cells, middle, points[middle as usize], reach);
        found.retain(|c| common(c.face));
        let kept = keep(found, near);
        if !kept.is_empty() {
            rescued[middle as usize] = true;
            association.matches.extend(kept);
        }
    }
    lost.retain(|n| !rescued[*n as usize]);
    association.unmatched = lost;
}

/// Median distance of some of `nodes` from the part, mm: how far a foreign mesh is away.
pub fn typical_distance(hot: &Hot, points: &[DVec3], nodes: &[u32]) -> f64 {
    let cells = cells(hot);
    let step = (nodes.len() / PROBES).max(1);
    let mut distances: Vec<f64> = nodes
        .iter()
        .step_by(step)
        .map(|&n| {
            let p = points[n as usize];
            let mut best = f64::MAX;
            for (cell, bound) in cells.by_distance(p).take(20) {
                if bound < best {
                    best = best.min(foot(&hot.patches[cell.patch].hot, p, cell.middle).distance);
                }
            }
            best
        })
        .collect();
    distances.sort_by(f64::total_cmp);
    distances.get(distances.len() / 2).copied().unwrap_or(f64::NAN)
}
