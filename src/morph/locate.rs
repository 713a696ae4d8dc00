//! Where on which patch a point may lie: boxes around small cells of every patch, in an R-tree.

use crate::nurbs::{KnotVector, NurbsSurface};
use glam::{DVec2, DVec3};
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// Cells that a knot span is cut into along each direction.
const CUTS: usize = 2;

/// A piece of a patch and the box around it.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    /// Patch.
    pub patch: usize,
    /// Its middle in the parameter plane.
    pub middle: DVec2,
    /// Half its extent there.
    pub half: DVec2,
    low: DVec3,
    high: DVec3,
}

impl RTreeObject for Cell {
    type Envelope = AABB<[f64; 3]>;
    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.low.to_array(), self.high.to_array())
    }
}

impl PointDistance for Cell {
    fn distance_2(&self, p: &[f64; 3]) -> f64 {
        let p = DVec3::from_array(*p);
        (p - p.clamp(self.low, self.high)).length_squared()
    }
}

/// All cells of all patches.
#[derive(Debug)]
pub struct Cells {
    tree: RTree<Cell>,
}

impl Cells {
    /// Cuts each patch within its window (lower and upper corner in the parameter plane).
    pub fn new(patches: &[(&NurbsSurface, DVec2, DVec2)]) -> Self {
        let mut cells = Vec::new();
        for (patch, (surface, low, high)) in patches.iter().enumerate() {
            let us = cuts(surface.knots_u(), low.x, high.x);
            let vs = cuts(surface.knots_v(), low.y, high.y);
            add_cells(patch, surface, &us, &vs, &mut cells);
        }
        Self { tree: RTree::bulk_load(cells) }
    }

    /// Cells whose boxes come within `reach` of `p`.
    pub fn near(&self, p: DVec3, reach: f64) -> impl Iterator<Item = &Cell> {
        let corner = |s: f64| (p + DVec3::splat(s * reach)).to_array();
        self.tree.locate_in_envelope_intersecting(&AABB::from_corners(corner(-1.0), corner(1.0)))
    }

    /// Cells in the order of their boxes' distance from `p`.
    pub fn by_distance(&self, p: DVec3) -> impl Iterator<Item = (&Cell, f64)> {
        self.tree.nearest_neighbor_iter_with_distance_2(&p.to_array()).map(|(c, d)| (c, d.sqrt()))
    }
}

/// Parameters that cut the window at knots and between them.
fn cuts(knots: &KnotVector, low: f64, high: f64) -> Vec<f64> {
    let mut at = vec![low];
    at.extend(knots.breaks().into_iter().filter(|&k| k > low && k < high));
    at.push(high);
    let mut out = Vec::with_capacity(at.len() * CUTS);
    for w in at.windows(2) {
        out.extend((0..CUTS).map(|i| w[0] + (w[1] - w[0]) * i as f64 / CUTS as f64));
    }
    out.push(high);
    out
}

/// Boxes around 3×3 points of each cell, widened by twice the cell's sag: the middle of a smooth
/// arc lies a quarter of its sag beyond the chord of the half arcs.
fn add_cells(patch: usize, surface: &NurbsSurface, us: &[f64], vs: &[f64], out: &mut Vec<Cell>) {
    let half = |t: &[f64]| -> Vec<f64> {
        let mut h: Vec<f64> = t.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]).collect();
        h.extend(t.last());
        h
    };
    let (hu, hv) = (half(us), half(vs));
    let grid = surface.points_on_grid(&hu, &hv);
    let at = |i: usize, j: usize| grid[i * hv.len() + j];
    for i in (0..hu.len() - 1).step_by(2) {
        for j in (0..hv.len() - 1).step_by(2) {
            let points: [DVec3; 9] = std::array::from_fn(|k| at(i + k / 3, j + k % 3));
            let middle = points[4];
            let sag = |a: usize, b: usize| (0.5 * (points[a] + points[b]) - middle).length();
            let rim = |a: usize, m: usize, b: usize| (0.5 * (points[a] + points[b]) - points[m]).length();
            let sag = sag(0, 8).max(sag(2, 6)).max(sag(1, 7)).max(sag(3, 5));
            let rim = rim(0, 1, 2).max(rim(0, 3, 6)).max(rim(2, 5, 8)).max(rim(6, 7, 8));
            let margin = DVec3::splat(sag.max(rim) + 1e-9);
            let low = points.iter().fold(DVec3::MAX, |m, p| m.min(*p)) - margin;
            let high = points.iter().fold(DVec3::MIN, |m, p| m.max(*p)) + margin;
            let half = 0.5 * DVec2::new(hu[i + 2] - hu[i], hv[j + 2] - hv[j]);
            out.push(Cell { patch, middle: DVec2::new(hu[i + 1], hv[j + 1]), half, low, high });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops::approximate::{Breaks, Finest, surface};

    #[test]
    fn boxes_hold_the_surface() {
        let f = |u: f64, v: f64| Ok(DVec3::new((2.0 * u).cos() * 3.0, (2.0 * u).sin() * 3.0, v + u * u * v));
        let b = || Breaks::simple(5, &[0.0, 1.5, 3.0]);
        let (s, _) = surface(f, b(), b(), 1e-6, Finest::spans(60)).unwrap();
        let cells = Cells::new(&[(&s, DVec2::ZERO, DVec2::splat(3.0))]);
        for k in 0..5000 {
            let uv = DVec2::new((k as f64 * 0.7345).fract(), (k as f64 * 0.3127).fract()) * 3.0;
            let p = s.point(uv.x, uv.y);
            assert!(cells.near(p, 1e-9).next().is_some(), "no box holds the point at {uv}");
            assert!(cells.by_distance(p).next().unwrap().1 < 1e-9);
        }
    }
}
