//! Rays and surfaces.

use super::frame::{Sight, View};
use super::{Hit, Ray};
use crate::error::{Error, Result};
use crate::nurbs::{Direction, NurbsSurface};
use crate::ops::intersect::{self, Kind};
use crate::ops::invert::bezier::{SurfacePiece, surface_pieces};
use glam::{DMat2, DVec2, DVec3};

/// A part whose extent across the ray is not above this part of the tolerance is a point.
const POINT: f64 = 0.25;
/// Parts looked at for one ray, at most.
const PARTS: usize = 400_000;
/// Places between two hits at which the surface is asked whether it stays on the ray.
const BETWEEN: usize = 6;
/// A hit grazes if it stays within the tolerance for so many times it.
const GRAZE: f64 = 60.0;
/// Sine of the angle below which a hit may be a graze.
const FLAT: f64 = 0.05;
/// Steps to the place where a ray grazes.
const STEPS: usize = 12;

/// Finds the hits of rays on one surface; made once, asked often.
#[derive(Debug, Clone)]
pub struct SurfaceCaster {
    surface: NurbsSurface,
    /// Bézier patches.
    pieces: Vec<SurfacePiece>,
    /// Boxes of the implicit binary tree over the patches: node `k` has the children `2k + 1` and
    /// `2k + 2`; leaves are the patches, from node `pieces.len() − 1` on.
    boxes: Vec<[DVec3; 2]>,
    /// Whether the sides of least and largest u are one, and those of v.
    closed: [bool; 2],
}

/// A place found.
#[derive(Debug, Clone, Copy)]
struct Place {
    sight: Sight,
    /// The part of the ray that its part of the surface is along.
    along: [f64; 2],
    /// Whether it is the one crossing of a part.
    crosses: bool,
}

impl SurfaceCaster {
    /// Prepares a surface.
    ///
    /// # Errors
    /// As [`NurbsSurface::insert_knot`].
    pub fn new(surface: &NurbsSurface) -> Result<Self> {
        let pieces = surface_pieces(surface)?;
        let inner = pieces.len() - 1;
        let mut boxes = vec![[DVec3::INFINITY, DVec3::NEG_INFINITY]; 2 * pieces.len() - 1];
        for (k, piece) in pieces.iter().enumerate() {
            let grown = |[low, high]: [DVec3; 2], p: DVec3| [low.min(p), high.max(p)];
            boxes[inner + k] = piece.points().fold(boxes[inner + k], grown);
        }
        for k in (0..inner).rev() {
            let ([a, b], [c, d]) = (boxes[2 * k + 1], boxes[2 * k + 2]);
            boxes[k] = [a.min(c), b.max(d)];
        }
        let closed = [Direction::U, Direction::V].map(|direction| is_closed(surface, direction));
        Ok(Self { surface: surface.clone(), pieces, boxes, closed })
    }

    /// All places where the surface is not further than `tolerance` from the ray, the nearest to
    /// its origin first, each point once. Where the ray grazes, or runs along the surface, the
    /// stretch within the tolerance is one hit.
    ///
    /// # Errors
    /// [`Error::Argument`] for a tolerance that is no positive number; [`Error::Numerics`] for one
    /// in the order of the surface's size.
    pub fn hits(&self, ray: &Ray<DVec3>, tolerance: f64) -> Result<Vec<Hit<DVec2, DVec3>>> {
        self.search(ray, tolerance, false)
    }

    /// The first of [`SurfaceCaster::hits`].
    ///
    /// # Errors
    /// As [`SurfaceCaster::hits`].
    pub fn first_hit(&self, ray: &Ray<DVec3>, tolerance: f64) -> Result<Option<Hit<DVec2, DVec3>>> {
        Ok(self.search(ray, tolerance, true)?.into_iter().next())
    }

    fn search(&self, ray: &Ray<DVec3>, tolerance: f64, first: bool) -> Result<Vec<Hit<DVec2, DVec3>>> {
        intersect::check(tolerance)?;
        let mut found: Vec<Place> = Vec::new();
        let mut parts = 0;
        for (from, k) in self.candidates(ray, tolerance) {
            let nearest = found.iter().map(|p| p.sight.s).fold(f64::INFINITY, f64::min);
            // A graze may go on behind its first place.
            if first && from > nearest + GRAZE * tolerance {
                break;
            }
            look(View::new(&self.pieces[k], ray), ray, tolerance, &mut found, &mut parts)?;
        }
        Ok(self.merged(ray, tolerance, found))
    }

    /// Patches next to the ray, by where it enters their boxes.
    fn candidates(&self, ray: &Ray<DVec3>, tolerance: f64) -> Vec<(f64, usize)> {
        let inner = self.pieces.len() - 1;
        let margin = DVec3::splat(tolerance);
        let (mut rest, mut out) = (vec![0], Vec::new());
        while let Some(k) = rest.pop() {
            let [low, high] = self.boxes[k];
            let Some([from, _]) = ray.clip(low - margin, high + margin) else { continue };
            match k.checked_sub(inner) {
                Some(piece) => out.push((from, piece)),
                None => rest.extend([2 * k + 1, 2 * k + 2]),
            }
        }
        out.sort_by(|a, b| a.0.total_cmp(&b.0));
        out
    }

    /// Each place once, as hits.
    fn merged(&self, ray: &Ray<DVec3>, tolerance: f64, mut found: Vec<Place>) -> Vec<Hit<DVec2, DVec3>> {
        found.sort_by(|a, b| a.sight.s.total_cmp(&b.sight.s));
        let mut groups: Vec<Vec<Place>> = Vec::new();
        for place in found {
            let near =
                |group: &&mut Vec<Place>| group.iter().rev().any(|p| self.is_same(ray, tolerance, p, &place));
            match groups.iter_mut().rev().find(near) {
                Some(group) => group.push(place),
                None => groups.push(vec![place]),
            }
        }
        let mut hits: Vec<Hit<DVec2, DVec3>> = groups.iter().map(|g| self.hit(ray, tolerance, g)).collect();
        hits.sort_by(|a, b| a.s.total_cmp(&b.s));
        hits
    }

    /// Whether two places are one point, or the surface stays on the ray between them.
    fn is_same(&self, ray: &Ray<DVec3>, tolerance: f64, p: &Place, q: &Place) -> bool {
        let [a, b] = [p, q].map(|place| place.sight);
        if (a.s - b.s).abs() <= 2.0 * tolerance {
            let apart = self.surface.point(a.at.x, a.at.y).distance(self.surface.point(b.at.x, b.at.y));
            if apart <= 4.0 * tolerance {
                return true;
            }
        }
        self.is_joined(ray, tolerance, a.at, b.at)
    }

    /// Whether the surface stays on the ray between two parameters, over a seam if that is shorter.
    fn is_joined(&self, ray: &Ray<DVec3>, tolerance: f64, a: DVec2, b: DVec2) -> bool {
        let (low, high) = self.domain();
        let period = high - low;
        let mut step = b - a;
        for k in 0..2 {
            if self.closed[k] && step[k].abs() > 0.5 * period[k] {
                step[k] -= period[k].copysign(step[k]);
            }
        }
        (1..BETWEEN).all(|k| {
            let mut at = a + step * (k as f64 / BETWEEN as f64);
            at += period * (DVec2::from(at.cmplt(low)) - DVec2::from(at.cmpgt(high)));
            let from = self.surface.point(at.x, at.y) - ray.origin;
            from.reject_from_normalized(ray.direction).length() <= 2.0 * tolerance
        })
    }

    fn domain(&self) -> (DVec2, DVec2) {
        let domains = [self.surface.knots_u().domain(), self.surface.knots_v().domain()];
        (domains.map(|d| d.0).into(), domains.map(|d| d.1).into())
    }

    /// A group of places that are one, as a hit.
    fn hit(&self, ray: &Ray<DVec3>, tolerance: f64, group: &[Place]) -> Hit<DVec2, DVec3> {
        let by_distance = |a: &&Place, b: &&Place| a.sight.distance.total_cmp(&b.sight.distance);
        let crossing = group.iter().filter(|p| p.crosses).min_by(by_distance);
        let best = crossing.or_else(|| group.iter().min_by(by_distance)).expect("groups are not empty");
        let ends = |[a, b]: [f64; 2], p: &Place| [a.min(p.along[0]), b.max(p.along[1])];
        let mut along = group.iter().fold(best.along, ends);
        along = along.map(|s| s.max(ray.from));
        let stays = along[1] - along[0] > GRAZE * tolerance;
        let mut sight = best.sight;
        let mut grazes = stays;
        if stays || self.sine(ray, sight.at) < FLAT {
            let middle = 0.5 * (along[0] + along[1]);
            let off = |p: &&Place| (p.sight.s - middle).abs();
            let start =
                group.iter().min_by(|a, b| off(a).total_cmp(&off(b))).map_or(sight.at, |p| p.sight.at);
            let on_ray = |s: &Sight| s.distance <= tolerance && self.is_joined(ray, tolerance, start, s.at);
            if let Some(place) = self.grazing(ray, start).filter(on_ray) {
                (sight, grazes) = (place, true);
            }
        }
        if !grazes {
            along = [sight.s.max(ray.from); 2];
        }
        let point = self.surface.point(sight.at.x, sight.at.y);
        let kind = if grazes { Kind::Tangential } else { Kind::Transversal };
        Hit { s: sight.s.max(ray.from), along, at: sight.at, point, distance: sight.distance, kind }
    }

    /// Sine of the angle between the ray and the surface; 1 where this has no normal.
    fn sine(&self, ray: &Ray<DVec3>, at: DVec2) -> f64 {
        let normal = self.surface.derivatives(at.x, at.y).normal();
        normal.try_normalize().map_or(1.0, |n| n.dot(ray.direction).abs())
    }

    /// Near a place, that at which the ray is parallel to the surface and as near to it as it gets
    /// across the normal.
    fn grazing(&self, ray: &Ray<DVec3>, mut at: DVec2) -> Option<Sight> {
        let (low, high) = self.domain();
        let d = ray.direction;
        for _ in 0..STEPS {
            let j = self.surface.derivatives(at.x, at.y);
            let across = d.cross(j.normal()).try_normalize()?;
            let rise = [j.uu.cross(j.v) + j.u.cross(j.uv), j.uv.cross(j.v) + j.u.cross(j.vv)];
            let matrix = DMat2::from_cols(
                DVec2::new(j.u.dot(across), rise[0].dot(d)),
                DVec2::new(j.v.dot(across), rise[1].dot(d)),
            );
            let by = matrix.inverse() * DVec2::new((j.s - ray.origin).dot(across), j.normal().dot(d));
            if !by.is_finite() {
                return None;
            }
            at = (at - by).clamp(low, high);
        }
        let from = self.surface.point(at.x, at.y) - ray.origin;
        Some(Sight { at, s: from.dot(d), distance: from.reject_from_normalized(d).length() })
    }
}

/// Whether the first and last poles along a direction are the same.
fn is_closed(surface: &NurbsSurface, direction: Direction) -> bool {
    let (columns, poles) = (surface.knots_v().len(), surface.poles());
    let rows = poles.len() / columns;
    let size = poles.iter().map(|p| p.distance(poles[0])).fold(0.0, f64::max);
    let same = |a: usize, b: usize| poles[a].distance(poles[b]) <= 1e-12 * size;
    match direction {
        Direction::U => (0..columns).all(|j| same(j, (rows - 1) * columns + j)),
        Direction::V => (0..rows).all(|i| same(i * columns, (i + 1) * columns - 1)),
    }
}

/// Looks for places on one patch.
fn look(
    patch: View,
    ray: &Ray<DVec3>,
    tolerance: f64,
    found: &mut Vec<Place>,
    parts: &mut usize,
) -> Result<()> {
    let mut rest = vec![patch];
    while let Some(view) = rest.pop() {
        *parts += 1;
        if *parts > PARTS {
            let why = format!(
                "the surface is within {tolerance:e} of the ray in too many places: ask for a smaller tolerance"
            );
            return Err(Error::Numerics { why });
        }
        let cones = view.cones();
        if view.along[1] < ray.from - tolerance || view.is_apart(tolerance, &cones) {
            continue;
        }
        let crosses = cones[0].is_apart(&cones[1]);
        if crosses {
            let sight = view.nearest();
            if sight.distance <= tolerance {
                if sight.s >= ray.from - tolerance {
                    found.push(Place { sight, along: [sight.s; 2], crosses });
                }
                continue;
            }
        }
        let begins_within = view.along[0] < ray.from - tolerance;
        let along = || view.halves_along(tolerance).filter(|_| begins_within);
        match view.halves(POINT * tolerance).or_else(along) {
            Some(halves) => rest.extend(halves),
            None => {
                let sight = view.nearest();
                if sight.distance <= tolerance && sight.s >= ray.from - tolerance {
                    found.push(Place { sight, along: view.along, crosses });
                }
            }
        }
    }
    Ok(())
}
