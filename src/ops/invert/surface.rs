//! The nearest points of a surface, globally: branch and bound over its Bézier pieces.
//!
//! A box around each piece bounds the distance from below; a foot on a piece is the only nearest
//! point there within a distance that the change of its tangents gives ([`super::patch`]); beyond
//! it the piece is halved. The descent that Newton steps alone promise (*The NURBS Book*, section
//! 6.1) is local and depends on its start.

use super::bezier::surface_pieces;
use super::patch::{Hull, Patch};
use super::search::{Search, Shape, stationary};
use super::taylor::Powers;
use super::tree::Tree;
use super::{Nearest, SAME, check_size};
use crate::error::Result;
use crate::nurbs::NurbsSurface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Halvings of a piece while preparing: more are left to the query that needs them.
const DEPTH: usize = 6;
/// Bits of a cell's number along each axis.
const BITS: u32 = 10;
/// Cells along the longest axis.
const CELLS: f64 = (1 << BITS) as f64 - 1.0;
/// Points that one thread takes at a time.
const CHUNK: usize = 4096;

/// Finds the nearest points of one surface; made once, asked often.
#[derive(Debug, Clone)]
pub struct SurfaceInverter {
    surface: NurbsSurface,
    powers: [Powers; 2],
    patches: Vec<Patch>,
    hulls: Vec<Hull>,
    tree: Tree,
    extent: f64,
}

impl SurfaceInverter {
    /// Prepares a surface.
    ///
    /// # Errors
    /// As [`NurbsSurface::insert_knot`] and [`check_size`].
    pub fn new(surface: &NurbsSurface) -> Result<Self> {
        check_size(surface.poles())?;
        let surface = surface.clamped()?;
        let powers = [surface.knots_u(), surface.knots_v()].map(|knots| Powers::new(knots.degree()));
        let rational = surface.weights().is_some();
        let both = powers.each_ref();
        let pieces = surface_pieces(&surface)?;
        let mut patches = Vec::with_capacity(2 * pieces.len());
        let mut rest = Vec::new();
        for piece in pieces {
            rest.push(Patch::new(piece, both, rational, 0));
            while let Some(patch) = rest.pop() {
                if patch.is_flat() || patch.depth >= DEPTH {
                    patches.push(patch);
                } else {
                    rest.extend(patch.halves(both, rational));
                }
            }
        }
        let tree = Tree::new(&mut patches, |patch| patch.hull.bounds());
        let hulls = patches.iter().map(|patch| patch.hull).collect();
        let first = surface.poles()[0];
        let extent = surface.poles().iter().map(|x| x.distance(first)).fold(0.0, f64::max);
        Ok(Self { surface, powers, patches, hulls, tree, extent })
    }

    /// The surface.
    pub fn surface(&self) -> &NurbsSurface {
        &self.surface
    }

    /// The nearest point to `p`, globally; `p` of a size that [`check_size`] allows.
    pub fn nearest(&self, p: DVec3) -> Nearest<DVec2, DVec3> {
        self.search(p, None, None).best
    }

    /// All points of the surface that are as near to `p` as the nearest, to within `tie_mm`, the
    /// nearest first. Where a whole curve or area is, some of its points.
    pub fn nearest_all(&self, p: DVec3, tie_mm: f64) -> Vec<Nearest<DVec2, DVec3>> {
        self.search(p, Some(tie_mm), None).ties()
    }

    /// The nearest points to many, in their order. Points that lie together in space share what is
    /// found out about one of them.
    pub fn nearest_many(&self, points: &[DVec3]) -> Vec<Nearest<DVec2, DVec3>> {
        let order = coherent(points);
        let mut found = vec![None; points.len()];
        let mut last = None;
        for k in order {
            last = Some(self.search(points[k], None, last).best);
            found[k] = last;
        }
        found.into_iter().flatten().collect()
    }

    /// As [`Self::nearest_many`], on all threads of the current pool.
    pub fn nearest_many_parallel(&self, points: &[DVec3]) -> Vec<Nearest<DVec2, DVec3>> {
        points.par_chunks(CHUNK).flat_map_iter(|chunk| self.nearest_many(chunk)).collect()
    }

    fn search(
        &self,
        p: DVec3,
        tie_mm: Option<f64>,
        known: Option<Nearest<DVec2, DVec3>>,
    ) -> Search<'_, Self> {
        let mut search = Search::new(self, p, tie_mm, known);
        search.descend(&self.tree, &self.patches, &self.hulls);
        search
    }
}

/// An order in which neighbours in space follow each other: by cells of a grid around the points,
/// numbered by interleaving the bits of their coordinates (Morton 1966).
fn coherent(points: &[DVec3]) -> Vec<usize> {
    let around = |(low, high): (DVec3, DVec3), &p: &DVec3| (low.min(p), high.max(p));
    let (low, high) = points.iter().fold((DVec3::MAX, DVec3::MIN), around);
    let scale = CELLS / (high - low).max_element().max(f64::MIN_POSITIVE);
    let spread = |x: f64| {
        let bits = x as u64;
        (0..BITS).fold(0, |key, k| key | (bits >> k & 1) << (3 * k))
    };
    let key = |(k, &p): (usize, &DVec3)| {
        let cell = (p - low) * scale;
        (spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2, k)
    };
    let mut keys: Vec<(u64, usize)> = points.iter().enumerate().map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, k)| k).collect()
}

impl Shape for SurfaceInverter {
    type At = DVec2;
    type Point = DVec3;
    type Piece = Patch;
    type Hull = Hull;

    fn extent(&self) -> f64 {
        self.extent
    }

    fn hull(patch: &Patch) -> Hull {
        patch.hull
    }

    fn bound(hull: &Hull, p: DVec3) -> f64 {
        hull.nearest_squared(p)
    }

    fn size(patch: &Patch) -> f64 {
        patch.size
    }

    fn foot(&self, patch: &Patch, p: DVec3) -> (Nearest<DVec2, DVec3>, bool) {
        let foot = patch.foot(p);
        let only = patch.is_only(&foot, p);
        let (at, point) = patch.place(&foot);
        (Nearest { at, point, distance: (point - p).length() }, only)
    }

    fn halves(&self, patch: Patch) -> [Patch; 2] {
        patch.halves(self.powers.each_ref(), self.surface.weights().is_some())
    }

    fn is_minimum(&self, at: DVec2, p: DVec3) -> bool {
        let [s, u, v] = self.surface.first_derivatives(at.x, at.y);
        let r = s - p;
        stationary(at.x, self.surface.knots_u().domain(), r.dot(u), r.length() * u.length())
            && stationary(at.y, self.surface.knots_v().domain(), r.dot(v), r.length() * v.length())
    }

    fn same(&self, a: DVec2, b: DVec2) -> bool {
        let [ku, kv] = [self.surface.knots_u().domain(), self.surface.knots_v().domain()];
        ((a - b) / DVec2::new(ku.1 - ku.0, kv.1 - kv.0)).length() < SAME
    }
}
