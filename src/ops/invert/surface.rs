//! The nearest points of a surface, globally: branch and bound over its Bézier pieces.
//!
//! A prism around each piece bounds the distance from below; a foot on a piece is the only nearest
//! point there within a distance that the change of its tangents gives ([`super::patch`]); beyond
//! it the piece is halved. The descent that Newton steps alone promise (*The NURBS Book*, section
//! 6.1) is local and depends on its start.

use super::batch::nearest_many;
use super::bezier::surface_pieces;
use super::patch::{Hull, Patch};
use super::search::{Index, Search, Shape, stationary};
use super::taylor::Powers;
use super::tree::Bounds;
use super::{Nearest, SAME, check_size};
use crate::error::Result;
use crate::nurbs::NurbsSurface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Halvings of a piece while preparing: more are left to the query that needs them.
const DEPTH: usize = 8;
/// Points that one thread takes at a time.
const CHUNK: usize = 4096;

/// Finds the nearest points of one surface; made once, asked often.
#[derive(Debug, Clone)]
pub struct SurfaceInverter {
    surface: NurbsSurface,
    powers: [Powers; 2],
    index: Index<Self>,
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
        let first = surface.poles()[0];
        let extent = surface.poles().iter().map(|x| x.distance(first)).fold(0.0, f64::max);
        Ok(Self { surface, powers, index: Index::new(patches), extent })
    }

    /// The surface.
    pub fn surface(&self) -> &NurbsSurface {
        &self.surface
    }

    /// The nearest point to `p`, globally; `p` of a size that [`check_size`] allows.
    pub fn nearest(&self, p: DVec3) -> Nearest<DVec2, DVec3> {
        Search::new(self, &self.index, p, None).run().best
    }

    /// All points of the surface that are as near to `p` as the nearest, to within `tie_mm`, the
    /// nearest first. Where a whole curve or area is, some of its points.
    pub fn nearest_all(&self, p: DVec3, tie_mm: f64) -> Vec<Nearest<DVec2, DVec3>> {
        Search::new(self, &self.index, p, Some(tie_mm)).run().ties()
    }

    /// The nearest points to many, in their order. Points that lie together in space share what is
    /// found out about one of them.
    pub fn nearest_many(&self, points: &[DVec3]) -> Vec<Nearest<DVec2, DVec3>> {
        nearest_many(self, &self.index, points)
    }

    /// As [`Self::nearest_many`], on all threads of the current pool.
    pub fn nearest_many_parallel(&self, points: &[DVec3]) -> Vec<Nearest<DVec2, DVec3>> {
        points.par_chunks(CHUNK).flat_map_iter(|chunk| self.nearest_many(chunk)).collect()
    }
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

    fn bounds(patch: &Patch) -> Bounds {
        patch.bounds
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
