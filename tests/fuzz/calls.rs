//! Every call of the kernel with arbitrary arguments. Arrays are as long as the header asks for:
//! all else about them is arbitrary.

use super::cuts::{cast_many, cut_surfaces, project_curves, round_corners, take_one};
use super::meets::{cast_rays, map_to_offset, meet_curves, offset_curve, offset_surface};
use super::source::Source;
use super::surfaces::{
    evaluate_on_grid, evaluate_surface, make_surface, nearest_on_surface, patches_of_surface,
    reshape_surface, surfaces_of_curves,
};
use bladesmith::ffi::library::bladesmith_last_error;
use bladesmith::ffi::spline::curve::*;
use bladesmith::ffi::spline::curve_fit::*;
use bladesmith::ffi::spline::curve_make::*;
use bladesmith::ffi::spline::curve_reshape::*;
use bladesmith::ffi::spline::curves::*;
use bladesmith::ffi::spline::nearest::*;
use bladesmith::ffi::spline::surface::*;
use bladesmith::ffi::spline::table::*;
use bladesmith::ffi::spline::{Curve, Curves, Surface, Table};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

/// A name and its call, which returns the status.
pub type Call = (&'static str, fn(&mut Source, &mut Pool) -> i32);

/// Handles that calls have made, for others to use.
#[derive(Default)]
pub struct Pool {
    curves: Vec<*mut Curve>,
    surfaces: Vec<*mut Surface>,
}

/// Handles of each kind that are kept.
const KEPT: usize = 24;

impl Pool {
    pub fn curve(&self, source: &mut Source) -> *const Curve {
        if self.curves.is_empty() || source.once_in(200) {
            return null();
        }
        self.curves[source.below(self.curves.len())]
    }

    pub fn surface(&self, source: &mut Source) -> *const Surface {
        if self.surfaces.is_empty() || source.once_in(200) {
            return null();
        }
        self.surfaces[source.below(self.surfaces.len())]
    }

    pub fn keep_curve(&mut self, source: &mut Source, curve: *mut Curve) {
        if curve.is_null() {
            return;
        }
        if self.curves.len() < KEPT && curve_size(curve).2 < 60 {
            return self.curves.push(curve);
        }
        let hit = source.below(self.curves.len().max(1)).min(self.curves.len().saturating_sub(1));
        let dropped = match self.curves.get_mut(hit) {
            Some(place) if curve_size(curve).2 < 60 => std::mem::replace(place, curve),
            _ => curve,
        };
        // SAFETY: the handle is in no list any more.
        unsafe { bladesmith_curve_free(dropped) };
    }

    pub fn keep_surface(&mut self, source: &mut Source, surface: *mut Surface) {
        if surface.is_null() {
            return;
        }
        let small = surface_size(surface).1 < 400;
        if self.surfaces.len() < KEPT && small {
            return self.surfaces.push(surface);
        }
        let hit = source.below(self.surfaces.len().max(1)).min(self.surfaces.len().saturating_sub(1));
        let dropped = match self.surfaces.get_mut(hit) {
            Some(place) if small => std::mem::replace(place, surface),
            _ => surface,
        };
        // SAFETY: the handle is in no list any more.
        unsafe { bladesmith_surface_free(dropped) };
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        // SAFETY: the handles are this pool's and not used any more.
        unsafe {
            self.curves.iter().for_each(|&curve| bladesmith_curve_free(curve));
            self.surfaces.iter().for_each(|&surface| bladesmith_surface_free(surface));
        }
    }
}

/// What the last call said.
pub fn last_error() -> String {
    // SAFETY: the text is copied before this thread makes another call.
    unsafe { CStr::from_ptr(bladesmith_last_error()) }.to_string_lossy().into_owned()
}

/// Dimension, degree and number of poles.
fn curve_size(curve: *const Curve) -> (usize, usize, usize) {
    let (mut dimension, mut degree, mut count) = (3, 1, 1);
    // SAFETY: the handle is alive or NULL.
    unsafe { bladesmith_curve_size(curve, &mut dimension, &mut degree, &mut count, null_mut()) };
    (dimension as usize, degree as usize, count)
}

/// Degrees and the number of poles.
pub fn surface_size(surface: *const Surface) -> ([u32; 2], usize, [usize; 2]) {
    let (mut p, mut q, mut n, mut m) = (1, 1, 1, 1);
    // SAFETY: the handle is alive or NULL.
    unsafe { bladesmith_surface_size(surface, &mut p, &mut q, &mut n, &mut m, null_mut()) };
    ([p, q], n * m, [n, m])
}

pub fn pointer<T>(values: &Option<Vec<T>>) -> *const T {
    values.as_ref().map_or(null(), |values| values.as_ptr())
}

/// An array to write to, filled with what must not be read.
pub fn room(count: usize) -> Vec<f64> {
    vec![f64::NAN; count]
}

/// A parameter of a curve or near it: a knot as often as not.
pub fn parameter(source: &mut Source, knots: &[f64]) -> f64 {
    match source.below(6) {
        0..=2 if !knots.is_empty() => knots[source.below(knots.len())],
        3 => source.number(),
        _ => {
            let (a, b) = (knots.first().unwrap_or(&0.0), knots.last().unwrap_or(&1.0));
            a + (b - a) * (1.1 * source.unit() - 0.05)
        }
    }
}

pub fn parameters_of(source: &mut Source, knots: &[f64], count: usize) -> Vec<f64> {
    (0..count).map(|_| parameter(source, knots)).collect()
}

pub fn knots_of(curve: *const Curve) -> Vec<f64> {
    let (_, degree, count) = curve_size(curve);
    let mut knots = room(count + degree + 1);
    // SAFETY: the array is as long as the header asks for.
    unsafe { bladesmith_curve_data(curve, count, knots.as_mut_ptr(), null_mut(), null_mut()) };
    knots
}

pub fn knots_along(surface: *const Surface, direction: u32) -> Vec<f64> {
    let ([p, q], count, [n, m]) = surface_size(surface);
    let (mut u, mut v) = (room(n + p as usize + 1), room(m + q as usize + 1));
    // SAFETY: the arrays are as long as the header asks for.
    unsafe {
        bladesmith_surface_data(surface, count, u.as_mut_ptr(), v.as_mut_ptr(), null_mut(), null_mut())
    };
    if direction == 0 { u } else { v }
}

/// A tolerance of usual size.
pub fn tolerance(source: &mut Source) -> f64 {
    if source.once_in(8) { source.number() } else { 10f64.powi(-(source.below(12) as i32)) }
}

fn make_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let (dimension, degree) = (source.dimension(), source.degree());
    let knots = source.knots(degree);
    let count = knots.len().saturating_sub(degree.min(30) as usize + 1);
    let (poles, weights) = (source.numbers(3 * count), source.weights(count));
    let mut out = null_mut();
    // SAFETY: the arrays are as long as announced.
    let status = unsafe {
        let (knots, known) = (knots.as_ptr(), knots.len());
        bladesmith_curve_new(
            dimension,
            degree,
            knots,
            known,
            poles.as_ptr(),
            pointer(&weights),
            count,
            &mut out,
        )
    };
    pool.keep_curve(source, out);
    status
}

fn evaluate_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let curve = pool.curve(source);
    let (t, order) = (parameters_of(source, &knots_of(curve), 9), source.small());
    let mut out = room(9 * (order.min(30) as usize + 1) * 3);
    let (t, out) = (t.as_ptr(), out.as_mut_ptr());
    // SAFETY: the arrays are as long as the header asks for.
    unsafe { bladesmith_curve_evaluate(curve, t, 9, order, source.small(), out) }
}

fn frames_of_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let curve = pool.curve(source);
    let t = parameters_of(source, &knots_of(curve), 5);
    let (mut axes, mut curvatures, mut torsions) = (room(45), room(5), room(5));
    let (axes, curvatures, torsions) = (axes.as_mut_ptr(), curvatures.as_mut_ptr(), torsions.as_mut_ptr());
    // SAFETY: the arrays are as long as the header asks for.
    unsafe { bladesmith_curve_frames(curve, t.as_ptr(), 5, axes, curvatures, torsions) }
}

fn lengths_of_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let (curve, tolerance) = (pool.curve(source), tolerance(source));
    let values = parameters_of(source, &knots_of(curve), 4);
    let call = if source.once_in(2) { bladesmith_curve_lengths } else { bladesmith_curve_at_lengths };
    let mut out = room(4);
    // SAFETY: the arrays are as long as the header asks for.
    unsafe { call(curve, tolerance, values.as_ptr(), 4, out.as_mut_ptr()) }
}

fn reshape_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let curve = pool.curve(source);
    let knots = knots_of(curve);
    let mut t = parameters_of(source, &knots, 2);
    if !source.once_in(5) {
        t.sort_by(f64::total_cmp);
    }
    let (matrix, within) = (source.numbers(12), tolerance(source));
    let (mut moved, mut out) = (f64::NAN, null_mut());
    let place = if source.once_in(4) { null_mut() } else { &raw mut moved };
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        match source.below(9) {
            0 => bladesmith_curve_refine(curve, t.as_ptr(), t.len(), &mut out),
            1 => bladesmith_curve_remove_knot(curve, t[0], source.small(), within, place, &mut out),
            2 => bladesmith_curve_elevate(curve, source.small(), &mut out),
            3 => bladesmith_curve_reduce(curve, within, place, &mut out),
            4 => bladesmith_curve_part(curve, t[0], t[1], &mut out),
            5 => bladesmith_curve_reverse(curve, &mut out),
            6 => bladesmith_curve_over(curve, t[0], t[1], &mut out),
            7 => bladesmith_curve_clamp(curve, &mut out),
            _ => bladesmith_curve_map(curve, matrix.as_ptr(), source.dimension(), &mut out),
        }
    };
    pool.keep_curve(source, out);
    status
}

fn join_curves(source: &mut Source, pool: &mut Pool) -> i32 {
    let (first, next) = (pool.curve(source), pool.curve(source));
    let gap = if source.once_in(2) { 100.0 } else { tolerance(source) };
    let mut out = null_mut();
    // SAFETY: the handles are alive or NULL.
    let status = unsafe { bladesmith_curve_join(first, next, gap, source.small(), &mut out) };
    pool.keep_curve(source, out);
    status
}

fn list_curves(source: &mut Source, pool: &mut Pool) -> i32 {
    let handles: Vec<_> = (0..source.below(4)).map(|_| pool.curve(source)).collect();
    let mut list: *mut Curves = null_mut();
    // SAFETY: the handles are alive or NULL.
    let status = unsafe {
        if source.once_in(2) {
            bladesmith_curve_bezier(pool.curve(source), &mut list)
        } else {
            bladesmith_curves_compatible(handles.as_ptr(), handles.len(), &mut list)
        }
    };
    take_one(source, pool, list);
    status
}

fn closed_curves(source: &mut Source, pool: &mut Pool) -> i32 {
    let (dimension, degree) = (source.dimension(), source.degree());
    let breaks = source.knots(1);
    let count = breaks.len().saturating_sub(1);
    let (poles, weights, mut out) = (source.numbers(3 * count), source.weights(count), null_mut());
    let (knots, poles) = (breaks.as_ptr(), poles.as_ptr());
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        bladesmith_curve_periodic(dimension, degree, knots, breaks.len(), poles, pointer(&weights), &mut out)
    };
    pool.keep_curve(source, out);
    status
}

fn conics(source: &mut Source, pool: &mut Pool) -> i32 {
    let (points, dimension) = (source.numbers(12), source.dimension());
    let at = |i: usize| points[3 * i..].as_ptr();
    let through = if source.once_in(2) { null() } else { at(3) };
    let (from, to) = (source.number(), source.number());
    let mut out = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        if source.once_in(2) {
            bladesmith_curve_arc(dimension, at(0), at(1), at(2), from, to, &mut out)
        } else {
            bladesmith_curve_conic(dimension, at(0), at(1), at(2), through, from, &mut out)
        }
    };
    pool.keep_curve(source, out);
    status
}

fn parameters_of_points(source: &mut Source, _: &mut Pool) -> i32 {
    let (count, dimension) = (source.below(9), source.dimension());
    let points = source.numbers(3 * count);
    let mut out = room(count);
    let (spacing, factor) = (source.small(), source.number());
    if source.once_in(3) {
        let degree = source.degree();
        let mut knots = room(count + degree.min(30) as usize + 1);
        // SAFETY: as below.
        return unsafe { bladesmith_averaged_knots(degree, points.as_ptr(), count, knots.as_mut_ptr()) };
    }
    // SAFETY: the arrays are as long as the header asks for.
    unsafe { bladesmith_parameters(dimension, points.as_ptr(), count, spacing, factor, out.as_mut_ptr()) }
}

fn interpolate(source: &mut Source, pool: &mut Pool) -> i32 {
    let (dimension, degree, count) = (source.dimension(), source.degree(), source.below(12));
    let knots = source.once_in(3).then(|| source.knots(degree));
    let near = source.knots(1);
    let mut t = parameters_of(source, knots.as_ref().unwrap_or(&near), count);
    if source.once_in(2) {
        t.sort_by(f64::total_cmp);
    }
    let orders: Option<Vec<u32>> =
        source.once_in(2).then(|| (0..count).map(|_| source.small() / 2).collect());
    let values = source.numbers(3 * count);
    let mut out = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        let (t, orders, values) = (t.as_ptr(), pointer(&orders), values.as_ptr());
        let known = knots.as_ref().map_or(0, Vec::len);
        bladesmith_curve_interpolate(
            dimension,
            degree,
            t,
            orders,
            values,
            count,
            pointer(&knots),
            known,
            &mut out,
        )
    };
    pool.keep_curve(source, out);
    status
}

fn interpolate_closed(source: &mut Source, pool: &mut Pool) -> i32 {
    let (dimension, degree, count) = (source.dimension(), source.degree(), source.below(12));
    let near = source.knots(1);
    let mut t = parameters_of(source, &near, count + 1);
    if !source.once_in(4) {
        t.sort_by(f64::total_cmp);
    }
    let points = source.numbers(3 * count);
    let mut out = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        let (t, points) = (t.as_ptr(), points.as_ptr());
        bladesmith_curve_interpolate_closed(dimension, degree, t, points, count, &mut out)
    };
    pool.keep_curve(source, out);
    status
}

fn fit(source: &mut Source, pool: &mut Pool) -> i32 {
    let (dimension, degree, mut count) = (source.dimension(), source.degree(), source.below(30));
    let knots = source.knots(degree);
    let mut t = parameters_of(source, &knots, count);
    if !source.once_in(3) {
        // As a rule there are enough of them all over the knots.
        let (a, b) = (knots[0], knots[knots.len() - 1]);
        count = 4 * knots.len();
        t = (0..count).map(|i| a + (b - a) * (i as f64 + 0.5) / count as f64).collect();
    }
    let (points, weights) = (source.numbers(3 * count), source.weights(count));
    let (start, end) = (source.numbers(9), source.numbers(9));
    let (at_start, at_end) = (source.below(4), source.below(4));
    let (mut smoothing, mut out) = (f64::NAN, null_mut());
    let (flat, known, t, points, given) =
        (knots.as_ptr(), knots.len(), t.as_ptr(), points.as_ptr(), pointer(&weights));
    let amount = tolerance(source);
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        match source.below(3) {
            0 => {
                let (start, end) = (start.as_ptr(), end.as_ptr());
                let (d, p, k) = (dimension, degree, known);
                bladesmith_curve_fit(
                    d, p, flat, k, t, points, given, count, start, at_start, end, at_end, &mut out,
                )
            }
            1 => bladesmith_curve_smooth(
                dimension, degree, flat, known, t, points, given, count, amount, &mut out,
            ),
            _ => bladesmith_curve_smooth_within(
                dimension,
                degree,
                flat,
                known,
                t,
                points,
                given,
                count,
                amount,
                &mut smoothing,
                &mut out,
            ),
        }
    };
    pool.keep_curve(source, out);
    status
}

fn nearest_on_curve(source: &mut Source, pool: &mut Pool) -> i32 {
    let curve = pool.curve(source);
    let points = source.numbers(9);
    let (mut t, mut feet, mut distances) = (room(3), room(9), room(3));
    let tie = tolerance(source);
    let mut table = null_mut();
    // SAFETY: the arrays are as long as the header asks for.
    let status = unsafe {
        if source.once_in(3) {
            bladesmith_curve_nearest_all(curve, points.as_ptr(), tie, &mut table)
        } else {
            let (t, feet, distances) = (t.as_mut_ptr(), feet.as_mut_ptr(), distances.as_mut_ptr());
            bladesmith_curve_nearest(curve, points.as_ptr(), 3, t, feet, distances)
        }
    };
    read_table(table);
    status
}

/// Reads all rows of a table and frees it.
pub fn read_table(table: *mut Table) {
    if table.is_null() {
        return;
    }
    let (mut rows, mut columns) = (0, 0);
    // SAFETY: the table is alive, not used any more, and the array has room for it.
    unsafe {
        bladesmith_table_size(table, &mut rows, &mut columns);
        bladesmith_table_data(table, rows, room(rows * columns).as_mut_ptr());
        bladesmith_table_free(table);
    }
}

/// All of them; those that make handles come more often.
pub const CALLS: [Call; 33] = [
    ("curve_new", make_curve),
    ("curve_new", make_curve),
    ("curve_evaluate", evaluate_curve),
    ("curve_frames", frames_of_curve),
    ("curve_lengths", lengths_of_curve),
    ("curve_* that reshape", reshape_curve),
    ("curve_* that reshape", reshape_curve),
    ("curve_join", join_curves),
    ("curves_*", list_curves),
    ("curve_arc, curve_conic", conics),
    ("curve_periodic", closed_curves),
    ("parameters, averaged_knots", parameters_of_points),
    ("curve_interpolate", interpolate),
    ("curve_interpolate_closed", interpolate_closed),
    ("curve_fit, curve_smooth*", fit),
    ("curve_nearest*", nearest_on_curve),
    ("surface_new", make_surface),
    ("surface_evaluate, surface_curvatures", evaluate_surface),
    ("surface_* that reshape", reshape_surface),
    ("surface_* that reshape", reshape_surface),
    ("surface_* of curves", surfaces_of_curves),
    ("surface_nearest*", nearest_on_surface),
    ("curve_intersect, curve_self_intersect", meet_curves),
    ("curve_ray, surface_ray", cast_rays),
    ("curve_offset*", offset_curve),
    ("curve_offset_map", map_to_offset),
    ("curve_fillet*", round_corners),
    ("curve_first_hits, surface_first_hits", cast_many),
    ("surface_evaluate_grid", evaluate_on_grid),
    ("surface_bezier, surfaces_*", patches_of_surface),
    ("surface_section, surface_intersect, section_*", cut_surfaces),
    ("surface_project", project_curves),
    ("surface_offset", offset_surface),
];

/// Calls that may take a second each: half as often.
pub const SLOW: [&str; 2] = ["surface_section, surface_intersect, section_*", "surface_project"];
