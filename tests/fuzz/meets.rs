//! Calls that find where shapes meet, and offsets.

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

pub fn offset_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, within) = (pool.surface(source), tolerance(source));
    // Arbitrary surfaces bend sharply: larger distances would all be refused.
    let distance = if source.once_in(2) { source.number() } else { 0.1 * source.unit() };
    let (mut deviation, mut out) = (f64::NAN, null_mut());
    let place = if source.once_in(4) { null_mut() } else { &raw mut deviation };
    // SAFETY: the handle is alive or NULL.
    let status = unsafe { bladesmith_surface_offset(surface, distance, within, place, &mut out) };
    pool.keep_surface(source, out);
    status
}
