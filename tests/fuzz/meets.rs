//! Calls that find where shapes meet, and offsets of curves: those of surfaces have no bound of their
//! time yet.

use super::calls::{Pool, read_table, tolerance};
use super::source::Source;
use bladesmith::ffi::spline::curves::*;
use bladesmith::ffi::spline::intersect::*;
use bladesmith::ffi::spline::offset::*;
use std::ptr::null_mut;

pub fn meet_curves(source: &mut Source, pool: &mut Pool) -> i32 {
    let (curve, other, within) = (pool.curve(source), pool.curve(source), tolerance(source));
    let (mut crossings, mut overlaps) = (null_mut(), null_mut());
    // SAFETY: the handles are alive or NULL.
    let status = unsafe {
        if source.once_in(2) {
            bladesmith_curve_self_intersect(curve, within, &mut crossings, &mut overlaps)
        } else {
            bladesmith_curve_intersect(curve, other, within, &mut crossings, &mut overlaps)
        }
    };
    read_table(crossings);
    read_table(overlaps);
    status
}

pub fn cast_rays(source: &mut Source, pool: &mut Pool) -> i32 {
    let (points, both, within) = (source.numbers(6), source.small(), tolerance(source));
    let (origin, direction) = (points.as_ptr(), points[3..].as_ptr());
    let mut table = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        if source.once_in(2) {
            bladesmith_curve_ray(pool.curve(source), origin, direction, both, within, &mut table)
        } else {
            bladesmith_surface_ray(pool.surface(source), origin, direction, both, within, &mut table)
        }
    };
    read_table(table);
    status
}

pub fn offset_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let (curve, distance, within) = (pool.curve(source), source.number(), tolerance(source));
    let limit = if source.once_in(2) { 0.0 } else { source.number() };
    let (mut list, mut pieces, mut out) = (null_mut(), null_mut(), null_mut());
    // SAFETY: the handle is alive or NULL; the list is not used any more.
    let status = unsafe {
        let status = bladesmith_curve_offset(curve, distance, within, limit, &mut list, &mut pieces);
        if !list.is_null() {
            bladesmith_curves_get(list, 0, &mut out);
        }
        bladesmith_curves_free(list);
        status
    };
    read_table(pieces);
    pool.keep_curve(source, out);
    status
}
