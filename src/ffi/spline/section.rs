//! Where surfaces meet planes and each other, and curves projected onto surfaces.

use super::curve::Curve;
use super::curves::{Curves, of_dimension};
use super::surface::Surface;
use super::table::Table;
use super::{Row, filled, tolerance};
use crate::error::{Error, Result};
use crate::ffi::guard::{guard, guard_silent};
use crate::ffi::handle::{self, Out};
use crate::ops::{project, section};
use glam::DVec3;

/// Where a surface meets a plane or another surface. Opaque and unchanging.
pub struct Section {
    section: section::Section,
}

/// The intersection of a surface with a plane.
///
/// origin, normal: [3] a point of the plane and its direction, of any length but 0.
/// tolerance: how far results may be from both; above 0.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_section_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for a tolerance below what rounding allows;
/// BLADESMITH_STATUS_SPLINE for surfaces that jump; BLADESMITH_STATUS_NUMERICS where they meet in too
/// many places to follow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_section(
    surface: *const Surface,
    origin: *const f64,
    normal: *const f64,
    tolerance: f64,
    out: *mut *mut Section,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for a live handle and room for one, and states the lengths.
        let (surface, origin, normal, out) = unsafe {
            (
                handle::borrow(surface, "surface")?,
                DVec3::row(origin, "origin")?,
                DVec3::row(normal, "normal")?,
                Out::new(out, "out")?,
            )
        };
        out.hand_over(Section { section: section::with_plane(&surface.surface, origin, normal, within)? });
        Ok(())
    })
}

/// The intersection of two surfaces.
///
/// other: another surface.
/// tolerance: how far results may be from both; above 0.
/// Units: mm.
/// Owner: `*out` is the caller's, for bladesmith_section_free(); written only on success.
/// Errors: as bladesmith_surface_section().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_intersect(
    surface: *const Surface,
    other: *const Surface,
    tolerance: f64,
    out: *mut *mut Section,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for live handles and room for one.
        let (surface, other, out) = unsafe {
            (handle::borrow(surface, "surface")?, handle::borrow(other, "other")?, Out::new(out, "out")?)
        };
        out.hand_over(Section { section: section::with_surface(&surface.surface, &other.surface, within)? });
        Ok(())
    })
}

/// The curves of an intersection: branches that end at borders, seams and places where others cross.
///
/// curves: each branch in space, over its length.
/// first, second: its parameters on the surface, and on the other surface or the plane, as curves in
/// the plane over the same parameter; in a plane as bladesmith_section_axes() tells.
/// branches: a table with the columns closed, touching, deviation: 1 or 0 whether the end is the
/// start, and whether the surfaces touch along it rather than cross; and how far curves and
/// parameters were seen to be from the true branch.
/// Units: mm.
/// Owner: the three lists are the caller's, for bladesmith_curves_free(), and the table, for
/// bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_section_branches(
    section: *const Section,
    curves: *mut *mut Curves,
    first: *mut *mut Curves,
    second: *mut *mut Curves,
    branches: *mut *mut Table,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for four.
        let (section, curves, first, second, table) = unsafe {
            (
                handle::borrow(section, "section")?,
                Out::new(curves, "curves")?,
                Out::new(first, "first")?,
                Out::new(second, "second")?,
                Out::new(branches, "branches")?,
            )
        };
        let found = &section.section.branches;
        let number = |is: bool| f64::from(u8::from(is));
        curves.hand_over(found.iter().map(|b| b.curve.clone()).collect());
        first.hand_over(found.iter().map(|b| b.parameters[0].clone()).collect());
        second.hand_over(found.iter().map(|b| b.parameters[1].clone()).collect());
        let row = |b: &section::Branch| [number(b.closed), number(b.touching), b.deviation_mm];
        table.hand_over(Table::new(found.iter().map(row)));
        Ok(())
    })
}

/// What else an intersection holds.
///
/// touching: a table with the columns x, y, z, u, v, s, t, gap, crossing of points in which the
/// tangent planes agree: (u, v) on the surface, (s, t) on the other or the plane, how far both are
/// apart, and 1 where two branches cross there or 0 where it is a single point.
/// overlaps: a table with the columns u0, v0, u1, v1: corners of rectangles of the surface's
/// parameters over which both are one.
/// uncertain: a table with the columns u, v: parameters of the surface around which the contact is
/// too close to decide, or where a branch could not be followed to its end.
/// Units: mm.
/// Owner: the tables are the caller's, for bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_section_contacts(
    section: *const Section,
    touching: *mut *mut Table,
    overlaps: *mut *mut Table,
    uncertain: *mut *mut Table,
) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for three.
        let (section, touching, overlaps, uncertain) = unsafe {
            (
                &handle::borrow(section, "section")?.section,
                Out::new(touching, "touching")?,
                Out::new(overlaps, "overlaps")?,
                Out::new(uncertain, "uncertain")?,
            )
        };
        touching.hand_over(Table::new(section.touching.iter().map(|p| {
            let ([x, y, z], [first, second]) = (p.point.to_array(), p.parameters);
            [x, y, z, first.x, first.y, second.x, second.y, p.gap_mm, f64::from(u8::from(p.crossing))]
        })));
        overlaps.hand_over(Table::new(section.overlaps.iter().map(|[a, b]| [a.x, a.y, b.x, b.y])));
        uncertain.hand_over(Table::new(section.uncertain.iter().map(|uv| uv.to_array())));
        Ok(())
    })
}

/// The axes to which parameters on the plane of an intersection refer.
///
/// out: [3][3] the origin and two unit vectors: (s, t) is the point origin + s x + t y.
/// Units: origin mm.
/// Owner: the caller gives the array; written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for an intersection of two surfaces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_section_axes(section: *const Section, out: *mut f64) -> i32 {
    guard(|| {
        // SAFETY: the header asks for a live handle and room for nine numbers.
        let (section, out) =
            unsafe { (handle::borrow(section, "section")?, filled(out.cast::<DVec3>(), 3, "out")?) };
        let axes = section.section.axes.ok_or_else(|| Error::Argument {
            name: "section",
            why: "is one of two surfaces; only one with a plane has axes".into(),
        })?;
        out.fill(axes);
        Ok(())
    })
}

/// Frees an intersection; NULL is fine. Lists and tables taken from it stay. No call may be using it.
///
/// Owner: the library again; the handle must not be used any more.
/// Errors: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_section_free(section: *mut Section) {
    // SAFETY: the header asks for a handle that is not used any more.
    guard_silent(|| unsafe { handle::free(section) });
}

/// A curve in space projected onto a surface: to the nearest points, or along a direction.
///
/// direction: [3] of any length but 0: all points of the surface on lines along it through the curve,
/// each part over its length. Or NULL: the nearest points where they are the feet of perpendiculars,
/// over the parameter of the curve; one part for each stretch over which they move without leap.
/// tolerance: how far parts may be from the true projection; above 0.
/// curves: the parts in space.
/// parameters: their parameters on the surface, as curves in the plane over the same parameter.
/// deviations: a table with the column deviation: how far each was seen to be.
/// Units: mm.
/// Owner: both lists are the caller's, for bladesmith_curves_free(), and the table, for
/// bladesmith_table_free(); written only on success.
/// Errors: BLADESMITH_STATUS_ARGUMENT, also for a curve in the plane or along the direction;
/// BLADESMITH_STATUS_SPLINE for shapes that jump; BLADESMITH_STATUS_NUMERICS where the tolerance is not
/// met, or lines touch the surface too closely.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bladesmith_surface_project(
    surface: *const Surface,
    curve: *const Curve,
    direction: *const f64,
    tolerance: f64,
    curves: *mut *mut Curves,
    parameters: *mut *mut Curves,
    deviations: *mut *mut Table,
) -> i32 {
    guard(|| {
        let within = self::tolerance(tolerance, "tolerance")?;
        // SAFETY: the header asks for live handles and room for three.
        let (surface, curve, curves, parameters, deviations) = unsafe {
            (
                &handle::borrow(surface, "surface")?.surface,
                of_dimension(handle::borrow(curve, "curve")?, "curve")?,
                Out::new(curves, "curves")?,
                Out::new(parameters, "parameters")?,
                Out::new(deviations, "deviations")?,
            )
        };
        // SAFETY: the header states the length of the array.
        let found = match unsafe { optional_row(direction) }? {
            Some(direction) => project::along(curve, surface, direction, within)?,
            None => project::to_nearest(curve, surface, within)?,
        };
        deviations.hand_over(Table::new(found.iter().map(|part| [part.deviation_mm])));
        curves.hand_over(found.iter().map(|part| part.curve.clone()).collect());
        parameters.hand_over(found.into_iter().map(|part| part.parameters).collect());
        Ok(())
    })
}

/// A direction of the caller; NULL is none.
///
/// # Safety
/// If not NULL, `direction` must point to three numbers.
unsafe fn optional_row(direction: *const f64) -> Result<Option<DVec3>> {
    // SAFETY: promised by the caller.
    (!direction.is_null()).then(|| unsafe { DVec3::row(direction, "direction") }).transpose()
}
