//! Where a displacement needs finer knots, and how many it may have.

use super::hot::Patch;
use super::space::Space;
use super::surface_fit::Cells;
use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::ops::approximate::Breaks;

/// Nodes for each pole at least, on faces whose poles a user edits.
const NODES_PER_POLE: usize = 3;
/// Fraction of the allowed poles that a converted surface may start with and still be held to it.
const ROOM: f64 = 0.8;
/// Cells for each node at most, on faces whose poles nobody edits.
const CELLS_PER_NODE: usize = 2;
/// Growth of a patch whose poles are the user's own and fine already.
const OWN_GROWTH: usize = 4;
/// A net with fewer poles than one for so many nodes is coarse: it may grow more.
const COARSE: usize = 64;

/// How far a patch may be refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limit {
    /// Poles of the morphed surface.
    poles: usize,
    /// Cells of the displacement.
    cells: usize,
}

impl Limit {
    /// For a patch with so many nodes. A net of the user's grows at most fourfold, or to one pole
    /// for three nodes if it is coarse; a converted or fillet surface, whose poles nobody edits,
    /// to two cells for each node.
    pub fn new(patch: &Patch, nodes: usize) -> Self {
        let (dense, start) = (nodes / NODES_PER_POLE, patch.hot.poles().len());
        let roomy = start as f64 <= ROOM * dense as f64;
        let (poles, cells) = match patch.user_poles {
            Some(own) if patch.own_poles && own * COARSE >= nodes => {
                (OWN_GROWTH * own, dense.min(OWN_GROWTH * patch.space.cells()))
            }
            Some(_) if patch.own_poles || roomy => (dense, usize::MAX),
            _ => (usize::MAX, CELLS_PER_NODE * nodes),
        };
        Self { poles: poles.max(start), cells }
    }

    fn allows(&self, space: &Space, hot: &NurbsSurface) -> Result<bool> {
        Ok(space.cells() <= self.cells && space.union(hot.knots_u(), hot.knots_v())?.poles() <= self.poles)
    }
}

/// Spans to halve in both directions, each with how much it is wanted; 0 is not at all.
#[derive(Debug, Clone)]
pub struct Marks {
    u: Vec<f64>,
    v: Vec<f64>,
}

impl Marks {
    /// None yet.
    pub fn new(cells: &Cells) -> Self {
        Self { u: vec![0.0; cells.us.len() - 1], v: vec![0.0; cells.vs.len() - 1] }
    }

    /// Marks the longer side of a cell unless its halves would be below `shortest`, mm.
    pub fn halve_longer(&mut self, cells: &Cells, hot: &NurbsSurface, k: usize, shortest: f64, wanted: f64) {
        let [a, b] = cells.sides(k, hot);
        let (i, j) = cells.place(k);
        if a.max(b) < 2.0 * shortest {
            return;
        }
        let span = if a >= b { &mut self.u[i] } else { &mut self.v[j] };
        *span = span.max(wanted);
    }

    /// The space with the most wanted spans halved, as many as the limit allows, at knots of the
    /// patch where some are near. None where nothing is wanted or allowed.
    ///
    /// # Errors
    /// As [`KnotVector::new`].
    pub fn refine(&self, space: &Space, hot: &NurbsSurface, limit: &Limit) -> Result<Option<Space>> {
        let wanted = |w: &[f64]| w.iter().copied().enumerate().filter(|m| m.1 > 0.0).collect::<Vec<_>>();
        let mut all: Vec<(f64, usize, usize)> = wanted(&self.u).into_iter().map(|(i, w)| (w, 0, i)).collect();
        all.extend(wanted(&self.v).into_iter().map(|(j, w)| (w, 1, j)));
        all.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        // The largest allowed number of them, by bisection: more spans never make fewer poles.
        let (mut none, mut too_many) = (0, all.len() + 1);
        let mut best = None;
        while too_many - none > 1 {
            let count =
                if best.is_none() && too_many == all.len() + 1 { all.len() } else { (none + too_many) / 2 };
            let finer = self.halve(space, hot, &all[..count])?;
            if limit.allows(&finer, hot)? {
                (none, best) = (count, Some(finer));
            } else {
                too_many = count;
            }
        }
        Ok(best)
    }

    fn halve(&self, space: &Space, hot: &NurbsSurface, chosen: &[(f64, usize, usize)]) -> Result<Space> {
        let halve =
            |k: &KnotVector, direction: usize, spans: usize, hot: &KnotVector| -> Result<KnotVector> {
                let mut marked = vec![false; spans];
                chosen.iter().filter(|c| c.1 == direction).for_each(|c| marked[c.2] = true);
                let mut breaks = Breaks { degree: k.degree(), at: k.breaks_and_multiplicities() };
                breaks.split_near(&marked, &hot.breaks());
                breaks.knots()
            };
        Ok(Space {
            ku: halve(&space.ku, 0, self.u.len(), hot.knots_u())?,
            kv: halve(&space.kv, 1, self.v.len(), hot.knots_v())?,
        })
    }
}
