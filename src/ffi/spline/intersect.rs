//! Where curves meet each other and themselves.

use super::curve::{Curve, Dimension, each};
use super::curves::of_dimension;
use super::table::Table;
use super::tolerance;
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::nurbs::{NurbsCurve, Point};
use crate::ops::intersect::{self, Intersections, Kind};

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

/// A kind as a column.
pub(super) fn tangential(kind: Kind) -> f64 {
    f64::from(u8::from(kind == Kind::Tangential))
}
