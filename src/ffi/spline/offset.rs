//! Offsets of planar curves and of surfaces.

use super::curve::Curve;
use super::curves::{Curves, of_dimension};
use super::surface::Surface;
use super::table::Table;
use super::{number, tolerance};
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::ArrayOut;
use crate::nurbs::NurbsCurve;
use crate::ops::offset::{Corner, Offset};
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
    guard(|| {
        let limit = self::tolerance(limit, "limit")?;
        let corner = if limit == 0.0 { Corner::Arc } else { Corner::Extension { limit } };
        // SAFETY: the header asks for a live handle and room for two.
        let (curve, curves, pieces) = unsafe {
            (handle::borrow(curve, "curve")?, Out::new(curves, "curves")?, Out::new(pieces, "pieces")?)
        };
        let source: &NurbsCurve<DVec2> = of_dimension(curve, "curve")?;
        let found = Offset { distance, tolerance, corner }.trimmed(source)?;
        let of_all = found.iter().enumerate().flat_map(|(k, o)| o.pieces.iter().map(move |p| (k, p)));
        pieces.hand_over(Table::new(
            of_all.map(|(k, p)| [k as f64, p.range[0], p.range[1], p.source[0], p.source[1]]),
        ));
        curves.hand_over(found.into_iter().map(|o| o.curve).collect());
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
