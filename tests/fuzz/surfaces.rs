//! Calls that make, evaluate and reshape surfaces.

use super::calls::{Pool, knots_along, parameter, parameters_of, pointer, read_table, room, tolerance};
use super::source::Source;
use bladesmith::ffi::spline::Surface;
use bladesmith::ffi::spline::nearest::*;
use bladesmith::ffi::spline::surface::*;
use bladesmith::ffi::spline::surface_make::*;
use bladesmith::ffi::spline::surface_reshape::*;
use bladesmith::ffi::spline::surfaces::*;
use std::ptr::null_mut;

pub fn make_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let (p, q) = (source.degree(), source.degree());
    let (u, v) = (source.knots(p), source.knots(q));
    let along = |knots: &[f64], degree: u32| knots.len().saturating_sub(degree.min(30) as usize + 1);
    let count = along(&u, p) * along(&v, q);
    let (poles, weights) = (source.numbers(3 * count), source.weights(count));
    let mut out = null_mut();
    // SAFETY: the arrays are as long as announced.
    let status = unsafe {
        let (ku, nu, kv, nv, poles) = (u.as_ptr(), u.len(), v.as_ptr(), v.len(), poles.as_ptr());
        bladesmith_surface_new(p, q, ku, nu, kv, nv, poles, pointer(&weights), count, &mut out)
    };
    pool.keep_surface(source, out);
    status
}

/// Pairs of parameters of a surface or near it.
pub fn pairs_of(source: &mut Source, surface: *const Surface, count: usize) -> Vec<f64> {
    let knots = [knots_along(surface, 0), knots_along(surface, 1)];
    (0..2 * count).map(|i| parameter(source, &knots[i % 2])).collect()
}

pub fn evaluate_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, order) = (pool.surface(source), source.small());
    let uv = pairs_of(source, surface, 7);
    let each = (order.min(30) as usize + 1) * (order.min(30) as usize + 2) / 2;
    let mut out = room(7 * each * 3);
    let (mut normals, mut curvatures, mut directions) = (room(21), room(14), room(42));
    let (uv, out) = (uv.as_ptr(), out.as_mut_ptr());
    // SAFETY: the arrays are as long as the header asks for.
    unsafe {
        if source.once_in(4) {
            let (k, d) = (curvatures.as_mut_ptr(), directions.as_mut_ptr());
            bladesmith_surface_curvatures(surface, uv, 7, normals.as_mut_ptr(), k, d)
        } else {
            bladesmith_surface_evaluate(surface, uv, 7, order, source.small(), source.small(), out)
        }
    }
}

pub fn evaluate_on_grid(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, order) = (pool.surface(source), source.small());
    let u = parameters_of(source, &knots_along(surface, 0), 3);
    let v = parameters_of(source, &knots_along(surface, 1), 2);
    let mut out = room(6 * 6 * 3);
    // SAFETY: the arrays are as long as the header asks for.
    unsafe {
        bladesmith_surface_evaluate_grid(surface, u.as_ptr(), 3, v.as_ptr(), 2, order, out.as_mut_ptr())
    }
}

pub fn patches_of_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let (mut list, mut count, mut out) = (null_mut(), 0, null_mut());
    // SAFETY: the handle is alive or NULL, the list alive, and not used any more.
    let status = unsafe {
        let status = bladesmith_surface_bezier(pool.surface(source), &mut list);
        if !list.is_null() {
            bladesmith_surfaces_count(list, &mut count);
            bladesmith_surfaces_get(list, source.below(count + 1), &mut out);
        }
        bladesmith_surfaces_free(list);
        status
    };
    pool.keep_surface(source, out);
    status
}

pub fn reshape_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let surface = pool.surface(source);
    let direction = if source.once_in(60) { source.small() } else { source.below(2) as u32 };
    let mut t = parameters_of(source, &knots_along(surface, direction), 2);
    if !source.once_in(5) {
        t.sort_by(f64::total_cmp);
    }
    let (matrix, within, few) = (source.numbers(12), tolerance(source), source.small());
    let (mut moved, mut out, mut curve) = (f64::NAN, null_mut(), null_mut());
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        match source.below(11) {
            0 => bladesmith_surface_refine(surface, direction, t.as_ptr(), t.len(), &mut out),
            1 => bladesmith_surface_remove_knot(surface, direction, t[0], few, within, &mut moved, &mut out),
            2 => bladesmith_surface_elevate(surface, direction, few, &mut out),
            3 => bladesmith_surface_reduce(surface, direction, within, &mut moved, &mut out),
            4 => bladesmith_surface_part(surface, direction, t[0], t[1], &mut out),
            5 => bladesmith_surface_reverse(surface, direction, &mut out),
            6 => bladesmith_surface_swap(surface, &mut out),
            7 => bladesmith_surface_clamp(surface, &mut out),
            8 => bladesmith_surface_map(surface, matrix.as_ptr(), &mut out),
            9 => bladesmith_surface_over(surface, direction, t[0], t[1], &mut out),
            _ => bladesmith_surface_isocurve(surface, direction, t[0], &mut curve),
        }
    };
    pool.keep_surface(source, out);
    pool.keep_curve(source, curve);
    status
}

pub fn surfaces_of_curves(source: &mut Source, pool: &mut Pool) -> i32 {
    let curves: Vec<_> = (0..4).map(|_| pool.curve(source)).collect();
    let numbers = source.numbers(6);
    let mut t = source.numbers(4);
    t.sort_by(f64::total_cmp);
    let (count, degree, angle) = (source.below(5), source.small(), source.number());
    let mut out = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        match source.below(4) {
            0 => bladesmith_surface_ruled(curves[0], curves[1], &mut out),
            1 => bladesmith_surface_revolved(
                curves[0],
                numbers.as_ptr(),
                numbers[3..].as_ptr(),
                angle,
                &mut out,
            ),
            2 => bladesmith_surface_coons(curves.as_ptr(), &mut out),
            _ => bladesmith_surface_skin(curves.as_ptr(), t.as_ptr(), count, degree, &mut out),
        }
    };
    pool.keep_surface(source, out);
    status
}

pub fn nearest_on_surface(source: &mut Source, pool: &mut Pool) -> i32 {
    let (surface, points, tie) = (pool.surface(source), source.numbers(6), tolerance(source));
    let (mut uv, mut feet, mut distances) = (room(4), room(6), room(2));
    let mut table = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        if source.once_in(3) {
            bladesmith_surface_nearest_all(surface, points.as_ptr(), tie, &mut table)
        } else {
            let (uv, feet, distances) = (uv.as_mut_ptr(), feet.as_mut_ptr(), distances.as_mut_ptr());
            bladesmith_surface_nearest(surface, points.as_ptr(), 2, uv, feet, distances)
        }
    };
    read_table(table);
    status
}
