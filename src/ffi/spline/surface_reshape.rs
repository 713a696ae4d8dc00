//! Surfaces and curves made from a surface. Directions are 0 for u and 1 for v.

use super::curve::Curve;
use super::surface::Surface;
use super::{Affine, direction, number, numbers, tolerance};
use crate::error::Result;
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::ffi::slice::ArrayOut;
use crate::nurbs::NurbsSurface;

/// Runs an operation that makes a shape of a surface.
///
/// # Safety
/// `surface` is NULL or a live handle, `out` NULL or room for one.
unsafe fn reshape<T: From<U>, U>(
    surface: *const Surface,
    out: *mut *mut T,
    change: impl FnOnce(&NurbsSurface) -> Result<U>,
) -> i32 {
    guard(|| {
        // SAFETY: promised by the caller.
        let (surface, out) = unsafe { (handle::borrow(surface, "surface")?, Out::new(out, "out")?) };
        out.hand_over(change(&surface.surface)?.into());
        Ok(())
    })
}

/// As [`reshape`], for operations that also tell by how much the surface moved.
///
/// # Safety
/// As there; `moved` is NULL or room for one number.
unsafe fn reshape_within(
    surface: *const Surface,
    moved: *mut f64,
    out: *mut *mut Surface,
    change: impl FnOnce(&NurbsSurface) -> Result<(NurbsSurface, f64)>,
) -> i32 {
    // SAFETY: promised by the caller.
    unsafe {
        reshape(surface, out, |surface| {
            let place = ArrayOut::new(moved, 1, "moved")?;
            let (changed, moved) = change(surface)?;
            place.fill([moved]);
            Ok(changed)
        })
    }
}

/// The same surface with knots inserted along a direction, as bladesmith_curve_refine().
///
/// direction: 0 for u, 1 for v.
/// knots: [count] in the inside of the domain, not decreasing.
/// Units: those of the parameter.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where a knot lies elsewhere or would
/// stand more often than the degree.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_refine(
    surface: *const Surface,
    direction: u32,
    knots: *const f64,
    count: usize,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles and states the length of the array.
    unsafe {
        reshape(surface, out, |surface| {
            surface.refined(self::direction(direction)?, numbers(knots, count, "knots")?)
        })
    }
}

/// The surface with a knot along a direction removed as often as the surface moves by no more than a
/// tolerance in all, as bladesmith_curve_remove_knot().
///
/// direction: 0 for u, 1 for v.
/// t: the knot, exactly.
/// times: how often it shall be removed, at most as often as it stands there.
/// tolerance: not negative.
/// moved: [1] is set to a bound of the movement; may be NULL.
/// Units: tolerance and moved mm.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for a knot that does not stand
/// there so often.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_remove_knot(
    surface: *const Surface,
    direction: u32,
    t: f64,
    times: u32,
    tolerance: f64,
    moved: *mut f64,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles and room for the number.
    unsafe {
        reshape_within(surface, moved, out, |surface| {
            let (t, within) = (number(t, "t")?, self::tolerance(tolerance, "tolerance")?);
            surface.remove_knot(self::direction(direction)?, t, times as usize, within)
        })
    }
}

/// The same surface, clamped, with its degree along a direction raised.
///
/// direction: 0 for u, 1 for v.
/// by: by how much; the new degree is at most 25.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE beyond the highest degree and for
/// surfaces that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_elevate(
    surface: *const Surface,
    direction: u32,
    by: u32,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(surface, out, |surface| surface.elevated(self::direction(direction)?, by as usize)) }
}

/// A surface of a degree lower by one along a direction that is, at equal parameters, no further
/// away than a tolerance.
///
/// direction: 0 for u, 1 for v.
/// tolerance: not negative.
/// moved: [1] is set to a bound of the distance; may be NULL.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_NUMERICS where the tolerance cannot be met;
/// BLADESMITH_STATUS_SPLINE for degree 1 and surfaces that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_reduce(
    surface: *const Surface,
    direction: u32,
    tolerance: f64,
    moved: *mut f64,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles and room for the number.
    unsafe {
        reshape_within(surface, moved, out, |surface| {
            surface.reduced(self::direction(direction)?, self::tolerance(tolerance, "tolerance")?)
        })
    }
}

/// The part of a surface between two parameters along a direction; two parts split it.
///
/// direction: 0 for u, 1 for v.
/// from, to: ascending, in the domain.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty part or one outside.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_part(
    surface: *const Surface,
    direction: u32,
    from: f64,
    to: f64,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe {
        reshape(surface, out, |surface| {
            surface.part(self::direction(direction)?, number(from, "from")?, number(to, "to")?)
        })
    }
}

/// The surface run backwards along a direction, over the same domain.
///
/// direction: 0 for u, 1 for v.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_reverse(
    surface: *const Surface,
    direction: u32,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(surface, out, |surface| Ok(surface.reversed(self::direction(direction)?))) }
}

/// The surface with u and v exchanged; its normal turns round.
///
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_swap(surface: *const Surface, out: *mut *mut Surface) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(surface, out, |surface| Ok(surface.swapped())) }
}

/// The same surface over another domain along a direction.
///
/// direction: 0 for u, 1 for v.
/// from, to: ascending.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for an empty domain.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_over(
    surface: *const Surface,
    direction: u32,
    from: f64,
    to: f64,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe {
        reshape(surface, out, |surface| {
            let (from, to) = (number(from, "from")?, number(to, "to")?);
            surface.over(self::direction(direction)?, from, to)
        })
    }
}

/// The same surface with the end knots of both directions repeated degree + 1 times.
///
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where rounding leaves no such knots.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_clamp(surface: *const Surface, out: *mut *mut Surface) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe { reshape(surface, out, NurbsSurface::clamped) }
}

/// The image of a surface under an affine map, exactly.
///
/// matrix: [3][4]: row by row, the last column a shift.
/// Units: the shift as the poles.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where numbers overflow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_map(
    surface: *const Surface,
    matrix: *const f64,
    out: *mut *mut Surface,
) -> i32 {
    // SAFETY: the header asks for live handles and states the length of the array.
    unsafe {
        reshape(surface, out, |surface| {
            let map = Affine::new(numbers(matrix, 12, "matrix")?);
            surface.mapped(|p| map.of(p))
        })
    }
}

/// The curve along which the parameter of a direction stays the same, exactly; it runs over the
/// other parameter.
///
/// direction: 0 for constant u, 1 for constant v.
/// t: that parameter, in the domain.
/// Owner: `*out` is the caller's, for bladesmith_curve_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for a parameter outside.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_isocurve(
    surface: *const Surface,
    direction: u32,
    t: f64,
    out: *mut *mut Curve,
) -> i32 {
    // SAFETY: the header asks for live handles.
    unsafe {
        reshape(surface, out, |surface| {
            let direction = self::direction(direction)?;
            surface.isocurve(direction, within(number(t, "t")?, surface.knots(direction).domain())?)
        })
    }
}

fn within(t: f64, (a, b): (f64, f64)) -> Result<f64> {
    if (a..=b).contains(&t) {
        return Ok(t);
    }
    Err(crate::Error::Argument { name: "t", why: format!("is {t}; the domain is [{a}, {b}]") })
}
