//! Where curves meet each other and themselves, and where rays meet curves and surfaces.

use super::curve::{Curve, Dimension, each};
use super::curves::of_dimension;
use super::surface::Surface;
use super::table::Table;
use super::{Row, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::nurbs::{NurbsCurve, Point};
use crate::ops::intersect::{self, Intersections, Kind};
use crate::ops::ray::{Hit, Ray, SurfaceCaster};
use glam::DVec3;

/// All places where two curves are not further apart than a tolerance, each once: single points, and
/// stretches along which they are one.
///
/// other: a curve of the same dimension.
/// tolerance: above 0, and small against the curves.
/// crossings: a table with the columns t, s, x, y, z, distance, tangential: parameters on curve and
/// other, the middle between both points (z = 0 in the plane), how far these are apart, and 1 where
/// the curves touch or 0 where they cross; by t. On the seam of a closed curve t is that of its start.
/// overlaps: a table with the columns t0, t1, s0, s1: parameters on curve, ascending, and those on
/// other at the same points. Their ends are not among the crossings.
/// Units: mm.
/// Owner: both tables are the caller's, for bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS for curves that are near to each
/// other in too many places, as with a tolerance in the order of their size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_intersect(
    curve: *const Curve,
    other: *const Curve,
    tolerance: f64,
    crossings: *mut *mut Table,
    overlaps: *mut *mut Table,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for live handles and room for two.
        let (curve, other, crossings, overlaps) = unsafe {
            (
                handle::borrow(curve, "curve")?,
                handle::borrow(other, "other")?,
                Out::new(crossings, "crossings")?,
                Out::new(overlaps, "overlaps")?,
            )
        };
        let [points, stretches] = each!(curve, c => tables(&met(c, other, within)?));
        crossings.hand_over(points);
        overlaps.hand_over(stretches);
        Ok(())
    })
}

fn met<P: Dimension>(curve: &NurbsCurve<P>, other: &Curve, within: f64) -> Result<Intersections<P>> {
    intersect::curves(curve, of_dimension(other, "other")?, within)
}

/// The places that a curve passes twice to within a tolerance, as bladesmith_curve_intersect():
/// s and t are different parameters, the smaller first. The seam of a closed curve and cusps are
/// none.
///
/// tolerance: above 0, and small against the curve.
/// crossings, overlaps: as there.
/// Units: mm.
/// Owner: both tables are the caller's, for bladesmith_table_free(); written only on success.
/// Errors: as there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_self_intersect(
    curve: *const Curve,
    tolerance: f64,
    crossings: *mut *mut Table,
    overlaps: *mut *mut Table,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and room for two.
        let (curve, crossings, overlaps) = unsafe {
            (
                handle::borrow(curve, "curve")?,
                Out::new(crossings, "crossings")?,
                Out::new(overlaps, "overlaps")?,
            )
        };
        let [points, stretches] = each!(curve, c => tables(&intersect::self_intersections(c, within)?));
        crossings.hand_over(points);
        overlaps.hand_over(stretches);
        Ok(())
    })
}

/// Crossings and overlaps.
fn tables<P: Point>(found: &Intersections<P>) -> [Table; 2] {
    let crossings = found.crossings.iter().map(|c| {
        let ([t, s], [x, y, z]) = (c.at, c.point.coordinates());
        [t, s, x, y, z, c.distance, tangential(c.kind)]
    });
    let overlaps = found.overlaps.iter().map(|o| [o.first[0], o.first[1], o.second[0], o.second[1]]);
    [Table::new(crossings), Table::new(overlaps)]
}

fn tangential(kind: Kind) -> f64 {
    f64::from(u8::from(kind == Kind::Tangential))
}

/// All places where a curve is not further than a tolerance from a ray, the first on the ray first.
/// A stretch that runs along the ray is one of them.
///
/// origin, direction: [dimension] of the curve; the direction of any length but 0.
/// both: 0: the ray begins at its origin; not 0: it runs to both sides.
/// tolerance: above 0, and small against the curve.
/// out: a table with the columns length, from, to, t, x, y, z, distance, tangential: the length from
/// the origin to the place, the part of the ray within the tolerance (of no length unless it runs
/// along), the parameter and point of the curve (z = 0 in the plane), its distance from the ray, and
/// 1 where the ray touches or runs along, 0 where it crosses.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS as bladesmith_curve_intersect().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_ray(
    curve: *const Curve,
    origin: *const f64,
    direction: *const f64,
    both: u32,
    tolerance: f64,
    out: *mut *mut Table,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and room for one.
        let (curve, out) = unsafe { (handle::borrow(curve, "curve")?, Out::new(out, "out")?) };
        out.hand_over(each!(curve, c => {
            // SAFETY: the header states the lengths of the arrays.
            let hits = unsafe { ray(origin, direction, both) }?.curve_hits(c, within)?;
            Table::new(hits.iter().map(|hit| {
                let ([from, to, x, y, z], [s, distance, tangential]) = columns(hit);
                [s, from, to, hit.at, x, y, z, distance, tangential]
            }))
        }));
        Ok(())
    })
}

/// All places where a surface is not further than a tolerance from a ray, the first on the ray
/// first. A stretch along which the ray grazes the surface or runs on it is one of them.
///
/// origin, direction: [3]; the direction of any length but 0.
/// both: 0: the ray begins at its origin; not 0: it runs to both sides.
/// tolerance: above 0, and small against the surface.
/// out: a table with the columns length, from, to, u, v, x, y, z, distance, tangential, as
/// bladesmith_curve_ray().
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump;
/// BLADESMITH_STATUS_NUMERICS for a tolerance in the order of the surface's size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_ray(
    surface: *const Surface,
    origin: *const f64,
    direction: *const f64,
    both: u32,
    tolerance: f64,
    out: *mut *mut Table,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and room for one.
        let (surface, out) = unsafe { (handle::borrow(surface, "surface")?, Out::new(out, "out")?) };
        // SAFETY: the header states the lengths of the arrays.
        let ray = unsafe { ray::<DVec3>(origin, direction, both) }?;
        let hits = SurfaceCaster::new(&surface.surface)?.hits(&ray, within)?;
        out.hand_over(Table::new(hits.iter().map(|hit| {
            let ([from, to, x, y, z], [s, distance, tangential]) = columns(hit);
            [s, from, to, hit.at.x, hit.at.y, x, y, z, distance, tangential]
        })));
        Ok(())
    })
}

/// The ray of a caller.
///
/// # Safety
/// If not NULL, both arrays must hold a point.
unsafe fn ray<P: Row>(origin: *const f64, direction: *const f64, both: u32) -> Result<Ray<P>> {
    // SAFETY: promised by the caller.
    let (origin, direction) = unsafe { (P::row(origin, "origin")?, P::row(direction, "direction")?) };
    if both == 0 { Ray::new(origin, direction) } else { Ray::line(origin, direction) }
}

/// What hits of curves and surfaces share: part of the ray and point; length, distance and kind.
fn columns<T, P: Point>(hit: &Hit<T, P>) -> ([f64; 5], [f64; 3]) {
    let ([from, to], [x, y, z]) = (hit.along, hit.point.coordinates());
    ([from, to, x, y, z], [hit.s, hit.distance, tangential(hit.kind)])
}
