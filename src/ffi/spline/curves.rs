//! Several curves: as results of unknown number, and as arguments.

use super::curve::{Curve, Dimension, by_dimension, each};
use crate::error::{Error, Result};
use crate::ffi::guard::{guard, guard_silent};
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::slice;
use crate::nurbs::{NurbsCurve, compatible};

/// Curves that a call made, as many as there are. Opaque and unchanging.
pub struct Curves {
    curves: Vec<Curve>,
}

impl<P: Dimension> FromIterator<NurbsCurve<P>> for Curves {
    fn from_iter<T: IntoIterator<Item = NurbsCurve<P>>>(curves: T) -> Self {
        Self { curves: curves.into_iter().map(Curve::from).collect() }
    }
}

/// The curves of an array of handles, at least one.
///
/// # Errors
/// [`Error::Argument`] for none, or NULL among them.
///
/// # Safety
/// If not NULL, `handles` must point to `count` handles, each NULL or alive.
pub(super) unsafe fn borrow_all<'a>(handles: *const *const Curve, count: usize) -> Result<Vec<&'a Curve>> {
    if count == 0 {
        return Err(Error::Argument { name: "curves", why: "is empty; pass at least one".into() });
    }
    // SAFETY: promised by the caller.
    unsafe { slice(handles, count, "curves")?.iter().map(|&curve| handle::borrow(curve, "curves")).collect() }
}

/// A curve that must have the dimension `P`.
///
/// # Errors
/// [`Error::Argument`] for one of the other.
pub(super) fn of_dimension<'a, P: Dimension>(
    curve: &'a Curve,
    name: &'static str,
) -> Result<&'a NurbsCurve<P>> {
    P::of(curve).map(|curve| &**curve).ok_or_else(|| {
        let why = format!("has a curve of the other dimension; {} is expected here", P::DIMENSION);
        Error::Argument { name, why }
    })
}

/// Copies of curves that must all have the dimension `P`.
///
/// # Errors
/// As [`of_dimension`].
pub(super) fn copies<P: Dimension>(curves: &[&Curve]) -> Result<Vec<NurbsCurve<P>>> {
    curves.iter().map(|curve| of_dimension(curve, "curves").cloned()).collect()
}

/// The Bézier segments of a curve, each over the span it came from.
///
/// Owner: `*out` is the caller's, for bladesmith_curves_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curve_bezier(curve: *const Curve, out: *mut *mut Curves) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one.
        let (curve, out) = unsafe { (handle::borrow(curve, "curve")?, Out::new(out, "out")?) };
        out.hand_over(each!(curve, c => c.bezier_segments()?.into_iter().collect()));
        Ok(())
    })
}

/// The same curves with one degree, one domain (that of the first) and the same clamped knots, and
/// with weights if one has them.
///
/// curves: [count] curves of one dimension, at least one.
/// Owner: `*out` is the caller's, for bladesmith_curves_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curves_compatible(
    curves: *const *const Curve,
    count: usize,
    out: *mut *mut Curves,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for as many live handles and room for one.
        let (curves, out) = unsafe { (borrow_all(curves, count)?, Out::new(out, "out")?) };
        by_dimension!(curves[0].dimension(), P => {
            out.hand_over(compatible::<P>(&copies(&curves)?)?.into_iter().collect());
            Ok(())
        })
    })
}

/// Number of curves.
///
/// Owner: the caller gives the place.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curves_count(curves: *const Curves, count: *mut usize) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one number.
        let (curves, count) = unsafe { (handle::borrow(curves, "curves")?, Out::new(count, "count")?) };
        count.write(curves.curves.len());
        Ok(())
    })
}

/// One of the curves, as a handle of its own.
///
/// index: from 0.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for an index that is not there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curves_get(
    curves: *const Curves,
    index: usize,
    out: *mut *mut Curve,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one.
        let (curves, out) = unsafe { (handle::borrow(curves, "curves")?, Out::new(out, "out")?) };
        let curve = curves.curves.get(index).ok_or_else(|| Error::Argument {
            name: "index",
            why: format!("is {index}; there are {} curves, counted from 0", curves.curves.len()),
        })?;
        out.hand_over(curve.clone());
        Ok(())
    })
}

/// Frees the list; NULL is fine. Curves taken from it stay. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_curves_free(curves: *mut Curves) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(curves) });
}
