//! Calls that find where shapes meet, and offsets.

use super::calls::{Pool, knots_of, parameters_of, read_table, room, tolerance};
use super::cuts::{coarse, take_one};
use super::source::Source;
use bladesmith::ffi::spline::intersect::*;
use bladesmith::ffi::spline::offset::*;
use bladesmith::ffi::spline::ray::*;
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
    let (curve, distance, within) = (pool.curve(source), source.number(), coarse(source));
    let limit = if source.once_in(2) { 0.0 } else { source.number() };
    let (mut list, mut pieces) = (null_mut(), null_mut());
    let call = if source.once_in(4) { bladesmith_curve_offset_raw } else { bladesmith_curve_offset };
    // SAFETY: the handle is alive or NULL.
    let status = unsafe { call(curve, distance, within, limit, &mut list, &mut pieces) };
    read_table(pieces);
    take_one(source, pool, list);
    status
}

pub fn offset_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, within) = (pool.surface(source), tolerance(source));
    // Arbitrary surfaces bend sharply: larger distances would all be refused.
    let distance = if source.once_in(4) { source.number() } else { 1e-3 * source.unit() };
    let (mut deviation, mut out) = (f64::NAN, null_mut());
    let place = if source.once_in(4) { null_mut() } else { &raw mut deviation };
    // SAFETY: the handle is alive or NULL.
    let status = unsafe { bladesmith_surface_offset(surface, distance, within, place, &mut out) };
    pool.keep_surface(source, out);
    status
}

pub fn map_to_offset(source: &mut Source, pool: &mut Pool) -> i32 {
    let (mut pieces, t, curve) = (source.numbers(10), source.numbers(4), pool.curve(source));
    if !source.once_in(4) {
        // What was kept of the curve, as a rule.
        let knots = knots_of(curve);
        for row in pieces.chunks_mut(5) {
            let mut kept = parameters_of(source, &knots, 2);
            kept.sort_by(f64::total_cmp);
            row[3..].copy_from_slice(&kept);
        }
    }
    let (count, mut out) = (source.below(3), room(4));
    let (rows, t) = (pieces.as_ptr(), t.as_ptr());
    // SAFETY: the arrays are as long as the header asks for.
    unsafe { bladesmith_curve_offset_map(curve, rows, count, t, 4, out.as_mut_ptr()) }
}
