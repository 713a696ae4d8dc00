//! Several surfaces as a result.

use super::surface::Surface;
use crate::error::Error;
use crate::ffi::guard::{guard, guard_silent};
use crate::ffi::handle::{self, Out};
use crate::nurbs::NurbsSurface;

/// Surfaces that a call made, as many as there are. Opaque and unchanging.
pub struct Surfaces {
    surfaces: Vec<NurbsSurface>,
}

/// The Bézier patches of a surface, each over the spans it came from, those along v next to each
/// other.
///
/// Owner: `*out` is the caller's, for bladesmith_surfaces_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT; BLADESMITH_STATUS_SPLINE for surfaces that jump.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_bezier(surface: *const Surface, out: *mut *mut Surfaces) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one.
        let (surface, out) = unsafe { (handle::borrow(surface, "surface")?, Out::new(out, "out")?) };
        out.hand_over(Surfaces { surfaces: surface.surface.bezier_patches()? });
        Ok(())
    })
}

/// Number of surfaces.
///
/// Owner: the caller gives the place.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surfaces_count(surfaces: *const Surfaces, count: *mut usize) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one number.
        let (surfaces, count) = unsafe { (handle::borrow(surfaces, "surfaces")?, Out::new(count, "count")?) };
        count.write(surfaces.surfaces.len());
        Ok(())
    })
}

/// One of the surfaces, as a handle of its own.
///
/// index: from 0.
/// Owner: `*out` is the caller's, for bladesmith_surface_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for an index that is not there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surfaces_get(
    surfaces: *const Surfaces,
    index: usize,
    out: *mut *mut Surface,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for one.
        let (surfaces, out) = unsafe { (handle::borrow(surfaces, "surfaces")?, Out::new(out, "out")?) };
        let surface = surfaces.surfaces.get(index).ok_or_else(|| Error::Argument {
            name: "index",
            why: format!("is {index}; there are {} surfaces, counted from 0", surfaces.surfaces.len()),
        })?;
        out.hand_over(surface.clone().into());
        Ok(())
    })
}

/// Frees the list; NULL is fine. Surfaces taken from it stay. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surfaces_free(surfaces: *mut Surfaces) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(surfaces) });
}
