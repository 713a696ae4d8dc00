//! Curves made from a curve.

use super::curve::{Curve, Dimension, by_dimension, each};
use super::curves::of_dimension;
use super::{Affine, number, numbers, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::ArrayOut;
use crate::nurbs::{NurbsCurve, Point};

/// Runs an operation that makes one curve of another.
///
/// # Safety
/// `curve` is NULL or a live handle, `out` NULL or room for one.
unsafe fn reshape(
    curve: *const Curve,
    out: *mut *mut Curve,
    change: impl FnOnce(&Curve) -> Result<Curve>,
) -> i32 {
    guard(|| {
        // SAFETY: promised by the caller.
        let (curve, out) = unsafe { (handle::borrow(curve, "curve")?, Out::new(out, "out")?) };
        out.hand_over(change(curve)?);
        Ok(())
    })
}

/// As [`reshape`], for operations that also tell by how much the curve moved.
///
/// # Safety
/// As there; `moved` is NULL or room for one number.
unsafe fn reshape_within(
    curve: *const Curve,
    moved: *mut f64,
    out: *mut *mut Curve,
    change: impl FnOnce(&Curve) -> Result<(Curve, f64)>,
) -> i32 {
    // SAFETY: promised by the caller.
    unsafe {
        reshape(curve, out, |curve| {
            let place = ArrayOut::new(moved, 1, "moved")?;
            let (changed, moved) = change(curve)?;
            place.fill([moved]);
            Ok(changed)
        })
    }
}

fn wrapped<P: Dimension>((curve, moved): (NurbsCurve<P>, f64)) -> (Curve, f64) {
    (curve.into(), moved)
}

/// The same curve with knots inserted.
///
/// knots: [count] in the inside of the domain, not decreasing; one that comes twice is inserted
/// twice.
/// Units: those of the parameter.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where a knot lies elsewhere or would
/// stand more often than the degree.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_refine(
    curve: *const Curve,
    knots: *const f64,
    count: usize,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles and states the length of the array.
    unsafe {
        reshape(curve, out, |curve| {
            let knots = numbers(knots, count, "knots")?;
            Ok(each!(curve, c => c.refined(knots)?.into()))
        })
    }
}

/// The curve with a knot removed as often as the curve moves by no more than a tolerance in all.
/// How often it was removed shows in the knots.
///
/// t: the knot, exactly.
/// times: how often it shall be removed, at most as often as it stands there.
/// tolerance: not negative.
/// moved: [1] is set to a bound of the movement; may be NULL.
/// Units: tolerance and moved mm.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for a knot that does not stand
/// there so often.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_remove_knot(
    curve: *const Curve,
    t: f64,
    times: u32,
    tolerance: f64,
    moved: *mut f64,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles and room for the number.
    unsafe {
        reshape_within(curve, moved, out, |curve| {
            let (t, within) = (number(t, "t")?, self::tolerance(tolerance, "tolerance")?);
            Ok(each!(curve, c => wrapped(c.remove_knot(t, times as usize, within)?)))
        })
    }
}

/// The same curve, clamped, with its degree raised.
///
/// by: by how much; the new degree is at most 25.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE beyond the highest degree and for
/// curves that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_elevate(curve: *const Curve, by: u32, out: *mut *mut Curve) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(curve, out, |curve| Ok(each!(curve, c => c.elevated(by as usize)?.into()))) }
}

/// A curve of a degree lower by one that is, at equal parameters, no further away than a tolerance.
///
/// tolerance: not negative.
/// moved: [1] is set to a bound of the distance; may be NULL.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS where the tolerance cannot be met;
/// BLADESMITH_STATUS_SPLINE for degree 1 and curves that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_reduce(
    curve: *const Curve,
    tolerance: f64,
    moved: *mut f64,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles and room for the number.
    unsafe {
        reshape_within(curve, moved, out, |curve| {
            let within = self::tolerance(tolerance, "tolerance")?;
            Ok(each!(curve, c => wrapped(c.reduced(within)?)))
        })
    }
}

/// The part of a curve between two parameters, which keep their meaning; two parts split it.
///
/// from, to: ascending, in the domain.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty part or one outside.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_part(
    curve: *const Curve,
    from: f64,
    to: f64,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe {
        reshape(curve, out, |curve| {
            let (from, to) = (number(from, "from")?, number(to, "to")?);
            Ok(each!(curve, c => c.part(from, to)?.into()))
        })
    }
}

/// The curve run backwards, over the same domain.
///
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_reverse(curve: *const Curve, out: *mut *mut Curve) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(curve, out, |curve| Ok(each!(curve, c => c.reversed().into()))) }
}

/// The same curve over another domain.
///
/// from, to: ascending.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty domain.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_over(
    curve: *const Curve,
    from: f64,
    to: f64,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe {
        reshape(curve, out, |curve| {
            let (from, to) = (number(from, "from")?, number(to, "to")?);
            Ok(each!(curve, c => c.over(from, to)?.into()))
        })
    }
}

/// The same curve with end knots repeated degree + 1 times, as most programs want them.
///
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where rounding leaves no such knots.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_clamp(curve: *const Curve, out: *mut *mut Curve) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(curve, out, |curve| Ok(each!(curve, c => c.clamped()?.into()))) }
}

/// The image of a curve under an affine map, exactly.
///
/// matrix: [3][4]: row by row, the last column a shift. A curve in the plane has z = 0.
/// dimension: of the image, 2 or 3; 2 leaves its z out.
/// Units: the shift as the poles.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where numbers overflow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_map(
    curve: *const Curve,
    matrix: *const f64,
    dimension: u32,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles and states the length of the array.
    unsafe {
        reshape(curve, out, |curve| {
            let map = Affine::new(numbers(matrix, 12, "matrix")?);
            by_dimension!(dimension, P => {
                Ok(each!(curve, c => c.mapped(|p| <P as Point>::from_coordinates(map.of(p).to_array()))?.into()))
            })
        })
    }
}

/// One curve, and behind it another, as one.
///
/// next: a curve of the same dimension that starts where the first ends.
/// gap: how far apart they may be there; they meet in the middle.
/// smooth: 0: each keeps its parametrisation, that of next shifted; not 0: the speed of next is
/// brought to that of curve, and the joint made as smooth as moving by no more than gap allows.
/// Units: gap mm.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for ends further apart than gap;
/// BLADESMITH_STATUS_NUMERICS where smooth curves stand still at the joint.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_join(
    curve: *const Curve,
    next: *const Curve,
    gap: f64,
    smooth: u32,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe {
        reshape(curve, out, |curve| {
            let (next, gap) = (handle::borrow(next, "next")?, tolerance(gap, "gap")?);
            Ok(each!(curve, c => joined(c, of_dimension(next, "next")?, gap, smooth != 0)?.into()))
        })
    }
}

fn joined<P: Dimension>(
    curve: &NurbsCurve<P>,
    next: &NurbsCurve<P>,
    gap: f64,
    smooth: bool,
) -> Result<NurbsCurve<P>> {
    if smooth { curve.joined_smoothly(next, gap) } else { curve.joined(next, gap) }
}
