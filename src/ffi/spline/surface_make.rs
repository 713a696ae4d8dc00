//! Surfaces made from curves in space.

use super::curve::Curve;
use super::curves::{borrow_all, copies, of_dimension};
use super::surface::Surface;
use super::{Row, number, numbers};
use crate::ffi::guard::guard;
use crate::ffi::handle::{self, Out};
use crate::nurbs::NurbsSurface;
use crate::ops::skin::skin;
use glam::DVec3;

/// The surface of the lines between points of two curves at equal parameters: u runs along the
/// curves, v in [0, 1] from the first to the second.
///
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_ruled(
    first: *const Curve,
    second: *const Curve,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for live handles and room for one.
        let (first, second, out) = unsafe {
            (handle::borrow(first, "first")?, handle::borrow(second, "second")?, Out::new(out, "out")?)
        };
        let (first, second) = (of_dimension(first, "first")?, of_dimension(second, "second")?);
        out.hand_over(NurbsSurface::ruled(first, second)?.into());
        Ok(())
    })
}

/// The surface that a curve sweeps when it turns about an axis, exactly: u runs along the curve, v
/// in [0, 1] with the turn.
///
/// origin, axis: [3] a point of the axis and its direction, of any length.
/// angle: in rad, counterclockwise seen against the axis; at most a full turn either way.
/// Units: origin mm.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_revolved(
    curve: *const Curve,
    origin: *const f64,
    axis: *const f64,
    angle: f64,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        let angle = number(angle, "angle")?;
        // SAFETY: the header asks for live handles and states the lengths of the arrays.
        let (curve, origin, axis, out) = unsafe {
            (
                handle::borrow(curve, "curve")?,
                DVec3::row(origin, "origin")?,
                DVec3::row(axis, "axis")?,
                Out::new(out, "out")?,
            )
        };
        out.hand_over(NurbsSurface::revolved(of_dimension(curve, "curve")?, origin, axis, angle)?.into());
        Ok(())
    })
}

/// The bilinearly blended Coons patch between four curves that meet in four corners.
///
/// curves: [4] along u at the start and the end of v, then along v at the start and the end of u.
/// Domains are those of the first of each pair.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for curves that do not meet, and
/// for weights that fall so far below those of the ends that the blend has none above zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_coons(
    curves: *const *const Curve,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for four live handles and room for one.
        let (curves, out) = unsafe { (borrow_all(curves, 4)?, Out::new(out, "out")?) };
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| of_dimension(curves[i], "curves"));
        out.hand_over(NurbsSurface::coons([a?, b?], [c?, d?])?.into());
        Ok(())
    })
}

/// The surface through sections: u runs along them, v across.
///
/// sections: [count] curves, more than degree.
/// parameters: [count] ascending values of v at which the surface holds the sections.
/// degree: along v.
/// Units: those of the parameter.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE where weights are too uneven to be
/// blended.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_skin(
    sections: *const *const Curve,
    parameters: *const f64,
    count: usize,
    degree: u32,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for live handles and states the lengths of the arrays.
        let (sections, parameters, out) = unsafe {
            (borrow_all(sections, count)?, numbers(parameters, count, "parameters")?, Out::new(out, "out")?)
        };
        out.hand_over(skin(&copies(&sections)?, parameters, degree as usize)?.into());
        Ok(())
    })
}
