//! Fillets between planar curves.

use super::curve::Curve;
use super::curves::{Curves, of_dimension};
use super::table::Table;
use super::{Row, number, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::nurbs::NurbsCurve;
use crate::ops::fillet::{Fillet, corner_fillet, fillet_near, fillets};
use glam::DVec2;

/// All circular arcs of a radius that are tangent to two curves in the plane, on either side of
/// each, whose circle cuts into neither of them.
///
/// other: another curve in the plane.
/// tolerance: by how much a circle may cut in; above 0 and below the radius.
/// curves: what the table names.
/// fillets: a table with the columns x, y, t, s, side, other_side, angle, first, arc, second: the
/// centre; the parameters of the points of contact on curve and other; 1 where the centre is to the
/// left of each and -1 to the right; the angle of the arc from curve to other, positive to the left;
/// and the indices in curves of what is left of curve, of the arc, and of what is left of other, or
/// -1 where nothing is. All of them run over [0, 1], curve and other as before.
/// Units: mm; angle rad.
/// Owner: `*curves` is the caller's, for bladesmith_curves_free(), and `*fillets`, for
/// bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for curves in space; BLADESMITH_STATUS_SPLINE for curves
/// that jump; BLADESMITH_STATUS_NUMERICS for curves that stand still.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_fillets(
    curve: *const Curve,
    other: *const Curve,
    radius: f64,
    tolerance: f64,
    curves: *mut *mut Curves,
    fillets: *mut *mut Table,
) -> i32 {
    // SAFETY: the header asks for live handles and room for two.
    unsafe {
        rounded([curve, other], [radius, tolerance], curves, fillets, |pair, [radius, within]| {
            self::fillets(pair[0], pair[1], radius, within)
        })
    }
}

/// One fillet of those of bladesmith_curve_fillets(), or none where there is none that fits.
///
/// near: [2] where its centre shall be nearest to; or NULL for the one that rounds the corner at
/// which an end of curve meets an end of other.
/// curves, fillets: as there, with one row or none.
/// Units: mm; angle rad.
/// Owner: `*curves` is the caller's, for bladesmith_curves_free(), and `*fillets`, for
/// bladesmith_table_free(); written only on success.
/// Errors: as there; BLADESMITH_STATUS_ARGUMENT also where no ends meet and near is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_fillet(
    curve: *const Curve,
    other: *const Curve,
    radius: f64,
    tolerance: f64,
    near: *const f64,
    curves: *mut *mut Curves,
    fillets: *mut *mut Table,
) -> i32 {
    // SAFETY: the header asks for live handles and room for two, and states the length of the array.
    unsafe {
        rounded([curve, other], [radius, tolerance], curves, fillets, |pair, [radius, within]| {
            let found = if near.is_null() {
                corner_fillet(pair, radius, within)?
            } else {
                fillet_near(pair, radius, DVec2::row(near, "near")?, within)?
            };
            Ok(found.into_iter().collect())
        })
    }
}

type Pair<'a> = [&'a NurbsCurve<DVec2>; 2];

/// Hands over the fillets that `find` finds with a radius and a tolerance.
///
/// # Safety
/// `pair` are NULL or live handles, `curves` and `fillets` NULL or room for one.
unsafe fn rounded(
    pair: [*const Curve; 2],
    [radius, within]: [f64; 2],
    curves: *mut *mut Curves,
    fillets: *mut *mut Table,
    find: impl FnOnce(Pair, [f64; 2]) -> Result<Vec<Fillet>>,
) -> i32 {
    guard(|| {
        let sizes = [number(radius, "radius")?, tolerance(within, "tolerance")?];
        // SAFETY: promised by the caller.
        let (curve, other, curves, fillets) = unsafe {
            (
                handle::borrow(pair[0], "curve")?,
                handle::borrow(pair[1], "other")?,
                Out::new(curves, "curves")?,
                Out::new(fillets, "fillets")?,
            )
        };
        let pair = [of_dimension(curve, "curve")?, of_dimension(other, "other")?];
        let mut made: Vec<NurbsCurve<DVec2>> = Vec::new();
        let found = find(pair, sizes)?;
        let rows = found.iter().map(|fillet| row(fillet, pair, &mut made));
        let table = Table::new(rows.collect::<Result<Vec<_>>>()?);
        curves.hand_over(made.into_iter().collect());
        fillets.hand_over(table);
        Ok(())
    })
}

/// A row of the table; the curves that it names are put behind those made before.
fn row(fillet: &Fillet, pair: Pair, made: &mut Vec<NurbsCurve<DVec2>>) -> Result<[f64; 10]> {
    let [first, second] = fillet.trimmed(pair)?;
    // Where both points of contact are one, there is nothing between them.
    let arc = if fillet.angle == 0.0 { None } else { Some(fillet.arc(pair[0])?) };
    let mut index = |curve: Option<NurbsCurve<DVec2>>| match curve {
        Some(curve) => {
            made.push(curve);
            (made.len() - 1) as f64
        }
        None => -1.0,
    };
    let [first, arc, second] = [first, arc, second].map(&mut index);
    let ([t, s], [side, other_side]) = (fillet.parameters, fillet.sides);
    Ok([fillet.centre.x, fillet.centre.y, t, s, side, other_side, fillet.angle, first, arc, second])
}
