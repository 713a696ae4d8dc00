//! Calls that cut: fillets between curves, sections and projections of surfaces, first hits.

use super::calls::{Pool, read_table, room, tolerance};
use super::source::Source;
use bladesmith::ffi::spline::Curves;
use bladesmith::ffi::spline::curves::*;
use bladesmith::ffi::spline::fillet::*;
use bladesmith::ffi::spline::ray::*;
use bladesmith::ffi::spline::section::*;
use std::ptr::{null, null_mut};

/// Keeps one of the curves and frees the list.
pub fn take_one(source: &mut Source, pool: &mut Pool, list: *mut Curves) {
    let (mut count, mut out) = (0, null_mut());
    if !list.is_null() {
        // SAFETY: the list is alive, and not used any more.
        unsafe {
            bladesmith_curves_count(list, &mut count);
            bladesmith_curves_get(list, source.below(count + 1), &mut out);
            bladesmith_curves_free(list);
        }
    }
    pool.keep_curve(source, out);
}

/// A tolerance that is not small: with others each call takes seconds.
pub fn coarse(source: &mut Source) -> f64 {
    let within = tolerance(source);
    if within > 0.0 { within.max(1e-4) } else { within }
}

pub fn round_corners(source: &mut Source, pool: &mut Pool) -> i32 {
    let (curve, other) = (pool.curve(source), pool.curve(source));
    let radius = if source.once_in(4) { source.number() } else { 0.01 + source.unit() };
    let (near, within) = (source.numbers(2), coarse(source));
    let (mut list, mut table) = (null_mut(), null_mut());
    let near = if source.once_in(2) { null() } else { near.as_ptr() };
    // SAFETY: the handles are alive or NULL, the array is as long as the header asks for.
    let status = unsafe {
        if source.once_in(2) {
            bladesmith_curve_fillets(curve, other, radius, within, &mut list, &mut table)
        } else {
            bladesmith_curve_fillet(curve, other, radius, within, near, &mut list, &mut table)
        }
    };
    take_one(source, pool, list);
    read_table(table);
    status
}

pub fn cut_surfaces(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, other, within) = (pool.surface(source), pool.surface(source), coarse(source));
    let plane = source.numbers(6);
    let (mut section, mut axes) = (null_mut(), room(9));
    let mut lists = [null_mut(); 3];
    let mut tables = [null_mut(); 4];
    // SAFETY: the handles are alive or NULL, the arrays are as long as the header asks for.
    let status = unsafe {
        let status = if source.once_in(2) {
            bladesmith_surface_section(surface, plane.as_ptr(), plane[3..].as_ptr(), within, &mut section)
        } else {
            bladesmith_surface_intersect(surface, other, within, &mut section)
        };
        if !section.is_null() {
            let [a, b, c] = &mut lists;
            let [d, e, f, g] = &mut tables;
            bladesmith_section_branches(section, a, b, c, d);
            bladesmith_section_contacts(section, e, f, g);
            bladesmith_section_axes(section, axes.as_mut_ptr());
        }
        bladesmith_section_free(section);
        status
    };
    lists.into_iter().for_each(|list| take_one(source, pool, list));
    tables.into_iter().for_each(read_table);
    status
}

pub fn project_curves(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, curve, within) = (pool.surface(source), pool.curve(source), coarse(source));
    let direction = source.numbers(3);
    let direction = if source.once_in(2) { null() } else { direction.as_ptr() };
    let (mut curves, mut parameters, mut table) = (null_mut(), null_mut(), null_mut());
    // SAFETY: the handles are alive or NULL, the array is as long as the header asks for.
    let status = unsafe {
        bladesmith_surface_project(
            surface,
            curve,
            direction,
            within,
            &mut curves,
            &mut parameters,
            &mut table,
        )
    };
    take_one(source, pool, curves);
    take_one(source, pool, parameters);
    read_table(table);
    status
}

pub fn cast_many(source: &mut Source, pool: &mut Pool) -> i32 {
    let (points, within) = (source.numbers(18), tolerance(source));
    let (origins, directions) = (points.as_ptr(), points[9..].as_ptr());
    let (mut lengths, mut at, mut hits) = (room(3), room(6), room(9));
    let (lengths, at, hits) = (lengths.as_mut_ptr(), at.as_mut_ptr(), hits.as_mut_ptr());
    // SAFETY: the arrays are as long as the header asks for.
    unsafe {
        if source.once_in(2) {
            bladesmith_curve_first_hits(pool.curve(source), origins, directions, 3, within, lengths, at, hits)
        } else {
            let surface = pool.surface(source);
            bladesmith_surface_first_hits(surface, origins, directions, 3, within, lengths, at, hits)
        }
    }
}
