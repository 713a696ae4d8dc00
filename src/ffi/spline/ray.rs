//! Where rays meet curves and surfaces.

use super::curve::{Curve, Dimension, each};
use super::intersect::tangential;
use super::surface::Surface;
use super::table::Table;
use super::{Row, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::ArrayOut;
use crate::nurbs::{NurbsCurve, Point};
use crate::ops::ray::{Hit, Ray};
use glam::{DVec2, DVec3};

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
        let hits = surface.caster()?.hits(&ray, within)?;
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

/// Where each of many rays first comes nearer to a curve than a tolerance, as the first row of
/// bladesmith_curve_ray(). Any of the outputs may be NULL; where a ray misses the curve all are NaN.
///
/// origins, directions: [count][dimension] of the curve; directions of any length but 0.
/// tolerance: above 0, and small against the curve.
/// lengths: [count] from the origins.
/// t: [count] parameters.
/// points: [count][dimension] of the curve.
/// Units: mm.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: as there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_first_hits(
    curve: *const Curve,
    origins: *const f64,
    directions: *const f64,
    count: usize,
    tolerance: f64,
    lengths: *mut f64,
    t: *mut f64,
    points: *mut f64,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        unsafe {
            let curve = handle::borrow(curve, "curve")?;
            each!(curve, c => {
                let rays = rays(origins, directions, count)?;
                let places = Places::new(lengths, (t, "t"), points, count)?;
                places.fill(&first_on_curve(c, &rays, within)?, f64::NAN);
            });
        }
        Ok(())
    })
}

fn first_on_curve<P: Dimension>(
    curve: &NurbsCurve<P>,
    rays: &[Ray<P>],
    within: f64,
) -> Result<Vec<Option<Hit<f64, P>>>> {
    rays.iter().map(|ray| ray.first_curve_hit(curve, within)).collect()
}

/// Where each of many rays first comes nearer to a surface than a tolerance, as the first row of
/// bladesmith_surface_ray(). The first call on a surface prepares it: later ones are faster. Any of
/// the outputs may be NULL; where a ray misses the surface all are NaN.
///
/// origins, directions: [count][3]; directions of any length but 0.
/// tolerance: above 0, and small against the surface.
/// lengths: [count] from the origins.
/// uv: [count][2] parameters.
/// points: [count][3] of the surface.
/// Units: mm.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: as there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_first_hits(
    surface: *const Surface,
    origins: *const f64,
    directions: *const f64,
    count: usize,
    tolerance: f64,
    lengths: *mut f64,
    uv: *mut f64,
    points: *mut f64,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (surface, rays, places) = unsafe {
            (
                handle::borrow(surface, "surface")?,
                rays::<DVec3>(origins, directions, count)?,
                Places::new(lengths, (uv.cast::<DVec2>(), "uv"), points, count)?,
            )
        };
        let caster = surface.caster()?;
        let found = rays.iter().map(|ray| caster.first_hit(ray, within));
        places.fill(&found.collect::<Result<Vec<_>>>()?, DVec2::NAN);
        Ok(())
    })
}

/// The rays of a caller.
///
/// # Safety
/// If not NULL, both arrays must hold `count` points.
unsafe fn rays<P: Row>(origins: *const f64, directions: *const f64, count: usize) -> Result<Vec<Ray<P>>> {
    // SAFETY: promised by the caller.
    let (origins, directions) =
        unsafe { (P::rows(origins, count, "origins")?, P::rows(directions, count, "directions")?) };
    origins.iter().zip(directions).map(|(&origin, &direction)| Ray::new(origin, direction)).collect()
}

/// Where first hits are written; any may be NULL.
struct Places<T, P> {
    lengths: ArrayOut<f64>,
    at: ArrayOut<T>,
    points: ArrayOut<P>,
}

impl<T: Copy, P: Row> Places<T, P> {
    /// Checks the arrays.
    ///
    /// # Safety
    /// If not NULL, each must have room for `count` entries.
    unsafe fn new(
        lengths: *mut f64,
        (at, name): (*mut T, &'static str),
        points: *mut f64,
        count: usize,
    ) -> Result<Self> {
        // SAFETY: promised by the caller.
        unsafe {
            Ok(Self {
                lengths: ArrayOut::new(lengths, count, "lengths")?,
                at: ArrayOut::new(at, count, name)?,
                points: P::rows_out(points, count, "points")?,
            })
        }
    }

    fn fill(self, found: &[Option<Hit<T, P>>], nowhere: T) {
        let hits = || found.iter().map(Option::as_ref);
        self.lengths.fill(hits().map(|hit| hit.map_or(f64::NAN, |hit| hit.s)));
        self.at.fill(hits().map(|hit| hit.map_or(nowhere, |hit| hit.at)));
        let none = P::from_coordinates([f64::NAN; 3]);
        self.points.fill(hits().map(|hit| hit.map_or(none, |hit| hit.point)));
    }
}
