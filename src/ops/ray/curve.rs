//! Rays and curves: the part of the ray next to the curve, intersected with it.

use super::{Hit, Ray, splat};
use crate::error::Result;
use crate::nurbs::{KnotVector, NurbsCurve, Point};
use crate::ops::intersect::{self, Intersections, Kind};

impl<P: Point> Ray<P> {
    /// All places where a curve is not further than `tolerance` from the ray, the nearest to its
    /// origin first. A stretch that runs along the ray is one hit, at its first point.
    ///
    /// # Errors
    /// As [`intersect::curves`].
    pub fn curve_hits(&self, curve: &NurbsCurve<P>, tolerance: f64) -> Result<Vec<Hit<f64, P>>> {
        intersect::check(tolerance)?;
        let first = curve.poles()[0];
        let ends = curve.poles().iter().fold([first; 2], |[low, high], &p| [low.min(p), high.max(p)]);
        let margin = splat::<P>(2.0 * tolerance);
        let Some([mut from, to]) = self.clip(ends[0] - margin, ends[1] + margin) else {
            return Ok(Vec::new());
        };
        let size = (ends[1] - ends[0]).length() + tolerance;
        // Only a ray that begins within the box ends on the curve.
        if from > self.from {
            from = (from - size).max(self.from);
        }
        let to = to + size;
        let segment = NurbsCurve::new(
            KnotVector::clamped(1, &[from, to])?,
            vec![self.point(from), self.point(to)],
            None,
        )?;
        let found = intersect::curves(&segment, curve, tolerance)?;
        Ok(self.hits(found, curve))
    }

    /// The first of [`Ray::curve_hits`].
    ///
    /// # Errors
    /// As [`Ray::curve_hits`].
    pub fn first_curve_hit(&self, curve: &NurbsCurve<P>, tolerance: f64) -> Result<Option<Hit<f64, P>>> {
        Ok(self.curve_hits(curve, tolerance)?.into_iter().next())
    }

    fn hits(&self, found: Intersections<P>, curve: &NurbsCurve<P>) -> Vec<Hit<f64, P>> {
        let hit = |[s, at]: [f64; 2], along: [f64; 2], kind: Kind| {
            let point = curve.point(at);
            Hit { s, along, at, point, distance: (point - self.point(s)).length(), kind }
        };
        let single = found.crossings.iter().map(|c| hit(c.at, [c.at[0]; 2], c.kind));
        let long = found.overlaps.iter().map(|o| hit([o.first[0], o.second[0]], o.first, Kind::Tangential));
        let mut hits: Vec<Hit<f64, P>> = single.chain(long).collect();
        hits.sort_by(|a, b| a.s.total_cmp(&b.s));
        hits
    }
}
