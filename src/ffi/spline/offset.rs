//! Offsets of planar curves and of surfaces.

use super::curve::{Curve, each};
use super::curves::{Curves, of_dimension};
use super::surface::Surface;
use super::table::Table;
use super::{filled, number, numbers, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::{ArrayOut, total};
use crate::nurbs::NurbsCurve;
use crate::ops::offset::{Corner, DomainMap, Offset, OffsetCurve};
use crate::ops::surface_offset;
use glam::DVec2;

/// The points at a distance from a curve in the plane, on one side of it, that are nowhere nearer to
/// it, as curves that run as it does: several, one, or none where nothing is left.
///
/// distance: positive to the left of the curve; not 0.
/// tolerance: how far curves may be from the true offset; above 0 and below the distance.
/// limit: 0: arcs go around outward corners; at least 1: straight lines go on until they meet, where
/// the tip is not further from the corner than limit times the distance.
/// pieces: a table with the columns curve, from, to, source_from, source_to: the smooth pieces of
/// all curves in order, each with the index of its curve, its parameters there, and those on the
/// source, which are one at a corner.
/// Units: mm.
/// Owner: `*curves` is the caller's, for bladesmith_curves_free(), and `*pieces`, for
/// bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for a curve in space; BLADESMITH_STATUS_SPLINE for curves
/// that jump; BLADESMITH_STATUS_NUMERICS for curves that stand still.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_offset(
    curve: *const Curve,
    distance: f64,
    tolerance: f64,
    limit: f64,
    curves: *mut *mut Curves,
    pieces: *mut *mut Table,
) -> i32 {
    // SAFETY: the header asks for a live handle and room for two.
    unsafe {
        moved(curve, [distance, tolerance, limit], curves, pieces, |offset, source| offset.trimmed(source))
    }
}

/// The whole offset of a curve in the plane, loops and all: nothing is trimmed, but curves end at
/// inward corners.
///
/// distance, tolerance, limit, curves, pieces: as bladesmith_curve_offset() [1].
/// Units: mm.
/// Owner: as there; written only on success.
/// Errors: as there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_offset_raw(
    curve: *const Curve,
    distance: f64,
    tolerance: f64,
    limit: f64,
    curves: *mut *mut Curves,
    pieces: *mut *mut Table,
) -> i32 {
    // SAFETY: the header asks for a live handle and room for two.
    unsafe { moved(curve, [distance, tolerance, limit], curves, pieces, |offset, source| offset.raw(source)) }
}

/// Hands over the offset that `find` finds of a distance, a tolerance and a limit.
///
/// # Safety
/// `curve` is NULL or a live handle, `curves` and `pieces` NULL or room for one.
unsafe fn moved(
    curve: *const Curve,
    [distance, tolerance, limit]: [f64; 3],
    curves: *mut *mut Curves,
    pieces: *mut *mut Table,
    find: impl FnOnce(Offset, &NurbsCurve<DVec2>) -> Result<Vec<OffsetCurve>>,
) -> i32 {
    guard(|| {
        let limit = self::tolerance(limit, "limit")?;
        let corner = if limit == 0.0 { Corner::Arc } else { Corner::Extension { limit } };
        // SAFETY: promised by the caller.
        let (curve, curves, pieces) = unsafe {
            (handle::borrow(curve, "curve")?, Out::new(curves, "curves")?, Out::new(pieces, "pieces")?)
        };
        let found = find(Offset { distance, tolerance, corner }, of_dimension(curve, "curve")?)?;
        let of_all = found.iter().enumerate().flat_map(|(k, o)| o.pieces.iter().map(move |p| (k, p)));
        pieces.hand_over(Table::new(
            of_all.map(|(k, p)| [k as f64, p.range[0], p.range[1], p.source[0], p.source[1]]),
        ));
        curves.hand_over(found.into_iter().map(|o| o.curve).collect());
        Ok(())
    })
}

/// Parameters of a curve mapped to those that have a point in its offset: each part that is kept
/// takes the domain up to the middle of the gaps beside it, evenly.
///
/// pieces: [piece_count][5] the rows of the table of bladesmith_curve_offset() for this curve, at
/// least one.
/// t: [count] parameters of the curve, finite; beyond the domain as its ends.
/// out: [count] parameters of the curve.
/// Units: those of the parameter.
/// Owner: the caller gives the arrays; out is written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for pieces that leave the curve's domain, and where nothing is
/// kept.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_offset_map(
    curve: *const Curve,
    pieces: *const f64,
    piece_count: usize,
    t: *const f64,
    count: usize,
    out: *mut f64,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for live handles and states the lengths of the arrays.
        let (curve, pieces, t, out) = unsafe {
            (
                handle::borrow(curve, "curve")?,
                numbers(pieces, total(piece_count, 5, "piece_count")?, "pieces")?,
                numbers(t, count, "t")?,
                filled(out, count, "out")?,
            )
        };
        let domain = each!(curve, c => c.knots().domain());
        let map = DomainMap::onto(domain.into(), pieces.chunks(5).map(|row| [row[3], row[4]]))?;
        out.fill(t.iter().map(|&t| map.at(t)));
        Ok(())
    })
}

/// The surface at a distance along the normals S_u x S_v, over the same domain.
///
/// distance: negative for the other side.
/// tolerance: how far the result may be from the true offset at equal parameters; above 0.
/// deviation: [1] is set to how far it was seen to be; may be NULL.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also where the offset would fold; BLADESMITH_STATUS_SPLINE for
/// surfaces with a kink; BLADESMITH_STATUS_NUMERICS where there is no normal, and where the tolerance
/// cannot be met.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_offset(
    surface: *const Surface,
    distance: f64,
    tolerance: f64,
    deviation: *mut f64,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        let distance = number(distance, "distance")?;
        // SAFETY: the header asks for a live handle and room for one, and for a number.
        let (surface, place, out) = unsafe {
            (
                handle::borrow(surface, "surface")?,
                ArrayOut::new(deviation, 1, "deviation")?,
                Out::new(out, "out")?,
            )
        };
        let made = surface_offset::offset(&surface.surface, distance, tolerance)?;
        place.fill([made.deviation_mm]);
        out.hand_over(made.surface.into());
        Ok(())
    })
}
