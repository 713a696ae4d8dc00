//! Nearest points of curves and surfaces, always the global ones.

use super::curve::{Curve, Dimension, Prepared, each};
use super::surface::Surface;
use super::table::Table;
use super::{Row, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::ArrayOut;
use crate::ops::invert::{Nearest, check_size};
use glam::{DVec2, DVec3};

/// Where nearest points are written; any may be NULL.
struct Places<T, P> {
    at: ArrayOut<T>,
    feet: ArrayOut<P>,
    distances: ArrayOut<f64>,
}

impl<T: Copy, P: Row> Places<T, P> {
    /// Checks the arrays.
    ///
    /// # Safety
    /// If not NULL, each must have room for `count` entries.
    unsafe fn new(
        (at, name): (*mut T, &'static str),
        feet: *mut f64,
        distances: *mut f64,
        count: usize,
    ) -> Result<Self> {
        // SAFETY: promised by the caller.
        unsafe {
            Ok(Self {
                at: ArrayOut::new(at, count, name)?,
                feet: P::rows_out(feet, count, "feet")?,
                distances: ArrayOut::new(distances, count, "distances")?,
            })
        }
    }

    fn fill(self, found: &[Nearest<T, P>]) {
        self.at.fill(found.iter().map(|nearest| nearest.at));
        self.feet.fill(found.iter().map(|nearest| nearest.point));
        self.distances.fill(found.iter().map(|nearest| nearest.distance));
    }
}

/// The nearest point of a curve to each of many. The first call on a curve prepares it: later ones
/// are faster. Any of the outputs may be NULL.
///
/// points: [count][dimension], finite.
/// t: [count] parameters.
/// feet: [count][dimension] the nearest points.
/// distances: [count].
/// Units: mm.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump;
/// BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_nearest(
    curve: *const Curve,
    points: *const f64,
    count: usize,
    t: *mut f64,
    feet: *mut f64,
    distances: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle.
        let curve = unsafe { handle::borrow(curve, "curve")? };
        // SAFETY: the header states the lengths of the arrays.
        each!(curve, c => unsafe { nearest_on_curve(c, points, count, [t, feet, distances]) })?;
        Ok(())
    })
}

unsafe fn nearest_on_curve<P: Dimension>(
    curve: &Prepared<P>,
    points: *const f64,
    count: usize,
    [t, feet, distances]: [*mut f64; 3],
) -> Result<()> {
    // SAFETY: promised by the caller.
    let (points, places) =
        unsafe { (P::rows(points, count, "points")?, Places::new((t, "t"), feet, distances, count)?) };
    check_size(points)?;
    let inverter = curve.inverter()?;
    places.fill(&points.iter().map(|&p| inverter.nearest(p)).collect::<Vec<_>>());
    Ok(())
}

/// All points of a curve that are as near to a point as the nearest, nearest first; where a whole
/// stretch is, some of its points.
///
/// point: [dimension], finite.
/// tie: by how much they may be further away, not negative.
/// out: a table with the columns t, x, y, z (0 in the plane), distance.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump;
/// BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_nearest_all(
    curve: *const Curve,
    point: *const f64,
    tie: f64,
    out: *mut *mut Table,
) -> i32 {
    guard(|| {
        let tie = tolerance(tie, "tie")?;
        // SAFETY: the header asks for a live handle and room for one.
        let (curve, out) = unsafe { (handle::borrow(curve, "curve")?, Out::new(out, "out")?) };
        // SAFETY: the header states the length of the array.
        out.hand_over(each!(curve, c => unsafe { ties(c, point, tie)? }));
        Ok(())
    })
}

unsafe fn ties<P: Dimension>(curve: &Prepared<P>, point: *const f64, tie: f64) -> Result<Table> {
    // SAFETY: promised by the caller.
    let point = unsafe { P::row(point, "point")? };
    check_size(&[point])?;
    let found = curve.inverter()?.nearest_all(point, tie);
    Ok(Table::new(found.iter().map(|nearest| {
        let [x, y, z] = nearest.point.coordinates();
        [nearest.at, x, y, z, nearest.distance]
    })))
}

/// The nearest point of a surface to each of many. The first call on a surface prepares it: later
/// ones are faster. Any of the outputs may be NULL.
///
/// points: [count][3], finite.
/// uv: [count][2] parameters.
/// feet: [count][3] the nearest points.
/// distances: [count].
/// Units: mm.
/// Owner: the caller gives the arrays; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump;
/// BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_nearest(
    surface: *const Surface,
    points: *const f64,
    count: usize,
    uv: *mut f64,
    feet: *mut f64,
    distances: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and states the lengths of the arrays.
        let (surface, points, places) = unsafe {
            (
                handle::borrow(surface, "surface")?,
                DVec3::rows(points, count, "points")?,
                Places::new((uv.cast::<DVec2>(), "uv"), feet, distances, count)?,
            )
        };
        check_size(points)?;
        let inverter = surface.inverter()?;
        places.fill(&inverter.nearest_many(points));
        Ok(())
    })
}

/// All points of a surface that are as near to a point as the nearest, nearest first; where a whole
/// curve or area is, some of its points.
///
/// point: [3], finite.
/// tie: by how much they may be further away, not negative.
/// out: a table with the columns u, v, x, y, z, distance.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump;
/// BLADESMITH_STATUS_NUMERICS for coordinates beyond 1e150.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_nearest_all(
    surface: *const Surface,
    point: *const f64,
    tie: f64,
    out: *mut *mut Table,
) -> i32 {
    guard(|| {
        let tie = tolerance(tie, "tie")?;
        // SAFETY: the header asks for a live handle, states the length of the array and asks for
        // room for a handle.
        let (surface, point, out) = unsafe {
            (handle::borrow(surface, "surface")?, DVec3::row(point, "point")?, Out::new(out, "out")?)
        };
        check_size(&[point])?;
        let found = surface.inverter()?.nearest_all(point, tie);
        out.hand_over(Table::new(found.iter().map(|nearest| {
            let ([u, v], [x, y, z]) = (nearest.at.to_array(), nearest.point.to_array());
            [u, v, x, y, z, nearest.distance]
        })));
        Ok(())
    })
}
